// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pbrtmedia {

/// Mean and central moments up to the fourth of a stream, in one pass and without cancellation; streams can
/// be joined, in a fixed order for a result that does not depend on threads. Pébay 2008, SAND2008-6212.
class Moments {
 public:
  /// All there is to it: what is made of it goes on as it would have.
  struct State {
    std::uint64_t count = 0;
    double mean = 0, m2 = 0, m3 = 0, m4 = 0;
  };
  Moments() = default;
  explicit Moments(const State& s) : count_(s.count), mean_(s.mean), m2_(s.m2), m3_(s.m3), m4_(s.m4) {}
  State state() const { return {count_, mean_, m2_, m3_, m4_}; }

  void add(double x) {
    const double n1 = static_cast<double>(count_);
    ++count_;
    const double n = static_cast<double>(count_);
    const double delta = x - mean_, step = delta / n, step2 = step * step, term = delta * step * n1;
    mean_ += step;
    m4_ += term * step2 * (n * n - 3 * n + 3) + 6 * step2 * m2_ - 4 * step * m3_;
    m3_ += term * step * (n - 2) - 3 * step * m2_;
    m2_ += term;
  }
  void add(const Moments& o) {
    if (o.count_ == 0) return;
    if (count_ == 0) {
      *this = o;
      return;
    }
    const double a = static_cast<double>(count_), b = static_cast<double>(o.count_), n = a + b;
    const double delta = o.mean_ - mean_, step = delta / n, step2 = step * step;
    m4_ += o.m4_ + delta * step * step2 * a * b * (a * a - a * b + b * b) +
           6 * step2 * (a * a * o.m2_ + b * b * m2_) + 4 * step * (a * o.m3_ - b * m3_);
    m3_ += o.m3_ + delta * step2 * a * b * (a - b) + 3 * step * (a * o.m2_ - b * m2_);
    m2_ += o.m2_ + delta * step * a * b;
    mean_ += step * b;
    count_ += o.count_;
  }

  std::uint64_t count() const { return count_; }
  /// NaN without a value, as all that follow without enough of them.
  double mean() const { return count_ > 0 ? mean_ : kNone; }
  double variance() const { return count_ > 1 ? m2_ / (n() - 1) : kNone; }
  double meanError() const { return count_ > 1 ? std::sqrt(variance() / n()) : kNone; }
  /// Standard error of variance(), from the fourth moment: for finite ones only.
  double varianceError() const {
    if (count_ < 4) return kNone;
    const double v = variance();
    return std::sqrt(std::max(0.0, (m4_ / n() - v * v * (n() - 3) / (n() - 1)) / n()));
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double n() const { return static_cast<double>(count_); }

  std::uint64_t count_ = 0;
  double mean_ = 0, m2_ = 0, m3_ = 0, m4_ = 0;
};

}  // namespace pbrtmedia
