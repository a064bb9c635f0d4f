// SPDX-License-Identifier: BSD-2-Clause
// Body of grid_batch.cpp, compiled once per instruction set.
#if defined(PBRTMEDIA_FIELDS_GRID_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PBRTMEDIA_FIELDS_GRID_BATCH_INL_H
#undef PBRTMEDIA_FIELDS_GRID_BATCH_INL_H
#else
#define PBRTMEDIA_FIELDS_GRID_BATCH_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "fields/grid_batch.h"
#include "fields/sample_layout.h"

HWY_BEFORE_NAMESPACE();
namespace pbrtmedia {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE

inline void gridDensitiesOnTarget(const GridView& view, Vec3d o, Vec3d d, const double* s, float* out,
                                  std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = view.density(o + s[i] * d);
}

#else

// One look-up per 64-bit lane. Positions, cells and offsets are double (whole numbers below 2^52 are exact);
// samples are gathered as pairs (x, x + 1), which fill such a lane as two floats.
using F64 = hn::ScalableTag<double>;
using I64 = hn::RebindToSigned<F64>;
using U64 = hn::RebindToUnsigned<F64>;
using Pairs = hn::Repartition<float, F64>;  ///< two floats per look-up
using Singles = hn::Rebind<float, F64>;     ///< one
using Codes = hn::RebindToUnsigned<Singles>;
constexpr F64 kF64;
constexpr I64 kI64;
constexpr U64 kU64;
constexpr Pairs kPairs;
constexpr Singles kSingles;
constexpr Codes kCodes;

/// Number of the sample at the lower corner of each cell, as whole doubles.
template <bool kBricked>
class CellOffsets {
 public:
  using V = hn::Vec<F64>;
  HWY_INLINE explicit CellOffsets(const GridView& g)
      : row_(hn::Set(kF64, static_cast<double>(g.row))), slice_(hn::Set(kF64, static_cast<double>(g.slice))) {
    brickRow_ = hn::Set(kF64, static_cast<double>(g.brickRow));
    brickSlice_ = hn::Set(kF64, static_cast<double>(g.brickSlice));
  }
  HWY_INLINE V operator()(V x, V y, V z) const {
    if constexpr (!kBricked) {
      return sum(x, y, z, row_, slice_);
    } else {
      const V bx = brickOf(x), by = brickOf(y), bz = brickOf(z);
      const V brick = sum(bx, by, bz, brickRow_, brickSlice_);
      const V within = sum(withinBrick(x, bx), withinBrick(y, by), withinBrick(z, bz), row_, slice_);
      const V slots = hn::Set(kF64, static_cast<double>(SampleLayout::kBrickSlots));
      return hn::Add(hn::Mul(brick, slots), within);
    }
  }

 private:
  static HWY_INLINE V sum(V x, V y, V z, V row, V slice) {
    return hn::Add(hn::Add(hn::Mul(z, slice), hn::Mul(y, row)), x);
  }
  static HWY_INLINE V brickOf(V cell) {
    return hn::Trunc(hn::Mul(cell, hn::Set(kF64, 1.0 / static_cast<double>(SampleLayout::kBrickCells))));
  }
  static HWY_INLINE V withinBrick(V cell, V brick) {
    return hn::Sub(cell, hn::Mul(brick, hn::Set(kF64, static_cast<double>(SampleLayout::kBrickCells))));
  }
  V row_, slice_, brickRow_, brickSlice_;
};

/// The samples x, x + 1 at each offset, as floats; halves are decoded but not scaled.
template <class T>
HWY_INLINE hn::Vec<Pairs> gatherPairs(const T* base, hn::Vec<I64> offset) {
  constexpr bool kHalf = sizeof(T) == 2;
#if HWY_MAX_BYTES == 16
  // Two look-ups at a time on targets without a gather.
  HWY_ALIGN std::int64_t at[2];
  hn::Store(offset, kI64, at);
  hn::Vec<U64> bits = hn::Zero(kU64);
  if constexpr (!kHalf) {
    const hn::Half<Pairs> one;
    return hn::Combine(kPairs, hn::LoadU(one, base + at[1]), hn::LoadU(one, base + at[0]));
  } else {
    HWY_ALIGN std::uint64_t pair[2] = {0, 0};
    for (int i = 0; i < 2; ++i) {
      std::uint32_t both = 0;
      std::memcpy(&both, base + at[i], sizeof both);
      pair[i] = both;
    }
    bits = hn::Load(kU64, pair);
  }
#else
  // Reads 8 bytes also for two halves: the array is padded.
  const hn::Vec<I64> bytes = hn::ShiftLeft < kHalf ? 1 : 2 > (offset);
  const hn::Vec<U64> bits = hn::GatherOffset(kU64, reinterpret_cast<const std::uint64_t*>(base), bytes);
#endif
  if constexpr (!kHalf) {
    return hn::BitCast(kPairs, bits);
  } else {
    const auto first = hn::And(bits, hn::Set(kU64, 0xffffull));
    const auto second = hn::ShiftLeft<16>(hn::And(bits, hn::Set(kU64, 0xffff0000ull)));
    const auto shifted = hn::ShiftLeft<HalfCode::kMantissaShift>(hn::Or(first, second));
    return hn::Mul(hn::BitCast(kPairs, shifted), hn::Set(kPairs, HalfCode::kRebias));
  }
}

template <class V>
HWY_INLINE V mix(V f, V a, V b) {
  return hn::Add(a, hn::Mul(f, hn::Sub(b, a)));
}

/// A fraction, once for each float of a pair.
HWY_INLINE hn::Vec<Pairs> forPairs(hn::Vec<F64> fraction) {
  const auto bits = hn::PromoteTo(kU64, hn::BitCast(kCodes, hn::DemoteTo(kSingles, fraction)));
  return hn::BitCast(kPairs, hn::Or(bits, hn::ShiftLeft<32>(bits)));
}

/// `base`: the view's samples. One vector of look-ups per `lookUp`.
template <bool kBricked, class T>
class BatchLookup {
 public:
  HWY_INLINE BatchLookup(const GridView& g, const T* base, Vec3d o, Vec3d d)
      : base_(base), row_(g.row), slice_(g.slice), scale_(hn::Set(kSingles, g.scale)), offsets_(g) {
    ox_ = hn::Set(kF64, o.x), oy_ = hn::Set(kF64, o.y), oz_ = hn::Set(kF64, o.z);
    dx_ = hn::Set(kF64, d.x), dy_ = hn::Set(kF64, d.y), dz_ = hn::Set(kF64, d.z);
  }

