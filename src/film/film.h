// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/bounds.h"
#include "base/statistics.h"
#include "filters/filter.h"
#include "image/image.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// The samples of some consecutive sample indices over the film's sample bounds, before filtering. Threads
/// write disjoint entries; nothing is summed here, so nothing depends on their order.
class SamplePass {
 public:
  struct Sample {
    Point2f offset;      ///< film position minus the pixel's integer corner, in [0, 1)
    Rgb radiance;        ///< already multiplied by the camera's ray weight
    bool valid = false;  ///< false: not taken (stopped early); it then does not count at all
  };
  SamplePass(Bounds2i sampleBounds, int samplesPerPixel);
  Bounds2i bounds() const { return bounds_; }
  int samplesPerPixel() const { return samples_; }
  Sample& at(Point2i pixel, int sample) { return data_[index(pixel, sample)]; }
  const Sample& at(Point2i pixel, int sample) const { return data_[index(pixel, sample)]; }
  void clear();

 private:
  std::size_t index(Point2i pixel, int sample) const;
  Bounds2i bounds_;
  int samples_;
  std::vector<Sample> data_;
};

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
  };
  /// Weighted sums of one pixel; everything the film remembers.
  struct Sums {
    double r = 0, g = 0, b = 0, weight = 0;
    bool operator==(const Sums&) const = default;
  };

  /// Sorts and clamps the crop window. Throws SceneError for settings that make no picture: no pixels, or a
  /// crop window, scale or luminance limit that is not a number.
  Film(const Settings& settings, std::unique_ptr<Filter> filter);

  const Settings& settings() const { return settings_; }
  Bounds2i pixelBounds() const { return pixelBounds_; }    ///< pixels of the crop window
  Bounds2i sampleBounds() const { return sampleBounds_; }  ///< pixels that need samples: grown by the filter
  /// Whether a sample may reach the film; counts its cause in `counters` and returns false otherwise. A
  /// dropped sample is black but still weighs, as in PBRT-v3. Luminance above maxSampleLuminance is scaled
  /// down in place, and so is that below minus it.
  bool admit(Rgb& radiance, RenderCounters& counters) const;
  /// From now on negative luminances are samples like others, and negative pixels stay negative: for scenes
  /// whose estimators have such samples, and would be biased without them.
  void keepNegatives() { keepsNegatives_ = true; }
  bool keepsNegatives() const { return keepsNegatives_; }
  /// Adds a pass over exactly `sampleBounds`; parallel over rows.
  void accumulate(const SamplePass& pass);
  /// Current image: normalised, negative values at 0 unless they are kept, scaled. Data and display windows
  /// are set.
  Image develop() const;

  /// The sums, row by row over `pixelBounds`, for checkpoints; and back. Throws std::invalid_argument when
  /// the number of pixels differs.
  const std::vector<Sums>& sums() const { return pixels_; }
  void restore(std::vector<Sums> sums);

 private:
  void accumulateRow(const SamplePass& pass, int y);

  Settings settings_;
  bool keepsNegatives_ = false;
  std::unique_ptr<Filter> filter_;
  Bounds2i pixelBounds_, sampleBounds_;
  std::vector<float> filterTable_;                      ///< kTableWidth^2 values over the positive quadrant
  Point2i firstNeighbour_{0, 0}, lastNeighbour_{0, 0};  ///< pixels whose samples can reach a pixel, relative
  std::vector<Sums> pixels_;
};

}  // namespace pbrtmedia
