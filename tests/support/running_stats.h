// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace pbrtmedia::test {

/// Mean and variance of a stream in one pass, without cancellation. Welford 1962, doi:10.2307/1266577.
class RunningStats {
 public:
  void add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (x - mean_);
  }
  /// Joins two streams. Chan et al. 1983, doi:10.1080/00031305.1983.10483115.
  void add(const RunningStats& o) {
    if (o.count_ == 0) return;
    const double n = static_cast<double>(count_), m = static_cast<double>(o.count_), delta = o.mean_ - mean_;
    mean_ += delta * m / (n + m);
    squares_ += o.squares_ + delta * delta * n * m / (n + m);
    count_ += o.count_;
  }

  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Unbiased variance of one value; 0 for fewer than two values.
  double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0; }
  /// Standard error of the mean of independent values.
  double standardError() const {
    return count_ > 0 ? std::sqrt(variance() / static_cast<double>(count_)) : 0;
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

}  // namespace pbrtmedia::test
