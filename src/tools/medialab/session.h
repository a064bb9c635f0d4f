// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "base/stop_signal.h"
#include "base/stopwatch.h"
#include "tools/medialab/table.h"

namespace pbrtmedia {

/// What the commands of the lab share.
struct LabOptions {
  std::string command;                     ///< reproduces the output: see commandText
  std::string outfile;                     ///< empty: standard output
  std::optional<TableFormat> format = {};  ///< nothing: see tableFormat
  std::uint64_t seed = 1;
  unsigned threads = 0;      ///< 0: one per processor
  bool quiet = false;        ///< no progress
  std::string identity;      ///< of its measurements: see identityText
  std::string resume;        ///< file of a TrialJournal; empty: none
  bool omitSeconds = false;  ///< leave out what differs from run to run
};

/// The command line as it would be typed in the folder of the output, without what cannot change results:
/// folders of output files, --nthreads and --quiet.
std::string commandText(int argc, const char* const* argv);

/// What a command measures, in a line: its words without those that change only what becomes of the results,
/// the files among them by their contents, and the program.
std::string identityText(int argc, const char* const* argv);

/// Progress on standard error, with the time that is left if the rest takes as long as what is done: redrawn
/// in place on a terminal, else a line every five seconds. Not thread-safe.
class LabProgress {
 public:
  LabProgress(std::string title, std::size_t total, bool quiet);
  ~LabProgress();
  LabProgress(const LabProgress&) = delete;
  LabProgress& operator=(const LabProgress&) = delete;
  void update(std::size_t done, const std::string& what);

 private:
  std::string title_;
  std::size_t total_;
  bool isSilent_, isTerminal_, shown_ = false;
  Stopwatch watch_;
  double last_ = 0;
  std::size_t freeDone_ = 0;  ///< what was done when the first measurement began
  double freeSeconds_ = 0;
};

/// Writes a file atomically, or standard output if the name is empty.
void writeOutput(const std::string& outfile, const std::function<void(std::ostream&)>& write);
void writeTable(const LabTable& table, const LabOptions& options);
/// The format of the options' file: what was asked for, or what its name says. Throws std::runtime_error when
/// the name says neither .csv, .json nor .txt, or another one; capital letters are as good as small ones.
/// Without a file an aligned table for a terminal, CSV for anything else.
TableFormat tableFormat(const LabOptions& options);
/// Before anything is measured: throws std::runtime_error where the table could not be written in the end.
void checkOutput(const LabOptions& options);
/// What names of files of a format end in.
std::string_view extensionOf(TableFormat format);
/// ".csv" of "A.CSV"; "" without one.
std::string extensionOf(const std::filesystem::path& file);

}  // namespace pbrtmedia
