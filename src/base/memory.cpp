// SPDX-License-Identifier: BSD-2-Clause
#include "base/memory.h"

#if defined(__linux__)
#include <malloc.h>
#endif

namespace pbrtmedia {

void returnFreedMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace pbrtmedia
