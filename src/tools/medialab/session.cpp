// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/session.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/files.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/writable.h"
#include "tools/build_info.h"
#include "tools/command_line.h"

namespace pbrtmedia {
namespace {

constexpr double kLiveInterval = 0.1, kPlainInterval = 5;  // seconds
/// What is done so soon cost nothing: it was found in a journal.
constexpr double kFree = 0.2;  // seconds

std::string fileName(std::string_view path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

namespace {

/// What becomes of an option and its value in a text about a command.
enum class Keep { Whole, FileName, Nothing };

/// The words of a command line, each option by `keepOf` with its value behind "=" or in the next word.
/// `quoted` makes text of what is kept.
template <class KeepOf, class Quoted>
std::string textOf(int argc, const char* const* argv, const KeepOf& keepOf, const Quoted& quoted) {
  std::string text = "medialab";
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const std::size_t equals = word.find('=');
    const std::string_view option = word.substr(0, equals);
    const auto [keep, hasValue] = keepOf(option);
    const bool isNext = hasValue && equals == std::string_view::npos && i + 1 < argc;
    const std::string_view value = isNext ? argv[++i] : "";
    if (keep == Keep::Nothing) continue;
    text += ' ';
    if (keep == Keep::Whole) {
      text += quoted(word);
    } else if (equals != std::string_view::npos) {
      text += shellWord(std::string(option) + '=' + fileName(word.substr(equals + 1)));
    } else {
      text += option;
    }
    if (isNext) text += ' ' + (keep == Keep::FileName ? shellWord(fileName(value)) : quoted(value));
  }
  return text;
}

struct Kept {
  Keep keep = Keep::Whole;
  bool hasValue = false;
};

bool isOneOf(std::string_view option, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), option) != names.end();
}

/// A word of the command line, files that it names by their contents.
std::string wordByContents(std::string_view word) {
  std::string text = shellWord(word);
  if (word.starts_with("--")) word.remove_prefix(std::min(word.find('='), word.size() - 1) + 1);
  while (!word.empty()) {
    const std::filesystem::path file(word.substr(0, word.find(',')));
    word.remove_prefix(std::min(word.size(), file.native().size() + 1));
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) continue;
    std::ifstream in(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    text += '(' + std::to_string(hashBytes(bytes)) + ')';
  }
  return text;
}

/// The model that Linux tells of the first processor; empty where it tells none.
std::string processorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    return colon == std::string::npos ? "" : line.substr(colon + 2);
  }
  return "";
}

/// Who made the table, so that anybody can make it again. Of the machine only where seconds are told.
std::vector<std::pair<std::string, LabCell>> provenanceOf(const LabOptions& o) {
  std::vector<std::pair<std::string, LabCell>> of{{"program", buildText()}, {"seed", o.seed}};
  if (o.omitSeconds) return of;
  of.emplace_back("processor", processorName());
  of.emplace_back("processors", std::uint64_t{std::thread::hardware_concurrency()});
  of.emplace_back("threads", std::uint64_t{threadCount()});
  return of;
}

}  // namespace

std::string commandText(int argc, const char* const* argv) {
  const auto keepOf = [](std::string_view option) -> Kept {
    if (option == "--quiet") return {Keep::Nothing};
    if (isOneOf(option, {"--nthreads", "--threads", "--resume"})) return {Keep::Nothing, true};
    if (isOneOf(option, {"-o", "--outfile", "--picture"})) return {Keep::FileName, true};
    return {};
  };
  return textOf(argc, argv, keepOf, [](std::string_view word) { return shellWord(word); });
}

std::string identityText(int argc, const char* const* argv) {
  const auto keepOf = [](std::string_view option) -> Kept {
    if (isOneOf(option, {"--quiet", "--no-seconds"})) return {Keep::Nothing};
    if (isOneOf(option,
                {"--nthreads", "--threads", "--resume", "-o", "--outfile", "--picture", "--format"})) {
      return {Keep::Nothing, true};
    }
    return {};
  };
  return textOf(argc, argv, keepOf, wordByContents) + ", " + buildText();
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
  if (now < kFree) {
    freeDone_ = done;
    freeSeconds_ = now;
  }
  if (now - last_ < (isTerminal_ ? kLiveInterval : kPlainInterval)) return;
  last_ = now;
  std::string line = title_ + ": " + std::to_string(done) + " of " + std::to_string(total_);
  if (!what.empty()) line += ", " + what;
  line += ", " + std::to_string(static_cast<long>(now)) + " s";
  if (done > freeDone_ && done < total_) {
    const double each = (now - freeSeconds_) / static_cast<double>(done - freeDone_);
    line += ", " + std::to_string(std::lround(each * static_cast<double>(total_ - done))) + " s left";
  }
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
  writeOutput(options.outfile,
              [&](std::ostream& out) { table.write(out, tableFormat(options), provenanceOf(options)); });
}

std::string extensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string_view extensionOf(TableFormat format) {
  switch (format) {
    case TableFormat::Csv:
      return ".csv";
    case TableFormat::Json:
      return ".json";
    case TableFormat::Text:
      break;
  }
  return ".txt";
}

void checkOutput(const LabOptions& options) {
  tableFormat(options);
  if (!options.outfile.empty()) checkWritable(options.outfile);
}

TableFormat tableFormat(const LabOptions& options) {
  const std::string extension = extensionOf(options.outfile);
  std::optional<TableFormat> ofName;
  for (const auto& [name, format] : kTableFormats) {
    if (extension == extensionOf(format)) ofName = format;
  }
  if (options.format) {
    if (!ofName || ofName == TableFormat::Text || ofName == options.format) return *options.format;
    throw std::runtime_error(options.outfile + ": --format asks for another format than the name ends in");
  }
  if (ofName) return *ofName;
  if (options.outfile.empty()) return ::isatty(STDOUT_FILENO) == 1 ? TableFormat::Text : TableFormat::Csv;
  throw std::runtime_error(options.outfile +
                           ": unknown extension; known: .csv, .json, .txt (or name the --format)");
}

}  // namespace pbrtmedia
