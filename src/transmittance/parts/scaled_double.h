// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace pbrtmedia {

/// mantissa * 2^exponent with an exponent of 64 bits: sums of terms like e^p y^k / k!, each of which may
/// leave the range of double although the sum does not. Relative error of each operation that of double; of
/// exp(x) also |x| 2^-53. Operands: finite.
class ScaledDouble {
 public:
  ScaledDouble(double value = 0) : mantissa_(value) { normalise(); }  // NOLINT: a double is one
  static ScaledDouble exp(double x) {
    constexpr double kLn2 = 0.69314718055994530942, kDirect = 600;
    if (std::abs(x) < kDirect) return std::exp(x);
    const double exponent = std::floor(x / kLn2);
    ScaledDouble result(std::exp(x - exponent * kLn2));
    result.exponent_ += static_cast<std::int64_t>(exponent);
    return result;
  }

  ScaledDouble& operator*=(const ScaledDouble& o) {
    mantissa_ *= o.mantissa_;
    exponent_ += o.exponent_;
    normalise();
    return *this;
  }
  ScaledDouble& operator+=(const ScaledDouble& o) {
    if (o.mantissa_ == 0) return *this;
    if (mantissa_ == 0) return *this = o;
    const std::int64_t shift = o.exponent_ - exponent_;
    if (shift > 0) {
      mantissa_ = std::ldexp(mantissa_, clamped(-shift)) + o.mantissa_;
      exponent_ = o.exponent_;
    } else {
      mantissa_ += std::ldexp(o.mantissa_, clamped(shift));
    }
    normalise();
    return *this;
  }
  friend ScaledDouble operator*(ScaledDouble a, const ScaledDouble& b) { return a *= b; }

  bool isZero() const { return mantissa_ == 0; }
  /// As a double: infinite or 0 beyond its range.
  double value() const { return std::ldexp(mantissa_, clamped(exponent_)); }

 private:
  static int clamped(std::int64_t exponent) {
    constexpr std::int64_t kBeyond = 4096;  // no double but 0 times 2^+-kBeyond is in the range of double
    return static_cast<int>(exponent > kBeyond ? kBeyond : exponent < -kBeyond ? -kBeyond : exponent);
  }
  void normalise() {
    int shift = 0;
    mantissa_ = std::frexp(mantissa_, &shift);
    exponent_ = mantissa_ == 0 ? 0 : exponent_ + shift;
  }

  double mantissa_;  ///< 0, or its magnitude in [1/2, 1)
  std::int64_t exponent_ = 0;
};

}  // namespace pbrtmedia
