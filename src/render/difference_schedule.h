// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace pbrtmedia {

/// An image of a scene and its share of a derivative.
struct DifferenceTerm {
  double value = 0;   ///< of the parameter
  double factor = 0;  ///< 1 / the parameter's unit
  bool operator==(const DifferenceTerm&) const = default;
};

/// Derivatives of images by a parameter as sums of images at a few of its values: finite differences of step
/// h, I(h) = (f(x + h) - f(x)) / h, and what makes the mean over passes better than one of them. Misso et
/// al. 2022, section 5.1 and Eqs. (20), (21).
///
/// Values are rounded to single precision, as scenes hold them, and a quotient is divided by the step between
/// those: rounding of the parameter is no error of the derivative.
class DifferenceSchedule {
 public:
  enum class Difference {
    Forward,  ///< (f(x + h) - f(x)) / h, the paper's; bias h f'' / 2
    Central   ///< (f(x + h) - f(x - h)) / 2h; bias h^2 f''' / 6
  };
  enum class Debias {
    None,        ///< I(h) in each pass
    Single,      ///< I(h) + (I(h / 2^(j+1)) - I(h / 2^j)) / Pr{j}, j drawn in each pass
    Progressive  ///< I(h k^-decay) in the k-th pass, from 1
  };
  struct Params {
    double value = 0;  ///< x
    double step = 0;   ///< h, of either sign
    Difference difference = Difference::Forward;
    Debias debias = Debias::None;
    /// In (0, 1). With visibility in the image the squared bias of the mean falls like N^(-2 decay) and its
    /// variance like N^(decay - 1): 1/3 balances them. The paper prints 1/6, which is that of a
    /// two-dimensional kernel.
    double decay = kDecay;
    std::uint64_t seed = 0;
  };
  static constexpr double kDecay = 1.0 / 3;
  /// Levels that `Single` may correct, at most. What is left out is the bias of the last, 2^-10 of that of h
  /// (4^-10 for central differences); beyond it the rounding of images, some 1e-7 f / h 4^j, would be more.
  static constexpr unsigned kMostLevels = 10;
  /// No step but the first is less than so many units in the last place of x: below, rounding inside of the
  /// renderer shows.
  static constexpr double kLeastUnits = 64;

  /// Throws SceneError when x and x + h are the same number in single precision, or no finite ones.
  explicit DifferenceSchedule(const Params& params);

  const Params& params() const { return params_; }
  /// Those of pass 0, 1 ...: a pure function of the seed and it. Each value once.
  std::vector<DifferenceTerm> terms(std::int64_t pass) const;
  /// Levels that `Single` corrects.
  unsigned levels() const { return levels_; }

 private:
  double stepOfLevel(unsigned level) const;
  double progressiveStep(std::int64_t pass) const;
  /// Adds factor * I(step).
  void addQuotient(double step, double factor, std::vector<DifferenceTerm>& terms) const;
  void addCorrection(std::int64_t pass, std::vector<DifferenceTerm>& terms) const;

  Params params_;
  double leastStep_;
  unsigned levels_ = 0;
};

}  // namespace pbrtmedia
