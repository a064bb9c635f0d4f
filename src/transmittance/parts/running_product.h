// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace pbrtmedia {

/// A product of many factors times exp(logScale), whose exponent neither overflows nor underflows on the way:
/// e^{-tau} tau^k / k! stays right where its parts leave the range of double. Factors: finite.
class RunningProduct {
 public:
  explicit RunningProduct(double logScale = 0) : logScale_(logScale), halfScale_(std::exp(logScale / 2)) {}

  void multiply(double factor) {
    mantissa_ *= factor;
    const double size = std::abs(mantissa_);
    if (!(size < kLarge && size > kSmall)) [[unlikely]] {
      rescale();
    }
  }
  bool isZero() const { return mantissa_ == 0; }

  /// |product| without exp(logScale): 0 or infinite where no double is left.
  double magnitude() const { return std::abs(product()); }
  double product() const { return times(1); }
  /// product * x, x finite; right also where the product alone has no double.
  double times(double x) const {
    const double scaled = mantissa_ * x;
    return exponent_ == 0 ? scaled : std::ldexp(scaled, clamped(exponent_));
  }
  /// product * exp(logScale); infinite beyond the range of double, never NaN.
  double value() const { return mantissa_ * halfScale_ * halfScale_; }
  /// product * exp(logScale + x).
  double timesExp(double x) const {
    const double half = std::exp((logScale_ + static_cast<double>(exponent_) * kLn2 + x) / 2);
    return mantissa_ * half * half;
  }
  /// ln |product|, -infinity for 0.
  double logMagnitude() const {
    return std::log(std::abs(mantissa_)) + static_cast<double>(exponent_) * kLn2;
  }
  /// product = mantissa() * 2^exponent(), |mantissa()| within 2^-200 and 2^200, or 0.
  double mantissa() const { return mantissa_; }
  std::int64_t exponent() const { return exponent_; }

 private:
  static constexpr double kLarge = 0x1p200, kSmall = 0x1p-200, kLn2 = 0.69314718055994530942;

  static int clamped(std::int64_t exponent) {
    constexpr std::int64_t kBeyond = 4096;  // no double times 2^kBeyond is finite but 0
    return static_cast<int>(exponent > kBeyond ? kBeyond : exponent < -kBeyond ? -kBeyond : exponent);
  }
  void rescale() {
    int shift = 0;
    mantissa_ = std::frexp(mantissa_, &shift);
    exponent_ = mantissa_ == 0 ? 0 : exponent_ + shift;
    halfScale_ = std::exp((logScale_ + static_cast<double>(exponent_) * kLn2) / 2);
  }

  double mantissa_ = 1;
  std::int64_t exponent_ = 0;
  double logScale_, halfScale_;
};

/// Adds a term to a sum that may have left the range of double: an infinite sum stays what it is, as the
/// difference of two infinities would be NaN.
inline void addTerm(double& sum, double term) {
  if (std::isfinite(sum)) sum += term;
}

}  // namespace pbrtmedia
