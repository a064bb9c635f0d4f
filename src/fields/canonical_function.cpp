// SPDX-License-Identifier: BSD-2-Clause
#include "fields/canonical_function.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "base/math.h"

namespace pbrtmedia {
namespace {

using Stretch = CanonicalFunction::Stretch;

/// Grid points per shortest period (or sigma) in the search for turning points.
constexpr double kPointsPerPeriod = 32;

bool isPolynomial(const Stretch& s) { return s.waves.empty() && s.bumps.empty(); }
bool isStraight(const Stretch& s) { return isPolynomial(s) && s.square == 0 && s.cube == 0; }

double valueOf(const Stretch& s, double begin, double x) {
  const double u = x - begin;
  double f = s.constant + u * (s.slope + u * (s.square + u * s.cube));
  for (const auto& w : s.waves) f += w.amplitude * std::cos(w.frequency * x + w.phase);
  for (const auto& b : s.bumps) {
    const double z = (x - b.centre) / b.sigma;
    f += b.height * std::exp(-z * z / 2);
  }
  return f;
}

/// What no value on [from, to] exceeds (sign 1) or falls below (sign -1), rounding included: the terms of
/// valueOf at their extremes, added in its order.
double limitOf(const Stretch& s, double begin, double from, double to, double sign) {
  const auto extreme = [&](double a, double b) { return sign > 0 ? std::max(a, b) : std::min(a, b); };
  // What a power of u is multiplied by, from the outermost parenthesis on; u >= 0.
  const double u0 = from - begin, u1 = to - begin;
  double factor = s.cube;
  for (const double next : {s.square, s.slope}) factor = next + extreme(u0 * factor, u1 * factor);
  double f = s.constant + extreme(u0 * factor, u1 * factor);
  for (const auto& w : s.waves) f += extreme(w.amplitude, -w.amplitude);
  for (const auto& b : s.bumps) f += extreme(b.height, 0.0);
  return f;
}

double slopeOf(const Stretch& s, double begin, double x) {
  const double u = x - begin;
  double f = s.slope + u * (2 * s.square + u * 3 * s.cube);
  for (const auto& w : s.waves) f -= w.amplitude * w.frequency * std::sin(w.frequency * x + w.phase);
  for (const auto& b : s.bumps) {
    const double z = (x - b.centre) / b.sigma;
    f -= b.height * z / b.sigma * std::exp(-z * z / 2);
  }
  return f;
}

/// Integral over [a, b] without the clamp.
double integralOf(const Stretch& s, double begin, double a, double b) {
  const double u = a - begin, v = b - begin;
  double sum = (s.constant + s.slope * (u + v) / 2 + s.square * (u * u + u * v + v * v) / 3 +
                s.cube * (u + v) * (u * u + v * v) / 4) *
               (b - a);
  for (const auto& w : s.waves) {
    // The difference of two sines as a product: no cancellation on short intervals.
    sum += 2 * w.amplitude / w.frequency * std::sin(w.frequency * (b - a) / 2) *
           std::cos(w.frequency * (a + b) / 2 + w.phase);
  }
  for (const auto& g : s.bumps) {
    const double inverse = 1 / (g.sigma * std::sqrt(2.0));
    sum += g.height * g.sigma * std::sqrt(std::numbers::pi / 2) *
           (std::erf((b - g.centre) * inverse) - std::erf((a - g.centre) * inverse));
  }
  return sum;
}

/// Size of the terms: the unit of rounding errors. 0 for straight lines, whose rounded values keep order, so
/// that their extrema are those at the ends exactly.
double magnitudeOf(const Stretch& s, double begin) {
  if (isStraight(s)) return 0;
  const double u = s.end - begin;
  double sum =
      std::abs(s.constant) + u * (std::abs(s.slope) + u * (std::abs(s.square) + u * std::abs(s.cube)));
  for (const auto& w : s.waves) sum += std::abs(w.amplitude);
  for (const auto& b : s.bumps) sum += std::abs(b.height);
  return sum;
}

/// Root of g in [a, b], where it changes sign, to the last digit.
template <class G>
double bisect(const G& g, double a, double b) {
  const bool isPositiveAtA = g(a) > 0;
  for (;;) {
    const double middle = a + (b - a) / 2;
    if (!(middle > a && middle < b)) return middle;
    ((g(middle) > 0) == isPositiveAtA ? a : b) = middle;
  }
}

/// Where the derivative changes sign inside (begin, s.end), increasing.
std::vector<double> turningPoints(const Stretch& s, double begin) {
  std::vector<double> found;
  if (isStraight(s)) return found;
  if (isPolynomial(s)) {
    double roots[2];
    if (!solveQuadratic(3 * s.cube, 2 * s.square, s.slope, roots[0], roots[1])) return found;
    for (const double u : roots) {
      const double x = begin + u;
      if (x > begin && x < s.end && (found.empty() || x > found.back())) found.push_back(x);
    }
    return found;
  }
  double step = (s.end - begin) / 64;
  for (const auto& w : s.waves) step = std::min(step, 2 * std::numbers::pi / w.frequency / kPointsPerPeriod);
  for (const auto& b : s.bumps) step = std::min(step, b.sigma / kPointsPerPeriod);
  const auto count = static_cast<std::size_t>(std::ceil((s.end - begin) / step));
  const auto derivative = [&](double x) { return slopeOf(s, begin, x); };
  double a = begin, slopeA = derivative(a);
  for (std::size_t i = 1; i <= count; ++i) {
    const double b =
        i == count ? s.end : begin + (s.end - begin) * static_cast<double>(i) / static_cast<double>(count);
    const double slopeB = derivative(b);
    if (slopeA * slopeB < 0) found.push_back(bisect(derivative, a, b));
    if (slopeB == 0 && i != count) found.push_back(b);
    a = b;
    slopeA = slopeB;
  }
  return found;
}

}  // namespace

CanonicalFunction::CanonicalFunction(About about, std::vector<Stretch> stretches)
    : about_(std::move(about)), stretches_(std::move(stretches)) {
  double begin = 0;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    if (!(stretches_[i].end > begin)) throw std::invalid_argument(about_.name + ": stretches must increase");
    addPieces(i, begin);
    begin = stretches_[i].end;
  }
  if (stretches_.empty()) throw std::invalid_argument(about_.name + ": no stretch");
  knots_.push_back(begin);
  if (about_.topEfficiency == 0) about_.topEfficiency = 0.95 * integral() / (width() * range().max);
}

