// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "base/bounds.h"
#include "film/film.h"
#include "image/image.h"
#include "image/metrics.h"
#include "render/render_result.h"

namespace pbrtmedia {

/// Colour of the pixels `wanted` of an image, in coordinates of the whole picture.
Image cutOut(const Image& image, Bounds2i wanted);

/// Errors of the film's pixels, as they are now, against the true image: estimated from halves
/// (Film::surrogateReference). Nothing when none are kept, and before every pixel has two samples.
std::optional<ErrorSummary> estimatedError(const Film& film, Bounds2i pixels, const RenderResult& result);

/// `--error E`: whether an image is good enough.
class ErrorTarget {
 public:
  /// `most`: of sqrt(relativeMse), a relative error. `film` must outlive the object.
  ErrorTarget(double most, const Film& film, Bounds2i pixels) : most_(most), film_(film), pixels_(pixels) {}
  /// Whether it is time to look, for which the film must be whole.
  bool isDue(const RenderResult& result) const {
    return static_cast<double>(result.samplesTaken) >= nextLook_;
  }
  /// After a pass; looks only now and then, as an estimate that is often looked at is sometimes small by
  /// luck.
  bool isReached(const RenderResult& result);

 private:
  double most_;
  const Film& film_;
  Bounds2i pixels_;
  double nextLook_ = 0;  ///< samples
};

}  // namespace pbrtmedia