  HWY_INLINE void lookUp(const double* HWY_RESTRICT s, float* HWY_RESTRICT out) const {
    const auto t = hn::LoadU(kF64, s);
    const auto x = hn::Add(ox_, hn::Mul(t, dx_)), y = hn::Add(oy_, hn::Mul(t, dy_)),
               z = hn::Add(oz_, hn::Mul(t, dz_));
    const auto ix = hn::Trunc(x), iy = hn::Trunc(y), iz = hn::Trunc(z);
    const auto fx = hn::DemoteTo(kSingles, hn::Sub(x, ix));
    const auto fy = forPairs(hn::Sub(y, iy)), fz = forPairs(hn::Sub(z, iz));
    // Adding 2^52 leaves a whole number in the low bits.
    const auto two52 = hn::Set(kF64, 0x1p52);
    const auto at =
        hn::Xor(hn::BitCast(kI64, hn::Add(offsets_(ix, iy, iz), two52)), hn::BitCast(kI64, two52));
    const auto near = mix(fy, gatherPairs(base_, at), gatherPairs(base_ + row_, at));
    const auto far = mix(fy, gatherPairs(base_ + slice_, at), gatherPairs(base_ + slice_ + row_, at));
    const auto both = hn::BitCast(kU64, mix(fz, near, far));
    const auto low = hn::BitCast(kSingles, hn::TruncateTo(kCodes, both));
    const auto high = hn::BitCast(kSingles, hn::TruncateTo(kCodes, hn::ShiftRight<32>(both)));
    const auto density = mix(fx, low, high);
    hn::StoreU(sizeof(T) == 2 ? hn::Mul(scale_, density) : density, kSingles, out);
  }

  HWY_INLINE void lookUpAll(const double* s, float* out, std::size_t n) const {
    const std::size_t lanes = hn::Lanes(kF64);
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) lookUp(s + i, out + i);
    if (i == n) return;
    if (n >= lanes) {  // the last vector again, shifted back: the same points have the same answers
      lookUp(s + n - lanes, out + n - lanes);
      return;
    }
    HWY_ALIGN double padded[hn::MaxLanes(kF64)];
    HWY_ALIGN float answers[hn::MaxLanes(kF64)];
    for (std::size_t k = 0; k < lanes; ++k) padded[k] = s[k < n ? k : n - 1];
    lookUp(padded, answers);
    std::memcpy(out, answers, n * sizeof *out);
  }

 private:
  const T* base_;
  std::int64_t row_, slice_;
  hn::Vec<Singles> scale_;
  CellOffsets<kBricked> offsets_;
  hn::Vec<F64> ox_, oy_, oz_, dx_, dy_, dz_;
};

template <class T>
HWY_INLINE void onLayout(const GridView& view, const T* base, Vec3d o, Vec3d d, const double* s, float* out,
                         std::size_t n) {
  if (view.bricked) {
    BatchLookup<true, T>(view, base, o, d).lookUpAll(s, out, n);
  } else {
    BatchLookup<false, T>(view, base, o, d).lookUpAll(s, out, n);
  }
}

inline void gridDensitiesOnTarget(const GridView& view, Vec3d o, Vec3d d, const double* s, float* out,
                                  std::size_t n) {
  if (view.floats) {
    onLayout(view, view.floats, o, d, s, out, n);
  } else {
    onLayout(view, view.halves, o, d, s, out, n);
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace pbrtmedia
HWY_AFTER_NAMESPACE();

#endif
