// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/parts/taylor_roulette.h"

namespace pbrtmedia {

template struct TaylorRouletteOf<PinkNoiseLaw>;

}  // namespace pbrtmedia
