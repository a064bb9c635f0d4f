// SPDX-License-Identifier: BSD-2-Clause
#include "film/film.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "base/stopwatch.h"

namespace pbrtmedia {
namespace {

constexpr int kTableWidth = 16;               // PBRT-v3's table, which decides the weights (reference 8.1)
constexpr float kNegativeLuminance = -1e-5f;  // below it a sample is an error, above it rounding
constexpr int kMaxResolution = std::int32_t{1} << 24;  // pixel coordinates stay exact as floats

[[noreturn]] void fail(const std::string& message) { throw SceneError({}, "film: " + message); }

Film::Settings checked(Film::Settings s) {
  std::ostringstream text;
  if (s.resolution.x < 1 || s.resolution.y < 1 || s.resolution.x > kMaxResolution ||
      s.resolution.y > kMaxResolution) {
    text << "the resolution is " << s.resolution.x << " x " << s.resolution.y << "; expected 1 to "
         << kMaxResolution << " pixels each way";
    fail(text.str());
  }
  if (!std::isfinite(s.scale)) fail("scale is not a finite number");
  if (!(s.maxSampleLuminance >= 0)) {
    text << "maxsampleluminance is " << s.maxSampleLuminance << "; expected a number >= 0";
    fail(text.str());
  }
  for (float& edge : s.cropWindow) {
    if (std::isnan(edge)) fail("cropwindow holds a value that is not a number");
    edge = std::clamp(edge, 0.0f, 1.0f);
  }
  if (s.cropWindow[0] > s.cropWindow[1]) std::swap(s.cropWindow[0], s.cropWindow[1]);
  if (s.cropWindow[2] > s.cropWindow[3]) std::swap(s.cropWindow[2], s.cropWindow[3]);
  return s;
}

/// In float, as PBRT-v3 does: 200 * 0.9f rounds to 180 although 0.9f lies below 0.9.
int cropEdge(int resolution, float fraction) {
  return static_cast<int>(std::ceil(static_cast<float>(resolution) * fraction));
}

Bounds2i croppedPixels(const Film::Settings& s) {
  const Bounds2i b{{cropEdge(s.resolution.x, s.cropWindow[0]), cropEdge(s.resolution.y, s.cropWindow[2])},
                   {cropEdge(s.resolution.x, s.cropWindow[1]), cropEdge(s.resolution.y, s.cropWindow[3])}};
  if (b.area() > 0) return b;
  std::ostringstream text;
  text << "the crop window [" << s.cropWindow[0] << ' ' << s.cropWindow[1] << ' ' << s.cropWindow[2] << ' '
       << s.cropWindow[3] << "] of " << s.resolution.x << " x " << s.resolution.y << " holds no pixel";
  fail(text.str());
}

Bounds2i grownBounds(const Bounds2i& pixels, Vector2f radius) {
  const auto low = [](int edge, float r) { return static_cast<int>(std::floor(edge + 0.5 - r)); };
  const auto high = [](int edge, float r) { return static_cast<int>(std::ceil(edge - 0.5 + r)); };
  return {{low(pixels.min.x, radius.x), low(pixels.min.y, radius.y)},
          {high(pixels.max.x, radius.x), high(pixels.max.y, radius.y)}};
}

/// Before memory is taken: with more than the machine has, the system would end the program without a word.
void checkMemory(const Bounds2i& pixels, Vector2f radius) {
  const double width = pixels.width(), height = pixels.height();
  const double sampleArea = (width + 2.0 * radius.x + 2) * (height + 2.0 * radius.y + 2);
  const double bytes =
      width * height * (sizeof(Film::Sums) + 2 * sizeof(Rgb)) + sampleArea * sizeof(SamplePass::Sample);
  const auto most = static_cast<double>(machineMemoryBytes());
  if (bytes <= most) return;
  std::ostringstream text;
  text
      << pixels.width() << " x " << pixels.height() << " pixels under a filter of radius " << radius.x << ' '
      << radius.y << " take " << bytes / 1e9 << " GB, more than the " << most / 1e9
      << " GB of this machine; render parts with \"cropwindow\", and put them together with imgtool assemble";
  fail(text.str());
}

std::vector<float> tabulate(const Filter& filter) {
  std::vector<float> table;
  table.reserve(kTableWidth * kTableWidth);
  for (int y = 0; y < kTableWidth; ++y) {
    for (int x = 0; x < kTableWidth; ++x) {
      table.push_back(filter.evaluate({(static_cast<float>(x) + 0.5f) * filter.radius().x / kTableWidth,
                                       (static_cast<float>(y) + 0.5f) * filter.radius().y / kTableWidth}));
    }
  }
  return table;
}

/// Cell of the table for a distance per axis (sample minus pixel centre), or -1 outside [-radius, radius).
int tableCell(float d, float radius, float cellsPerPixel) {
  if (!(d >= -radius && d < radius)) return -1;
  return std::min(static_cast<int>(std::abs(d) * cellsPerPixel), kTableWidth - 1);
}

}  // namespace

Film::Film(const Settings& settings, std::unique_ptr<Filter> filter)
    : settings_(checked(settings)), filter_(std::move(filter)) {
  CHECK(filter_ != nullptr);
  const Vector2f radius = filter_->radius();
  pixelBounds_ = croppedPixels(settings_);
  checkMemory(pixelBounds_, radius);
  sampleBounds_ = grownBounds(pixelBounds_, radius);
  filterTable_ = tabulate(*filter_);
  // A sample at offset o in [0, 1) of the pixel k away lies k + o - 1/2 from the centre.
  const auto first = [](float r) { return static_cast<int>(std::floor(-0.5 - r)) + 1; };
  const auto last = [](float r) { return static_cast<int>(std::ceil(0.5 + r)) - 1; };
  firstNeighbour_ = {first(radius.x), first(radius.y)};
  lastNeighbour_ = {last(radius.x), last(radius.y)};
  pixels_.resize(static_cast<std::size_t>(pixelBounds_.area()));
}

bool Film::admit(Rgb& radiance, RenderCounters& counters) const {
  const auto drop = [&](DropCause cause) {
    ++counters.dropped[static_cast<std::size_t>(cause)];
    return false;
  };
  if (std::isnan(radiance.r) || std::isnan(radiance.g) || std::isnan(radiance.b))
    return drop(DropCause::NotANumber);
  const float luminance = radiance.luminance();
  // Finite channels whose luminance overflows are as useless as infinite ones.
  if (!radiance.isFinite() || !std::isfinite(luminance)) return drop(DropCause::Infinite);
  if (luminance < kNegativeLuminance && !keepsNegatives_) return drop(DropCause::Negative);
  if (const float size = std::abs(luminance); size > settings_.maxSampleLuminance)
    radiance *= settings_.maxSampleLuminance / size;
  return true;
}

void Film::accumulate(const SamplePass& pass) {
  CHECK(pass.bounds() == sampleBounds_) << "a pass must cover the sample bounds of its film";
  parallelFor(static_cast<std::size_t>(pixelBounds_.height()),
              [&](std::size_t row) { accumulateRow(pass, pixelBounds_.min.y + static_cast<int>(row)); });
}

void Film::accumulateRow(const SamplePass& pass, int y) {
  const Vector2f radius = filter_->radius();
  const float cellsX = kTableWidth / radius.x, cellsY = kTableWidth / radius.y;
  Sums* const row =
      pixels_.data() + static_cast<std::ptrdiff_t>(y - pixelBounds_.min.y) * pixelBounds_.width();
  for (int s = 0; s < pass.samplesPerPixel(); ++s) {
    for (int x = pixelBounds_.min.x; x < pixelBounds_.max.x; ++x) {
      Sums sums = row[x - pixelBounds_.min.x];
      for (int ky = firstNeighbour_.y; ky <= lastNeighbour_.y; ++ky) {
        const SamplePass::Sample* neighbour = &pass.at({x + firstNeighbour_.x, y + ky}, s);
        for (int kx = firstNeighbour_.x; kx <= lastNeighbour_.x; ++kx, ++neighbour) {
          if (!neighbour->valid) continue;
          const int cellY = tableCell(static_cast<float>(ky) + neighbour->offset.y - 0.5f, radius.y, cellsY);
          const int cellX = tableCell(static_cast<float>(kx) + neighbour->offset.x - 0.5f, radius.x, cellsX);
          if (cellX < 0 || cellY < 0) continue;
          const double weight = filterTable_[static_cast<std::size_t>(cellY * kTableWidth + cellX)];
          sums.r += weight * neighbour->radiance.r;
          sums.g += weight * neighbour->radiance.g;
          sums.b += weight * neighbour->radiance.b;
          sums.weight += weight;
        }
      }
      row[x - pixelBounds_.min.x] = sums;
    }
  }
}

Image Film::develop() const {
  Image image(pixelBounds_.width(), pixelBounds_.height());
  image.dataWindow = pixelBounds_;
  image.displayWindow = {{0, 0}, settings_.resolution};
  const auto channel = [&](double sum, double weight) {
    constexpr double kMost = std::numeric_limits<float>::max();
    const double mean = keepsNegatives_ ? sum / weight : std::max(0.0, sum / weight);
    return static_cast<float>(std::clamp(mean * settings_.scale, -kMost, kMost));
  };
  std::size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Sums& s = pixels_[i++];
      const Rgb value = s.weight != 0
                            ? Rgb(channel(s.r, s.weight), channel(s.g, s.weight), channel(s.b, s.weight))
                            : Rgb(0);
      image.setRgb(x, y, value);
    }
  }
  return image;
}

void Film::restore(std::vector<Sums> sums) {
  if (sums.size() != pixels_.size())
    throw std::invalid_argument("Film::restore: " + std::to_string(sums.size()) + " pixels for a film of " +
                                std::to_string(pixels_.size()));
  pixels_ = std::move(sums);
}

}  // namespace pbrtmedia
