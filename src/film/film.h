// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/statistics.h"
#include "film/filter_table.h"
#include "film/layers.h"
#include "film/pixel_sums.h"
#include "film/sample_pass.h"
#include "film/splat_buffer.h"
#include "filters/filter.h"
#include "image/image.h"
#include "image/splat_sums.h"
#include "image/weighted_sums.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Film `image`: weighted averages of filtered samples, sums in double. Pixel = Σ L w f / Σ f (scene-language
/// reference 8.1); f from the 16 x 16 table of PBRT-v3. Sums are taken per pixel in a fixed order (sample
/// index, then neighbour pixel row by row), so the image does not depend on threads, tiles or how samples are
/// grouped. A sample counts for the pixels whose centre c satisfies -radius <= p - c < radius per axis: half
/// open, so that one on the border of two pixels counts once.
class Film {
 public:
  struct Settings {
    Point2i resolution{1280, 720};
    float cropWindow[4] = {0, 1, 0, 1};  ///< x0 x1 y0 y1, fractions, y down
    float scale = 1;
    float maxSampleLuminance = kInfinity;
    LayerSet layers{};  ///< what the image is to hold besides colour
  };
  /// Of the samples of one pixel.
  using Sums = WeightedSums;
  /// Everything the film remembers, row by row over `pixelBounds`.
  struct State {
    std::vector<Sums> sums;
    std::vector<Sums> odd;               ///< of samples of odd index alone; empty unless halves are kept
    std::vector<double> layers;          ///< LayerSet::sumCount of them a pixel; empty without layers
    std::vector<SplatSum> splats;        ///< empty before the first one; so are the next two
    std::vector<SplatSum> oddSplats;     ///< of samples of odd index alone; empty unless halves are kept
    std::vector<SplatSum> splatSquares;  ///< of what each path brings; empty without Layer::Variance
    SplatPaths paths;                    ///< of all splats
    std::uint64_t oddPaths = 0;          ///< of samples of odd index
    bool operator==(const State&) const = default;
  };

  /// Sorts and clamps the crop window. Throws SceneError for settings that make no picture: no pixels, or a
  /// crop window, scale or luminance limit that is not a number.
  Film(const Settings& settings, const Filter& filter);

  const Settings& settings() const { return settings_; }
  Bounds2i pixelBounds() const { return pixelBounds_; }    ///< pixels of the crop window
  Bounds2i sampleBounds() const { return sampleBounds_; }  ///< pixels that need samples: grown by the filter
  /// Pixels of the whole image, cropped or not.
  double imageArea() const {
    return static_cast<double>(settings_.resolution.x) * static_cast<double>(settings_.resolution.y);
  }
  const LayerSet& layers() const { return settings_.layers; }
  /// Instead of those of the settings: to be called before the first sample. Throws as the constructor does.
  void setLayers(const LayerSet& layers);
  /// Whether a sample may reach the film; counts its cause in `counters` and returns false otherwise. A
  /// dropped sample is black but still weighs, as in PBRT-v3. Luminance above maxSampleLuminance is scaled
  /// down in place, and so is that below minus it.
  bool admit(Rgb& radiance, RenderCounters& counters) const;
  /// From now on negative luminances are samples like others, and negative pixels stay negative: for scenes
  /// whose estimators have such samples, and would be biased without them.
  void keepNegatives() { keepsNegatives_ = true; }
  /// How sums become pixels.
  Development development() const { return {settings_.scale, keepsNegatives_}; }
  bool keepsNegatives() const { return keepsNegatives_; }
  /// From now on samples of even and of odd index are told apart, for an estimate of the error: to be called
  /// before the first sample. Costs a second set of sums, and half as much time again in adding passes.
  void keepHalves();
  bool hasHalves() const { return !state_.odd.empty(); }
  /// From now on only the pixel rows [first, end) are summed; somebody else sums the others (setRows).
  void sumOnly(int first, int end);
  /// Adds a pass over exactly `sampleBounds`; parallel over rows.
  void accumulate(const SamplePass& pass);
  /// Adds splats, each with the filter's weights over the filter's integral, in their order: for each pixel
  /// the sum is the same whatever the units of work, if the orders are. `paths`: how many light paths or
  /// mutations they are of, which spread over the same area in each call: a splat of value L from each,
  /// evenly over these pixels, makes them L. `oddPaths`: how many of them are of samples of odd index; wanted
  /// where halves are kept. All splats of a path come in one call. A pixel is the mean of its samples plus
  /// its splats. Parallel over rows.
  void addSplats(std::span<const SplatBuffer> units, const SplatPaths& paths, std::uint64_t oddPaths = 0);
  /// Current image: normalised, negative values at 0 unless they are kept, scaled. Data and display windows
  /// are set. Layers follow the colour (film/layer_sums.h).
  Image develop() const;

  /// The image less an estimate of its error from its halves, without clamping: with A and B the means of the
  /// samples of even and of odd index, of weights a and b, (A - B) sqrt(a b) / (a + b) has the variance of
  /// the error if samples are independent. Splats bring the same of the light paths of these samples.
  /// Compared with this the image is as wrong as with the truth, but for bias. Only when halves are kept.
  Image surrogateReference() const;

  /// Rows of pixels that a sample reaches: those from the row of its pixel - lastNeighbour to that -
  /// firstNeighbour.
  int firstNeighbourRow() const { return filter_.firstNeighbour().y; }
  int lastNeighbourRow() const { return filter_.lastNeighbour().y; }

  /// The part of the state that is of the pixel rows [first, end).
  State rows(int first, int end) const;
  /// Puts such a part, of a film like this one, in its place. False, changing nothing, when it is none.
  bool setRows(int first, int end, const State& rows);

  /// The sums besides those of the colour, pixel by pixel (OtherSums).
  std::vector<double> otherSums() const;

  /// For checkpoints, and back: false, changing nothing, for a state of another film.
  const State& state() const { return state_; }
  bool restore(State state);

 private:
  /// Adds samples of one index to a row of the sums, and of those of the odd half too.
  template <bool isOfHalf>
  void accumulateRow(const SamplePass& pass, int y, int slot);
  void accumulateLayersOfRow(const SamplePass& pass, int y);
  void addSplatsToRows(std::span<const Splat* const> splats, int firstRow, int lastRow);
  /// Adds the squares of what each path brings; the splats of a path stand side by side.
  void addSquaresToRows(std::span<const Splat* const> splats, int firstRow, int lastRow);
  /// Calls visit(index of the pixel, weight) for the pixels of these rows that a splat reaches.
  template <class Visit>
  void visitReached(const Splat& splat, int firstRow, int lastRow, const Visit& visit) const;
  /// The error that surrogateReference() takes from a pixel, unscaled.
  SplatSum estimatedError(std::size_t pixel) const;
  PixelParts partsOf(std::size_t pixel) const;

  Settings settings_;
  bool keepsNegatives_ = false;
  FilterTable filter_;
  Bounds2i pixelBounds_, sampleBounds_;
  int firstRow_, endRow_;  ///< that are summed here
  State state_;
};

}  // namespace pbrtmedia
