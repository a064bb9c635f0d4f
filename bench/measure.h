// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace pbrtmedia::bench {

/// Processor time of this thread, seconds: other programs slow it through shared caches only.
double threadSeconds();

/// Keeps the compiler from leaving out the computation of `value`.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r,m"(value) : "memory");
}

/// Trials of one measurement.
class Trials {
 public:
  void add(double value) { values_.push_back(value); }
  std::size_t count() const { return values_.size(); }
  double at(std::size_t i) const { return values_[i]; }
  double median() const { return quantile(.5); }
  /// Interquartile range over the median.
  double spread() const;

 private:
  double quantile(double q) const;
  std::vector<double> values_;
};

/// Median over trials of a / b, both measured in the same trial: load that both met cancels.
double medianRatio(const Trials& a, const Trials& b);

/// Compiler, flags, commit, CPU, instruction set of batches: what a number must be read with.
nlohmann::json environment();

/// Writes to `path`; exits with a message when that fails.
void writeJson(const nlohmann::json& json, const char* path);

}  // namespace pbrtmedia::bench
