// SPDX-License-Identifier: BSD-2-Clause
#include "main/image_error.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace pbrtmedia {
namespace {

/// By how much samples grow from one look to the next: then an image is at most a tenth too good.
constexpr double kGrowth = 1.1;

bool isBlack(const Image& image, Bounds2i pixels) {
  const Image shown = cutOut(image, pixels);
  return std::all_of(shown.data().begin(), shown.data().end(), [](float value) { return value == 0; });
}

}  // namespace

Image cutOut(const Image& image, Bounds2i wanted) {
  Image out(wanted.width(), wanted.height());
  out.dataWindow = wanted;
  out.displayWindow = image.displayWindow;
  const Point2i shift{wanted.min.x - image.dataWindow.min.x, wanted.min.y - image.dataWindow.min.y};
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) out.setRgb(x, y, image.rgb(x + shift.x, y + shift.y));
  }
  return out;
}

std::optional<ErrorSummary> estimatedError(const Film& film, Bounds2i pixels, const RenderResult& result) {
  if (!film.hasHalves() || result.samplesTaken < 2 * result.pixelsTotal) return std::nullopt;
  const Film::State& sums = film.state();
  const bool isOneHalf = sums.oddPaths == 0 || sums.oddPaths == sums.paths.count;
  if (sums.paths.count > 0 && isOneHalf) return std::nullopt;  // a single chain
  const auto difference =
      compareImages(cutOut(film.develop(), pixels), cutOut(film.surrogateReference(), pixels));
  return std::get<ImageDifference>(difference).total;
}

bool ErrorTarget::isReached(const RenderResult& result) {
  if (!isDue(result)) return false;
  nextLook_ = kGrowth * static_cast<double>(result.samplesTaken);
  const std::optional<ErrorSummary> error = estimatedError(film_, pixels_, result);
  if (!error || !(std::sqrt(error->relativeMse) <= most_)) return false;
  // Halves that have met no light yet agree, too.
  return error->relativeMse > 0 || !isBlack(film_.develop(), pixels_);
}

}  // namespace pbrtmedia
