// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fields/grid_view.h"
#include "fields/huge_page_allocator.h"
#include "fields/sample_layout.h"

namespace pbrtmedia {

/// What trilinear interpolation finds beyond the outermost samples.
enum class GridBorder {
  Zero,   ///< PBRT-v3: samples outside are 0, so the density fades over the outer half voxel
  Clamp,  ///< the outermost sample holds up to the face of the box; 0 beyond
};

/// How exactly the samples of a grid are stored.
enum class GridPrecision {
  Float,  ///< as given
  /// 16 bits: relative error 2^-11 down to 2^-28 of the largest sample, absolute 2^-39 of it below. Half the
  /// memory; bricked, batches beyond the cache are as fast as those of floats; single look-ups take 1.2 to
  /// 1.4 times as long.
  Half,
};

/// The samples 1..n per axis of a grid and an apron around them, 0 and n + 1, that holds the border rule.
/// Immutable; look-ups are thread-safe. It can be moved, not copied.
class GridSamples {
 public:
  /// `nx`, ...: >= 1; `density`: nx ny nz finite values >= 0, x fastest.
  GridSamples(int nx, int ny, int nz, std::span<const float> density, GridBorder border,
              GridPrecision precision, GridLayout layout);
  GridSamples(GridSamples&&) = default;
  GridSamples& operator=(GridSamples&&) = default;
  GridSamples(const GridSamples&) = delete;
  GridSamples& operator=(const GridSamples&) = delete;
  ~GridSamples() = default;

  const GridView& view() const { return view_; }
  const SampleLayout& layout() const { return layout_; }
  float at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return view_.sample(layout_.index(i, j, k));
  }
  std::size_t bytes() const {
    return floats_.size() * sizeof(float) + halves_.size() * sizeof(std::uint16_t);
  }

 private:
  /// Fills `to` by rows: store(value) is the stored form of a sample.
  template <class T, class Store>
  void fill(std::vector<T, HugePageAllocator<T>>& to, Store&& store, std::span<const float> density,
            GridBorder border) const;

  int n_[3];
  SampleLayout layout_;
  std::vector<float, HugePageAllocator<float>> floats_;
  std::vector<std::uint16_t, HugePageAllocator<std::uint16_t>> halves_;
  GridView view_;  ///< into the arrays above, which a move leaves in place
};

}  // namespace pbrtmedia
