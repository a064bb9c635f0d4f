// SPDX-License-Identifier: BSD-2-Clause
#include "image/splat_sums.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <string>

#include "image/image.h"

namespace pbrtmedia {
namespace {

constexpr const char *kCount = "splatPaths", *kArea = "splatArea";

template <class Number>
std::string textOf(Number number) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

template <class Number>
Number numberOf(const Image& image, const char* key) {
  const auto found = image.metadata.find(key);
  Number number = 0;
  if (found == image.metadata.end())
    throw std::invalid_argument("metadata \"" + std::string(key) + "\" is missing");
  const std::string& text = found->second;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || end != text.data() + text.size() || !(number > 0)) {
    throw std::invalid_argument("metadata \"" + std::string(key) + "\" should be a number above 0, found \"" +
                                text + '"');
  }
  return number;
}

}  // namespace

SplatSum SplatPaths::mean(const SplatSum& sum) const {
  const double each = count > 0 ? area / static_cast<double>(count) : 0;
  return {sum.r * each, sum.g * each, sum.b * each};
}

SplatSum SplatPaths::varianceOfMean(const SplatSum& sum, const SplatSum& squares) const {
  if (count < 2) return {};
  const auto n = static_cast<double>(count);
  const auto one = [&](double s, double s2) {
    return std::max(0.0, s2 / n - (s / n) * (s / n)) / (n - 1) * area * area;
  };
  return {one(sum.r, squares.r), one(sum.g, squares.g), one(sum.b, squares.b)};
}

void putSplatPaths(const SplatPaths& paths, Image& image) {
  image.metadata[kCount] = textOf(paths.count);
  image.metadata[kArea] = textOf(paths.area);
}

bool hasSplatPaths(const Image& image) { return image.metadata.contains(kCount); }

SplatPaths splatPathsOf(const Image& image) {
  return {numberOf<std::uint64_t>(image, kCount), numberOf<double>(image, kArea)};
}

}  // namespace pbrtmedia
