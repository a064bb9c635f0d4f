// SPDX-License-Identifier: BSD-2-Clause
#include "measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "fields/grid_batch.h"

namespace pbrtmedia::bench {

double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double Trials::quantile(double q) const {
  std::vector<double> sorted = values_;
  std::sort(sorted.begin(), sorted.end());
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const double next = sorted[std::min(i + 1, sorted.size() - 1)];
  return sorted[i] + (at - std::floor(at)) * (next - sorted[i]);
}

double Trials::spread() const { return (quantile(.75) - quantile(.25)) / median(); }

double medianRatio(const Trials& a, const Trials& b) {
  Trials ratios;
  for (std::size_t i = 0; i < std::min(a.count(), b.count()); ++i) ratios.add(a.at(i) / b.at(i));
  return ratios.median();
}

nlohmann::json environment() {
  std::string cpu = "unknown", line;
  for (std::ifstream file("/proc/cpuinfo"); std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) {
      cpu = line.substr(line.find(':') + 2);
      break;
    }
  }
  return {{"compiler", PBRT_MEDIA_COMPILER},
          {"flags", PBRT_MEDIA_FLAGS},
          {"commit", PBRT_MEDIA_COMMIT},
          {"cpu", cpu},
          {"simd", gridBatchTarget()}};
}

void writeJson(const nlohmann::json& json, const char* path) {
  std::ofstream out(path);
  out << json.dump(2) << '\n';
  if (!out.flush()) {
    std::fprintf(stderr, "error: cannot write %s\n", path);
    std::exit(EXIT_FAILURE);
  }
}

}  // namespace pbrtmedia::bench
