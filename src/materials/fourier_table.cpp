// SPDX-License-Identifier: BSD-2-Clause
#include "materials/fourier_table.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/byte_stream.h"
#include "base/diagnostics.h"
#include "base/math.h"
#include "materials/catmull_rom.h"

namespace pbrtmedia {
namespace {

constexpr std::string_view kMagic("SCATFUN\x01", 8);

/// A whole number of the header, which must be in a range.
std::size_t headerNumber(ByteReader& in, std::string_view name, std::uint32_t least, std::uint32_t most) {
  const auto value = in.number<std::uint32_t>();
  if (value >= least && value <= most) return value;
  throw std::invalid_argument("found " + std::to_string(value) + " " + std::string(name) + ", expected " +
                              std::to_string(least) +
                              (most != least ? " to " + std::to_string(most) : std::string()));
}

/// Larger numbers make values that are not finite.
constexpr float kLargestNumber = 1e20f;

/// `count` numbers.
std::vector<float> numbers(ByteReader& in, std::size_t count, std::string_view name) {
  ByteReader bytes(in.take(std::uint64_t{count} * sizeof(float)));  // before memory is taken for them
  std::vector<float> list(count);
  for (float& number : list) {
    number = bytes.number<float>();
    if (!(std::abs(number) <= kLargestNumber))
      throw std::invalid_argument("a " + std::string(name) + " that is no finite number up to 1e20");
  }
  return list;
}

}  // namespace

FourierTable FourierTable::parse(std::string_view bytes, const std::string& shownName) {
  const auto fail = [&](const std::string& what) -> SceneError {
    return {SourceLocation{.file = std::make_shared<std::string>(shownName)},
            "not a tabulated BSDF: " + what};
  };
  try {
    ByteReader in(bytes);
    if (in.take(std::min(in.left(), kMagic.size())) != kMagic) throw fail("it does not begin with SCATFUN");
    FourierTable table;
    constexpr std::uint32_t kMostCosines = 1u << 14, kMostCoefficients = (1u << 31) - 1;
    headerNumber(in, "as flags", 1, 1);
    const std::size_t n = headerNumber(in, "cosines", 2, kMostCosines);
    const std::size_t coefficients = headerNumber(in, "coefficients", 0, kMostCoefficients);
    const std::size_t longest = headerNumber(in, "orders", 0, kMostCoefficients);
    table.channels_ = headerNumber(in, "channels", 1, 3);
    if (table.channels_ == 2) throw fail("found 2 channels, expected 1 or 3");
    headerNumber(in, "bases", 1, 1);
    in.take(3 * sizeof(std::uint32_t));
    table.eta_ = in.number<float>();
    constexpr float kLeastIndex = 1e-3f, kMostIndex = 1e3f;
    if (!(table.eta_ >= kLeastIndex && table.eta_ <= kMostIndex))
      throw fail("its index of refraction is not in 0.001 to 1000");
    in.take(4 * sizeof(std::uint32_t));
    table.mu_ = numbers(in, n, "cosine");
    if (table.mu_.front() < -1 || table.mu_.back() > 1) throw fail("cosines are not in [-1, 1]");
    if (std::ranges::adjacent_find(table.mu_, std::greater_equal<>()) != table.mu_.end())
      throw fail("cosines do not increase");
    in.take(std::uint64_t{n} * n * sizeof(float));  // integrals, which are computed anew
    ByteReader pairs(in.take(std::uint64_t{n} * n * 2 * sizeof(std::uint32_t)));
    table.coefficients_ = numbers(in, coefficients, "coefficient");
    table.entries_.resize(n * n);
    for (Entry& e : table.entries_) {
      e.offset = pairs.number<std::uint32_t>();
      e.length = pairs.number<std::uint32_t>();
      if (e.length > longest) throw fail("a series of more orders than its header tells");
      if (std::uint64_t{e.offset} + std::uint64_t{e.length} * table.channels_ > coefficients)
        throw fail("a series beyond its coefficients");
    }
    table.integrate();
    return table;
  } catch (const std::length_error&) {
    throw fail("it is truncated");
  } catch (const std::invalid_argument& e) {
    throw fail(e.what());
  }
}

void FourierTable::integrate() {
  const std::size_t n = mu_.size();
  cumulative_.resize(n * n);
  std::vector<float> row(n);
  for (std::size_t o = 0; o < n; ++o) {
    for (std::size_t i = 0; i < n; ++i) row[i] = mean(o, i);
    integrateSpline(mu_, row, std::span(cumulative_).subspan(o * n, n));
  }
}

FourierTable::Blend::Blend(const FourierTable& table, float muI, float muO) : table_(table) {
  const auto i = splineWeights(table.mu_, muI), o = splineWeights(table.mu_, muO);
  if (!i || !o) return;
  for (std::size_t b = 0; b < 4; ++b) {
    for (std::size_t a = 0; a < 4; ++a) {
      const float weight = i->weight[a] * o->weight[b];
      if (weight == 0) continue;
      const Entry& e = table.entry(static_cast<std::size_t>(o->first + static_cast<std::ptrdiff_t>(b)),
                                   static_cast<std::size_t>(i->first + static_cast<std::ptrdiff_t>(a)));
      if (e.length == 0) continue;
      parts_[count_++] = {e, weight};
      longest_ = std::max(longest_, e.length);
    }
  }
}

float FourierTable::Blend::channel(std::size_t c, float cosPhi) const {
  // cos(k phi) by Chebyshev's recurrence.
  const auto cosine = static_cast<double>(cosPhi);
  double previous = cosine, now = 1, sum = 0;
  for (std::uint32_t k = 0; k < longest_; ++k) {
    float a = 0;
    for (std::size_t p = 0; p < count_; ++p) {
      const auto& [e, weight] = parts_[p];
      if (k < e.length) a += weight * table_.coefficients_[e.offset + c * e.length + k];
    }
    sum += static_cast<double>(a) * now;
    previous = std::exchange(now, 2 * cosine * now - previous);
  }
  return static_cast<float>(sum);
}

Rgb FourierTable::Blend::value(float cosPhi) const {
  const float y = std::max(0.0f, channel(0, cosPhi));
  if (table_.channels_ == 1 || count_ == 0) return Rgb(y);
  const float r = channel(1, cosPhi), b = channel(2, cosPhi);
  return Rgb(r, 1.39829f * y - 0.100913f * b - 0.297375f * r, b).nonNegative();
}

float FourierTable::Blend::samplePhi(float u) const {
  std::vector<double> a(longest_);
  for (std::size_t p = 0; p < count_; ++p) {
    const auto& [e, weight] = parts_[p];
    for (std::uint32_t k = 0; k < e.length; ++k)
      a[k] += static_cast<double>(weight * table_.coefficients_[e.offset + k]);
  }
  // The luminance is even in phi: one half of it, which u tells.
  const bool isSecond = u >= 0.5f;
  const double half = isSecond ? 2 - 2 * static_cast<double>(u) : 2 * static_cast<double>(u);
  double phi = half * std::numbers::pi;
  if (a.empty() || !(a[0] > 0)) return static_cast<float>(phi);
  // a0 phi + Σ a_k sin(k phi) / k by Newton's steps in a bracket.
  const double target = half * a[0] * std::numbers::pi;
  double lo = 0, hi = std::numbers::pi;
  constexpr int kSteps = 40;
  for (int step = 0; step < kSteps; ++step) {
    if (!(phi > lo && phi < hi)) phi = 0.5 * (lo + hi);
    const double cosine = std::cos(phi), sine = std::sin(phi);
    double c0 = cosine, c1 = 1, s0 = -sine, s1 = 0, integral = a[0] * phi, value = a[0];
    for (std::size_t k = 1; k < a.size(); ++k) {
      c0 = std::exchange(c1, 2 * cosine * c1 - c0);
      s0 = std::exchange(s1, 2 * cosine * s1 - s0);
      integral += a[k] * s1 / static_cast<double>(k);
      value += a[k] * c1;
    }
    const double off = integral - target;
    (off < 0 ? lo : hi) = phi;
    constexpr double kWidth = 1e-7;
    if (std::abs(off) < kWidth * a[0] || hi - lo < kWidth) break;
    phi -= off / value;
  }
  return static_cast<float>(isSecond ? 2 * std::numbers::pi - phi : phi);
}

float FourierTable::Blend::whole(const FourierTable& table, float muO) {
  const auto o = splineWeights(table.mu_, muO);
  const std::size_t n = table.mu_.size();
  return o ? 2 * kPi * o->sum([&](std::size_t k) { return table.cumulative_[k * n + n - 1]; }) : 0;
}

float FourierTable::Blend::sampleMu(const FourierTable& table, float muO, float u) {
  const std::size_t n = table.mu_.size();
  const auto o = splineWeights(table.mu_, muO);
  std::vector<float> values(n), cumulative(n);
  for (std::size_t i = 0; i < n; ++i) {
    values[i] = o->sum([&](std::size_t k) { return table.mean(k, i); });
    cumulative[i] = o->sum([&](std::size_t k) { return table.cumulative_[k * n + i]; });
  }
  return sampleSpline(table.mu_, values, cumulative, u);
}

}  // namespace pbrtmedia