void CanonicalFunction::addPieces(std::size_t index, double begin) {
  const Stretch& s = stretches_[index];
  const double origin = begin;
  isPiecewisePolynomial_ = isPiecewisePolynomial_ && isPolynomial(s);
  const std::vector<double> turns = turningPoints(s, begin);
  turns_.insert(turns_.end(), turns.begin(), turns.end());
  // Between turning points f is monotone, so it meets 0 at most once.
  std::vector<double> ends;
  double a = begin;
  const auto cutAtZero = [&](double b) {
    const auto value = [&](double x) { return valueOf(s, origin, x); };
    if (value(a) * value(b) < 0) ends.push_back(bisect(value, a, b));
    a = b;
  };
  for (const double turn : turns) cutAtZero(turn);
  cutAtZero(s.end);
  ends.push_back(s.end);
  for (const double end : ends) {
    // A function that only touches 0 is not clamped.
    const bool isClamped = valueOf(s, origin, begin + (end - begin) / 2) < 0;
    const double before =
        pieces_.empty() ? 0.0 : integralTo(pieces_.back().end);  // of the pieces made so far
    knots_.push_back(begin);
    pieces_.push_back({begin, end, index, isClamped, before});
    begin = end;
  }
}

std::size_t CanonicalFunction::stretchAt(double x) const {
  const auto at = std::upper_bound(stretches_.begin(), stretches_.end(), x,
                                   [](double value, const Stretch& s) { return value < s.end; });
  return at == stretches_.end() ? stretches_.size() - 1 : static_cast<std::size_t>(at - stretches_.begin());
}

double CanonicalFunction::operator()(double x) const {
  x = std::clamp(x, 0.0, width());
  const std::size_t i = stretches_.size() == 1 ? 0 : stretchAt(x);
  return std::max(0.0, valueOf(stretches_[i], beginOf(i), x));
}

double CanonicalFunction::integralTo(double x) const {
  const auto at =
      std::partition_point(pieces_.begin(), pieces_.end(), [&](const Piece& piece) { return piece.end < x; });
  const Piece& piece = at == pieces_.end() ? pieces_.back() : *at;
  const double end = std::clamp(x, piece.begin, piece.end);
  return piece.integralBefore + (piece.isClamped
                                     ? 0
                                     : std::max(0.0, integralOf(stretches_[piece.stretch],
                                                                beginOf(piece.stretch), piece.begin, end)));
}

CanonicalFunction::Range CanonicalFunction::range(double a, double b) const {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  double begin = 0;
  for (const Stretch& s : stretches_) {
    const double from = std::max(a, begin), to = std::min(b, s.end);
    if (from <= to) {
      const double slack = 8 * std::numeric_limits<double>::epsilon() * magnitudeOf(s, begin);
      const double least = limitOf(s, begin, from, to, -1), most = limitOf(s, begin, from, to, 1);
      const auto include = [&](double x) {
        const double value = valueOf(s, begin, x);
        range.min = std::min(range.min, std::max({0.0, value - slack, least}));
        range.max = std::max(range.max, std::max(0.0, std::min(value + slack, most)));
      };
      include(from);
      include(to);
      for (auto turn = std::upper_bound(turns_.begin(), turns_.end(), from);
           turn != turns_.end() && *turn < to; ++turn) {
        include(*turn);
      }
    }
    begin = s.end;
  }
  return range;
}

}  // namespace pbrtmedia
