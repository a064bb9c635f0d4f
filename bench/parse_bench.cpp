// SPDX-License-Identifier: BSD-2-Clause
// Speed and memory of reading a large inline array: writes a scene file with `count` numbers (default 10^7),
// parses it, checks values throughout, and prints MB per second of processor time (the parser has one thread;
// so other load does not matter) and the peak memory over the size of the array.
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/hash.h"
#include "scene/parser.h"

namespace {

using namespace pbrtmedia;

float valueAt(std::size_t i) { return static_cast<float>(mix64(i) >> 40) * 0x1p-24f; }

void append(std::string& text, float value, int digits) {
  char buffer[48];
  text.append(buffer,
              std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, digits).ptr);
}

/// Writes the scene; `digits` after the point.
void write(const std::filesystem::path& file, std::size_t count, int digits) {
  std::ofstream out(file, std::ios::binary);
  std::string text = "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"float density\" [\n";
  for (std::size_t i = 0; i < count; ++i) {
    append(text, valueAt(i), digits);
    text += i % 16 == 15 ? '\n' : ' ';
    if (text.size() > (1 << 20)) {
      out << text;
      text.clear();
    }
  }
  out << text << "]\nWorldBegin WorldEnd\n";
}

double peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10'000'000;
  const int digits = argc > 2 ? std::atoi(argv[2]) : 6;
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "parse_bench.pbrt";
  write(file, count, digits);
  const double megabytes = static_cast<double>(std::filesystem::file_size(file)) / 1e6;
  const std::filesystem::path files[] = {file};
  const double before = peakBytes();
  double best = 1e30, peak = 0;
  for (int trial = 0; trial < 5; ++trial) {
    Diagnostics diagnostics;
    const std::clock_t start = std::clock();
    const auto scenes = parseFiles(files, diagnostics);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    if (trial == 0) peak = peakBytes() - before;
    const Param* const density =
        scenes.size() == 1 ? scenes[0].media.at(0).params.find(ParamKind::Float, "density") : nullptr;
    if (diagnostics.hasErrors() || !density || density->size() != count) return EXIT_FAILURE;
    const auto& values = std::get<std::vector<float>>(density->values);
    std::string text;
    for (std::size_t i = 0; i < count; i += 997) {
      text.clear();
      append(text, valueAt(i), digits);
      if (values[i] != std::strtof(text.c_str(), nullptr)) return EXIT_FAILURE;
    }
  }
  std::filesystem::remove(file);
  std::printf("%zu numbers of %d digits, %.0f MB: %.0f MB/s, peak %.2f times the array\n", count, digits,
              megabytes, megabytes / best, peak / (4.0 * static_cast<double>(count)));
  return EXIT_SUCCESS;
}
