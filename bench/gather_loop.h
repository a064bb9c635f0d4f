// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "base/vec.h"
#include "fields/grid_view.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace pbrtmedia::bench {

/// The obvious vector look-up, for comparison: AVX2, eight points at a time, one 32-bit gather per corner of
/// the cell. It loses to fields/grid_batch.h because it reads eight times a look-up, not four, and it ends at
/// 2^31 samples. Linear floats only; `n` a multiple of 8.
#if defined(__x86_64__)
__attribute__((target("avx2"))) inline __m128 fractionAndCell(__m256d p, __m128i& cell) {
  cell = _mm256_cvttpd_epi32(p);
  return _mm256_cvtpd_ps(_mm256_sub_pd(p, _mm256_cvtepi32_pd(cell)));
}

__attribute__((target("avx2"))) inline void positions(double o, double d, const double* s, __m256& fraction,
                                                      __m256i& cell) {
  __m128i low, high;
  const __m256d from = _mm256_set1_pd(o), step = _mm256_set1_pd(d);
  const __m128 a = fractionAndCell(_mm256_add_pd(from, _mm256_mul_pd(_mm256_loadu_pd(s), step)), low);
  const __m128 b = fractionAndCell(_mm256_add_pd(from, _mm256_mul_pd(_mm256_loadu_pd(s + 4), step)), high);
  fraction = _mm256_set_m128(b, a);
  cell = _mm256_set_m128i(high, low);
}

__attribute__((target("avx2"))) inline __m256 mixed(__m256 f, __m256 a, __m256 b) {
  return _mm256_add_ps(a, _mm256_mul_ps(f, _mm256_sub_ps(b, a)));
}

/// The line along y and z of a cell whose lower corner lies at `base + at`.
__attribute__((target("avx2"))) inline __m256 column(const GridView& g, const float* base, __m256i at,
                                                     __m256 fy, __m256 fz) {
  const float* const far = base + g.slice;
  return mixed(fz, mixed(fy, _mm256_i32gather_ps(base, at, 4), _mm256_i32gather_ps(base + g.row, at, 4)),
               mixed(fy, _mm256_i32gather_ps(far, at, 4), _mm256_i32gather_ps(far + g.row, at, 4)));
}

__attribute__((target("avx2"))) inline void gatherLoop(const GridView& g, Vec3d o, Vec3d d, const double* s,
                                                       float* out, std::size_t n) {
  const __m256i row = _mm256_set1_epi32(static_cast<int>(g.row)),
                slice = _mm256_set1_epi32(static_cast<int>(g.slice));
  for (std::size_t i = 0; i < n; i += 8) {
    __m256 fx, fy, fz;
    __m256i ix, iy, iz;
    positions(o.x, d.x, s + i, fx, ix);
    positions(o.y, d.y, s + i, fy, iy);
    positions(o.z, d.z, s + i, fz, iz);
    const __m256i at =
        _mm256_add_epi32(ix, _mm256_add_epi32(_mm256_mullo_epi32(iy, row), _mm256_mullo_epi32(iz, slice)));
    _mm256_storeu_ps(out + i,
                     mixed(fx, column(g, g.floats, at, fy, fz), column(g, g.floats + 1, at, fy, fz)));
  }
}
inline bool hasGatherLoop() { return __builtin_cpu_supports("avx2"); }
#else
inline void gatherLoop(const GridView&, Vec3d, Vec3d, const double*, float*, std::size_t) {}
inline bool hasGatherLoop() { return false; }
#endif

}  // namespace pbrtmedia::bench
