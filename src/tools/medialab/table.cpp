// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <utility>

#include "base/parameters.h"

namespace pbrtmedia {
namespace {

/// Quoted where CSV asks for it (RFC 4180).
std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  quoted += '"';
  return quoted;
}

struct ToCsv {
  std::string operator()(const std::string& text) const { return csvField(text); }
  std::string operator()(double number) const {
    if (std::isnan(number)) return "nan";
    if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
    return formatNumber(number);
  }
  std::string operator()(std::uint64_t number) const { return std::to_string(number); }
  std::string operator()(bool yes) const { return yes ? "true" : "false"; }
};

}  // namespace

// Out of line, as GCC 12 takes the moved-from strings of many inlined variants for uninitialised ones.
LabCell::LabCell(std::string text) : value_(std::move(text)) {}
LabCell::LabCell(double number) : value_(number) {}
LabCell::LabCell(std::uint64_t count) : value_(count) {}
LabCell::LabCell(bool yes) : value_(yes) {}

LabTable::LabTable(std::string command, std::vector<std::string> columns)
    : command_(std::move(command)), columns_(std::move(columns)) {}

void LabTable::add(std::vector<Cell> row) {
  if (row.size() != columns_.size()) throw std::logic_error("a row must have as many cells as columns");
  rows_.push_back(std::move(row));
}

std::size_t LabTable::column(std::string_view name) const {
  const auto at = std::find(columns_.begin(), columns_.end(), name);
  if (at == columns_.end()) throw std::logic_error("no column " + std::string(name));
  return static_cast<std::size_t>(at - columns_.begin());
}

void LabTable::write(std::ostream& out, TableFormat format) const {
  format == TableFormat::Csv ? writeCsv(out) : writeJson(out);
}

void LabTable::writeCsv(std::ostream& out) const {
  out << "# " << command_ << '\n';
  for (const std::string& text : notes_) out << "# " << text << '\n';
  for (const Skipped& s : skipped_) out << "# skipped: " << s.what << ": " << s.reason << '\n';
  if (stopped_) out << "# stopped before the end: rows are missing\n";
  for (std::size_t i = 0; i < columns_.size(); ++i) out << (i > 0 ? "," : "") << csvField(columns_[i]);
  out << '\n';
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i)
      out << (i > 0 ? "," : "") << std::visit(ToCsv{}, row[i].value());
    out << '\n';
  }
}

void LabTable::writeJson(std::ostream& out) const {
  using Json = nlohmann::ordered_json;
  Json document{{"command", command_},
                {"notes", notes_},
                {"skipped", Json::array()},
                {"stopped", stopped_},
                {"rows", Json::array()}};
  for (const Skipped& s : skipped_) document["skipped"].push_back({{"what", s.what}, {"reason", s.reason}});
  for (const auto& row : rows_) {
    Json object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      object[columns_[i]] = std::visit([](const auto& value) { return Json(value); }, row[i].value());
    }
    document["rows"].push_back(std::move(object));
  }
  out << document.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace pbrtmedia
