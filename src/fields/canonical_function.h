// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pbrtmedia {

/// A one-dimensional density f(x) >= 0 on [0, width()] whose integral and extrema are known exactly: the test
/// functions of the papers, tables, and lines through volumes. It is glued from stretches, on each of which,
/// with u the distance from where it begins,
///   f(x) = max(0, constant + slope u + square u^2 + cube u^3 + sum of amplitude cos(frequency x + phase)
///                + sum of height exp(-(x - centre)^2 / (2 sigma^2))).
/// At a jump the value of the stretch that begins there counts. Immutable, thread-safe.
class CanonicalFunction {
 public:
  struct Wave {
    double amplitude, frequency, phase;  ///< frequency: radians per unit of x
  };
  struct Bump {
    double height, centre, sigma;
  };
  struct Stretch {
    double end;  ///< where the next stretch begins; ends increase
    double constant = 0, slope = 0, square = 0, cube = 0;
    std::vector<Wave> waves = {};
    std::vector<Bump> bumps = {};
  };
  struct Range {
    double min, max;
  };
  struct About {
    std::string name;     ///< keyword
    std::string formula;  ///< at optical depth 1 as the source counts it
    std::string source;   ///< paper, or why it is here
    /// Largest depth / depth of the control on the axes of plots; 0: 95 % of what the tight one has.
    double topEfficiency = 0;
  };

  CanonicalFunction(About about, std::vector<Stretch> stretches);

  const About& about() const { return about_; }
  double width() const { return stretches_.back().end; }
  /// f at x, which is clamped to the domain.
  double operator()(double x) const;
  /// Integral over [a, b], 0 <= a <= b <= width(); closed form, relative error about 1e-15 of the whole.
  double integral(double a, double b) const { return integralTo(b) - integralTo(a); }
  double integral() const { return integralTo(width()); }
  /// Infimum and supremum over [a, b], both values of a jump included, up to a few roundings outwards.
  Range range(double a, double b) const;
  Range range() const { return range(0, width()); }
  /// Where f stops being smooth: both ends, jumps, and where it meets the clamp at 0.
  std::span<const double> knots() const { return knots_; }
  /// Polynomials of degree <= 3 between the knots.
  bool isPiecewisePolynomial() const { return isPiecewisePolynomial_; }

 private:
  struct Piece {  ///< between two knots: smooth, and either positive or clamped inside
    double begin, end;
    std::size_t stretch;
    bool isClamped;
    double integralBefore;
  };
  std::size_t stretchAt(double x) const;
  double beginOf(std::size_t stretch) const { return stretch == 0 ? 0 : stretches_[stretch - 1].end; }
  double integralTo(double x) const;
  void addPieces(std::size_t stretch, double begin);

  About about_;
  std::vector<Stretch> stretches_;
  std::vector<double> knots_, turns_;  ///< turns: where the derivative changes sign, inside stretches
  std::vector<Piece> pieces_;
  bool isPiecewisePolynomial_ = true;
};

/// Keywords of the functions of the papers and of our own, in the order of `medialab list`.
std::vector<std::string_view> canonicalFunctionNames();
/// The function called `name`; nothing when there is none.
std::optional<CanonicalFunction> findCanonicalFunction(std::string_view name);

/// Keywords of families of functions, one for each place on a second axis.
std::vector<std::string_view> densityFamilyNames();
/// The member of the family `name` at u in [0, 1]; nothing when there is no such family.
std::optional<CanonicalFunction> findDensityFamily(std::string_view name, double u);

}  // namespace pbrtmedia
