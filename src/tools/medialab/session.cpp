// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/session.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/files.h"
#include "base/writable.h"

namespace pbrtmedia {
namespace {

constexpr double kLiveInterval = 0.1, kPlainInterval = 5;  // seconds

/// As a shell reads it back.
std::string shellWord(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=,.:/+%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  quoted += '\'';
  return quoted;
}

std::string fileName(std::string_view path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

std::string commandText(int argc, const char* const* argv) {
  constexpr std::array<std::string_view, 3> kFiles{"-o", "--outfile", "--picture"};
  std::string text = "medialab";
  for (int i = 1; i < argc; ++i) {
    std::string_view word = argv[i];
    const std::size_t equals = word.find('=');
    const std::string_view option = word.substr(0, equals);
    if (word == "--quiet") continue;
    if (option == "--nthreads" || option == "--threads") {
      if (equals == std::string_view::npos) ++i;
      continue;
    }
    text += ' ';
    if (std::find(kFiles.begin(), kFiles.end(), option) == kFiles.end()) {
      text += shellWord(word);
    } else if (equals != std::string_view::npos) {
      text += shellWord(std::string(option) + '=' + fileName(word.substr(equals + 1)));
    } else {
      text += option;
      if (i + 1 < argc) {
        text += ' ';
        text += shellWord(fileName(argv[++i]));
      }
    }
  }
  return text;
}

LabProgress::LabProgress(std::string title, std::size_t total, bool quiet)
    : title_(std::move(title)),
      total_(total),
      isSilent_(quiet),
      isTerminal_(::isatty(STDERR_FILENO) == 1),
      last_(watch_.seconds()) {}

LabProgress::~LabProgress() {
  if (shown_ && isTerminal_) std::cerr << '\r' << std::string(78, ' ') << '\r' << std::flush;
}

void LabProgress::update(std::size_t done, const std::string& what) {
  if (isSilent_) return;
  const double now = watch_.seconds();
  if (now - last_ < (isTerminal_ ? kLiveInterval : kPlainInterval)) return;
  last_ = now;
  std::string line = title_ + ": " + std::to_string(done) + " of " + std::to_string(total_);
  if (!what.empty()) line += ", " + what;
  line += ", " + std::to_string(static_cast<long>(now)) + " s";
  if (isTerminal_) {
    line.resize(78, ' ');
    std::cerr << '\r' << line << std::flush;
  } else {
    std::cerr << line << std::endl;
  }
  shown_ = true;
}

void writeOutput(const std::string& outfile, const std::function<void(std::ostream&)>& write) {
  if (outfile.empty()) {
    write(std::cout);
    return;
  }
  writeFileAtomically(outfile, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    write(out);
    out.flush();
    if (!out) throw std::runtime_error("cannot write " + outfile);
  });
}

void writeTable(const LabTable& table, const LabOptions& options) {
  writeOutput(options.outfile, [&](std::ostream& out) { table.write(out, tableFormat(options)); });
}

std::string extensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void checkOutput(const LabOptions& options) {
  tableFormat(options);
  if (!options.outfile.empty()) checkWritable(options.outfile);
}

TableFormat tableFormat(const LabOptions& options) {
  const std::string extension = extensionOf(options.outfile);
  const bool isCsv = extension == ".csv", isJson = extension == ".json";
  if (options.format) {
    const bool isOther = *options.format == TableFormat::Csv ? isJson : isCsv;
    if (!isOther) return *options.format;
    throw std::runtime_error(options.outfile + ": --format asks for another format than the name ends in");
  }
  if (isJson) return TableFormat::Json;
  if (isCsv || options.outfile.empty()) return TableFormat::Csv;
  throw std::runtime_error(options.outfile +
                           ": unknown extension; known: .csv, .json (or name the --format)");
}

}  // namespace pbrtmedia
