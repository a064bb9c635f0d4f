// SPDX-License-Identifier: BSD-2-Clause
#include "film/film.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

#include "base/built_parts.h"
#include "base/diagnostics.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "film/layer_sums.h"

namespace pbrtmedia {
namespace {

constexpr float kNegativeLuminance = -1e-5f;           // below it a sample is an error, above it rounding
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
void checkMemory(const Bounds2i& pixels, Vector2f radius, const LayerSet& layers) {
  const double width = pixels.width(), height = pixels.height();
  const double sampleArea = (width + 2.0 * radius.x + 2) * (height + 2.0 * radius.y + 2);
  const double bytes = width * height * (sizeof(Film::Sums) + 2 * sizeof(Rgb)) +
                       sampleArea * sizeof(SamplePass::Sample) +
                       width * height * static_cast<double>(layers.sumCount() * sizeof(double)) +
                       sampleArea * static_cast<double>(layers.sampleSize() * sizeof(float));
  const auto most = static_cast<double>(machineMemoryBytes());
  if (bytes <= most) return;
  std::ostringstream text;
  text
      << pixels.width() << " x " << pixels.height() << " pixels under a filter of radius " << radius.x << ' '
      << radius.y << " take " << bytes / 1e9 << " GB, more than the " << most / 1e9
      << " GB of this machine; render parts with \"cropwindow\", and put them together with imgtool assemble";
  fail(text.str());
}

/// What the samples of one index bring to a pixel: take(sample, weight, pixel of the sample), row by row.
template <class Take>
[[gnu::always_inline]] inline void visitNeighbours(const SamplePass& pass, const FilterTable& filter,
                                                   int index, Point2i pixel, const Take& take) {
  const Point2i first = filter.firstNeighbour(), last = filter.lastNeighbour();
  for (int ky = first.y; ky <= last.y; ++ky) {
    const SamplePass::Sample* neighbour = &pass.at({pixel.x + first.x, pixel.y + ky}, index);
    for (int kx = first.x; kx <= last.x; ++kx, ++neighbour) {
      if (!neighbour->valid) continue;
      const float* const weight = filter.find(static_cast<float>(kx) + neighbour->offset.x - 0.5f,
                                              static_cast<float>(ky) + neighbour->offset.y - 0.5f);
      if (weight) take(*neighbour, static_cast<double>(*weight), Point2i{pixel.x + kx, pixel.y + ky});
    }
  }
}

}  // namespace

Film::Film(const Settings& settings, const Filter& filter)
    : settings_(checked(settings)),
      filter_(filter),
      pixelBounds_(croppedPixels(settings_)),
      firstRow_(pixelBounds_.min.y),
      endRow_(pixelBounds_.max.y) {
  checkMemory(pixelBounds_, filter_.radius(), settings_.layers);
  sampleBounds_ = grownBounds(pixelBounds_, filter_.radius());
  const auto pixels = static_cast<std::size_t>(pixelBounds_.area());
  state_.sums.resize(pixels);
  state_.layers.resize(pixels * settings_.layers.sumCount());
}

void Film::setLayers(const LayerSet& layers) {
  checkMemory(pixelBounds_, filter_.radius(), layers);
  settings_.layers = layers;
  countBuilt(Part::Layers, layers.sumCount());
  state_.layers.assign(state_.sums.size() * layers.sumCount(), 0);
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
  parallelFor(static_cast<std::size_t>(endRow_ - firstRow_), [&](std::size_t row) {
    const int y = firstRow_ + static_cast<int>(row);
    for (int s = 0; s < pass.samplesPerPixel(); ++s) {
      const bool isOfHalf = hasHalves() && (pass.firstIndex() + s) % 2 != 0;
      isOfHalf ? accumulateRow<true>(pass, y, s) : accumulateRow<false>(pass, y, s);
    }
    if (!settings_.layers.isEmpty()) accumulateLayersOfRow(pass, y);
  });
}

template <bool isOfHalf>
void Film::accumulateRow(const SamplePass& pass, int y, int slot) {
  const auto first = static_cast<std::ptrdiff_t>(y - pixelBounds_.min.y) * pixelBounds_.width();
  Sums* const row = state_.sums.data() + first;
  Sums* const oddRow = isOfHalf ? state_.odd.data() + first : nullptr;
  for (int x = pixelBounds_.min.x; x < pixelBounds_.max.x; ++x) {
    const std::ptrdiff_t column = x - pixelBounds_.min.x;
    Sums sums = row[column], odd = isOfHalf ? oddRow[column] : Sums{};
    visitNeighbours(pass, filter_, slot, {x, y},
                    [&](const SamplePass::Sample& sample, double weight, Point2i) {
                      const Sums part{weight * sample.radiance.r, weight * sample.radiance.g,
                                      weight * sample.radiance.b, weight};
                      sums += part;
                      if constexpr (isOfHalf) odd += part;
                    });
    row[column] = sums;
    if constexpr (isOfHalf) oddRow[column] = odd;
  }
}

void Film::accumulateLayersOfRow(const SamplePass& pass, int y) {
  const LayerSet& layers = settings_.layers;
  const std::size_t count = layers.sumCount();
  double* sums = state_.layers.data() + static_cast<std::size_t>(y - pixelBounds_.min.y) *
                                            static_cast<std::size_t>(pixelBounds_.width()) * count;
  for (int x = pixelBounds_.min.x; x < pixelBounds_.max.x; ++x, sums += count) {
    for (int s = 0; s < pass.samplesPerPixel(); ++s) {
      visitNeighbours(pass, filter_, s, {x, y},
                      [&](const SamplePass::Sample& sample, double weight, Point2i from) {
                        addFiltered(layers, pass.layerValues(from, s), sample.radiance, weight, sums);
                      });
      if (pass.at({x, y}, s).valid) addOwn(layers, pass.layerValues({x, y}, s), sums);
    }
  }
}

Image Film::develop() const {
  const LayerSet& layers = settings_.layers;
  std::vector<std::string> names = {"R", "G", "B"};
  names.insert(names.end(), layers.channelNames().begin(), layers.channelNames().end());
  Image image(pixelBounds_.width(), pixelBounds_.height(), names);
  image.dataWindow = pixelBounds_;
  image.displayWindow = {{0, 0}, settings_.resolution};
  const Development development = this->development();
  std::size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, ++i)
      developPixel(partsOf(i), layers, state_.paths, development, &image.at(x, y, 0));
  }
  return image;
}

