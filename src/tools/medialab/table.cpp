// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
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

/// As CSV, but for people: numbers of five digits.
struct ToText : ToCsv {
  using ToCsv::operator();
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(double number) const {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.5g", number);
    return text.data();
  }
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

void LabTable::write(std::ostream& out, TableFormat format,
                     const std::vector<std::pair<std::string, Cell>>& provenance) const {
  switch (format) {
    case TableFormat::Csv:
      return writeCsv(out);
    case TableFormat::Json:
      return writeJson(out, provenance);
    case TableFormat::Text:
      return writeText(out);
  }
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

void LabTable::writeJson(std::ostream& out,
                         const std::vector<std::pair<std::string, Cell>>& provenance) const {
  using Json = nlohmann::ordered_json;
  const auto json = [](const Cell& cell) {
    return std::visit([](const auto& value) { return Json(value); }, cell.value());
  };
  Json made = Json::object();
  for (const auto& [name, value] : provenance) made[name] = json(value);
  Json document{{"command", command_},      {"provenance", std::move(made)}, {"notes", notes_},
                {"skipped", Json::array()}, {"stopped", stopped_},           {"rows", Json::array()}};
  for (const Skipped& s : skipped_) document["skipped"].push_back({{"what", s.what}, {"reason", s.reason}});
  for (const auto& row : rows_) {
    Json object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) {
      object[columns_[i]] = json(row[i]);
    }
    document["rows"].push_back(std::move(object));
  }
  out << document.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
}

void LabTable::writeText(std::ostream& out) const {
  std::vector<std::vector<std::string>> texts;
  std::vector<std::size_t> widths;
  for (const std::string& name : columns_) widths.push_back(name.size());
  for (const auto& row : rows_) {
    std::vector<std::string>& line = texts.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) {
      line.push_back(std::visit(ToText{}, row[i].value()));
      widths[i] = std::max(widths[i], line.back().size());
    }
  }
  const auto isWord = [&](std::size_t i) {
    return !rows_.empty() && std::holds_alternative<std::string>(rows_.front()[i].value());
  };
  const auto print = [&](const std::vector<std::string>& line) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string blanks(widths[i] - line[i].size(), ' ');
      text += (i > 0 ? "  " : "") + (isWord(i) ? line[i] + blanks : blanks + line[i]);
    }
    out << text.substr(0, text.find_last_not_of(' ') + 1) << '\n';
  };
  print(columns_);
  for (const auto& line : texts) print(line);
  for (const std::string& text : notes_) out << text << '\n';
  for (const Skipped& s : skipped_) out << "skipped: " << s.what << ": " << s.reason << '\n';
  if (stopped_) out << "stopped before the end: rows are missing\n";
}

}  // namespace pbrtmedia
