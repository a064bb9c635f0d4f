// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace pbrtmedia {

/// Asks for pages of 2 MiB for large arrays: a look-up in a grid beyond the cache touches up to four pages,
/// and with pages of 4 KiB none of them is in the translation buffer. Where the system has no such pages this
/// is an ordinary aligned allocation.
template <class T>
struct HugePageAllocator {
  using value_type = T;
  static constexpr std::size_t kHugePage = std::size_t{2}
                                           << 20;  ///< bytes; also the alignment of large arrays
  static constexpr std::size_t kCacheLine = 64;    ///< bytes; alignment of the others

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) {}  // NOLINT(google-explicit-constructor): rebinding
  bool operator==(const HugePageAllocator&) const { return true; }

  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    void* const p = ::operator new(n * sizeof(T), alignmentOf(n));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    // Advice: a refusal costs speed, nothing else.
    if (isLarge(n)) static_cast<void>(::madvise(p, n * sizeof(T), MADV_HUGEPAGE));
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignmentOf(n)); }

 private:
  static bool isLarge(std::size_t n) { return n * sizeof(T) >= 2 * kHugePage; }
  static std::align_val_t alignmentOf(std::size_t n) {
    return std::align_val_t{isLarge(n) ? kHugePage : kCacheLine};
  }
};

}  // namespace pbrtmedia