PixelParts Film::partsOf(std::size_t pixel) const {
  const std::size_t layerSums = settings_.layers.sumCount();
  const auto splatsOf = [&](const std::vector<SplatSum>& all) {
    return all.empty() ? SplatSum{} : all[pixel];
  };
  return {state_.sums[pixel], std::span(state_.layers).subspan(pixel * layerSums, layerSums),
          splatsOf(state_.splats), splatsOf(state_.splatSquares)};
}

std::vector<double> Film::otherSums() const {
  const OtherSums order(settings_.layers, !state_.splats.empty());
  std::vector<double> others;
  others.reserve(state_.sums.size() * order.count());
  for (std::size_t pixel = 0; pixel < state_.sums.size(); ++pixel) order.append(partsOf(pixel), others);
  return others;
}

void Film::keepHalves() {
  if (hasHalves()) return;
  countBuilt(Part::FilmHalves);
  state_.odd.resize(state_.sums.size());
}

SplatSum Film::estimatedError(std::size_t pixel) const {
  SplatSum error;
  const Sums &all = state_.sums[pixel], &odd = state_.odd[pixel];
  const double even = all.weight - odd.weight;
  if (const double product = even * odd.weight; product != 0) {
    // Filters with negative lobes may give a half a negative weight; the halves are then taken as equal.
    const double scale = product > 0 ? std::sqrt(product) / all.weight : .5;
    const auto ofSamples = [&](double sum, double ofOdd) {
      return ((sum - ofOdd) / even - ofOdd / odd.weight) * scale;
    };
    error = {ofSamples(all.r, odd.r), ofSamples(all.g, odd.g), ofSamples(all.b, odd.b)};
  }
  const auto paths = static_cast<double>(state_.paths.count), oddPaths = static_cast<double>(state_.oddPaths),
             evenPaths = paths - oddPaths;
  if (state_.oddSplats.empty() || oddPaths == 0 || evenPaths == 0) return error;
  const SplatSum &splats = state_.splats[pixel], &oddSplats = state_.oddSplats[pixel];
  const double scale = std::sqrt(evenPaths * oddPaths) / paths * state_.paths.area;
  const auto ofSplats = [&](double sum, double ofOdd) {
    return ((sum - ofOdd) / evenPaths - ofOdd / oddPaths) * scale;
  };
  error +=
      {ofSplats(splats.r, oddSplats.r), ofSplats(splats.g, oddSplats.g), ofSplats(splats.b, oddSplats.b)};
  return error;
}

