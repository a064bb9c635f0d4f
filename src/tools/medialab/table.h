// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pbrtmedia {

enum class TableFormat { Csv, Json, Text };
constexpr std::array<std::pair<std::string_view, TableFormat>, 3> kTableFormats{
    {{"csv", TableFormat::Csv}, {"json", TableFormat::Json}, {"text", TableFormat::Text}}};

/// One value of a table.
class LabCell {
 public:
  LabCell(std::string text);
  LabCell(double number);
  LabCell(std::uint64_t count);
  LabCell(bool yes);

  const std::string& text() const { return std::get<std::string>(value_); }
  double number() const { return std::get<double>(value_); }
  std::uint64_t count() const { return std::get<std::uint64_t>(value_); }
  bool yes() const { return std::get<bool>(value_); }
  const std::variant<std::string, double, std::uint64_t, bool>& value() const { return value_; }

 private:
  std::variant<std::string, double, std::uint64_t, bool> value_;
};

/// Rows of named columns with the command that made them: the lab's output.
class LabTable {
 public:
  using Cell = LabCell;
  struct Skipped {
    std::string what, reason;
  };

  LabTable(std::string command, std::vector<std::string> columns);

  /// As many cells as columns.
  void add(std::vector<Cell> row);
  void note(std::string_view text) { notes_.emplace_back(text); }
  void skip(std::string what, std::string reason) {
    skipped_.push_back({std::move(what), std::move(reason)});
  }
  void markStopped() { stopped_ = true; }

  const std::vector<std::string>& columns() const { return columns_; }
  /// Number of the column of that name. Throws std::logic_error when there is none.
  std::size_t column(std::string_view name) const;
  const std::vector<std::vector<Cell>>& rows() const { return rows_; }
  const std::vector<Skipped>& skipped() const { return skipped_; }

  /// CSV: "# ..." lines for command, notes, what was skipped and whether the run was stopped, then a header
  /// line and the rows. JSON: an object with command, notes, skipped, stopped and rows, an object each;
  /// numbers that are not finite become null (CSV: nan, inf); `provenance`, names and values, is an object of
  /// it. Doubles of both read back exactly. Text: aligned columns for a terminal, numbers rounded to five
  /// digits, then notes and what was skipped.
  void write(std::ostream& out, TableFormat format,
             const std::vector<std::pair<std::string, Cell>>& provenance = {}) const;

 private:
  void writeCsv(std::ostream& out) const;
  void writeJson(std::ostream& out, const std::vector<std::pair<std::string, Cell>>& provenance) const;
  void writeText(std::ostream& out) const;

  std::string command_;
  std::vector<std::string> columns_, notes_;
  std::vector<std::vector<Cell>> rows_;
  std::vector<Skipped> skipped_;
  bool stopped_ = false;
};

}  // namespace pbrtmedia