Image Film::surrogateReference() const {
  CHECK(hasHalves());
  Image image = develop();
  const auto scaled = [&](double error) {
    return static_cast<float>(error * static_cast<double>(settings_.scale));
  };
  std::size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, ++i) {
      const SplatSum error = estimatedError(i);
      image.setRgb(x, y, image.rgb(x, y) - Rgb(scaled(error.r), scaled(error.g), scaled(error.b)));
    }
  }
  return image;
}

void Film::sumOnly(int first, int end) {
  CHECK(pixelBounds_.min.y <= first && first <= end && end <= pixelBounds_.max.y);
  firstRow_ = first;
  endRow_ = end;
}

Film::State Film::rows(int first, int end) const {
  const auto width = static_cast<std::ptrdiff_t>(pixelBounds_.width());
  const auto part = [&](const auto& all, std::size_t perPixel) {
    if (all.empty()) return all;
    const std::ptrdiff_t perRow = width * static_cast<std::ptrdiff_t>(perPixel);
    return std::remove_cvref_t<decltype(all)>(all.begin() + (first - pixelBounds_.min.y) * perRow,
                                              all.begin() + (end - pixelBounds_.min.y) * perRow);
  };
  return {part(state_.sums, 1),
          part(state_.odd, 1),
          part(state_.layers, settings_.layers.sumCount()),
          part(state_.splats, 1),
          part(state_.oddSplats, 1),
          part(state_.splatSquares, 1),
          state_.paths,
          state_.oddPaths};
}

bool Film::setRows(int first, int end, const State& rows) {
  const std::size_t pixels =
      static_cast<std::size_t>(end - first) * static_cast<std::size_t>(pixelBounds_.width());
  const auto fits = [&](const auto& part, const auto& all, std::size_t perPixel) {
    return part.size() == (all.empty() ? 0 : pixels * perPixel);
  };
  const std::size_t layerSums = settings_.layers.sumCount();
  if (!fits(rows.sums, state_.sums, 1) || !fits(rows.odd, state_.odd, 1) ||
      !fits(rows.layers, state_.layers, layerSums) || !fits(rows.splats, state_.splats, 1) ||
      !fits(rows.oddSplats, state_.oddSplats, 1) || !fits(rows.splatSquares, state_.splatSquares, 1))
    return false;
  const auto offset = static_cast<std::ptrdiff_t>(first - pixelBounds_.min.y) * pixelBounds_.width();
  const auto place = [&](const auto& part, auto& all, std::size_t perPixel) {
    if (part.empty()) return;
    std::copy(part.begin(), part.end(), all.begin() + offset * static_cast<std::ptrdiff_t>(perPixel));
  };
  place(rows.sums, state_.sums, 1);
  place(rows.odd, state_.odd, 1);
  place(rows.layers, state_.layers, layerSums);
  place(rows.splats, state_.splats, 1);
  place(rows.oddSplats, state_.oddSplats, 1);
  place(rows.splatSquares, state_.splatSquares, 1);
  return true;
}

bool Film::restore(State state) {
  const std::size_t pixels = state_.sums.size();
  if (state.sums.size() != pixels || state.layers.size() != state_.layers.size() ||
      state.odd.size() != state_.odd.size())
    return false;
  const auto fits = [&](const std::vector<SplatSum>& sums, bool isKept) {
    return sums.size() == (isKept && !state.splats.empty() ? pixels : 0);
  };
  if (!fits(state.splats, true) || !fits(state.oddSplats, hasHalves()) ||
      !fits(state.splatSquares, settings_.layers.has(Layer::Variance)))
    return false;
  state_ = std::move(state);
  return true;
}

}  // namespace pbrtmedia
