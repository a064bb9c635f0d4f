// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/tabulated.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parameters.h"

namespace pbrtmedia {
namespace {

/// Beyond, a table is no line any more: half a gigabyte of stretches.
constexpr std::size_t kMostPoints = 1u << 22;

/// The next number of a line, and what separates it from the one before, taken off; nothing: no number.
std::optional<double> takeNumber(std::string_view& text) {
  constexpr std::string_view kBetween = " \t,;";
  text.remove_prefix(std::min(text.find_first_not_of(kBetween), text.size()));
  double value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto length = static_cast<std::size_t>(end - text.data());
  if (error != std::errc() || (length < text.size() && kBetween.find(text[length]) == std::string_view::npos))
    return std::nullopt;
  text.remove_prefix(length);
  return value;
}

struct TablePoint {
  double x, density;
};

class Table {
 public:
  explicit Table(const std::filesystem::path& path) : path_(path.string()), file_(path) {
    if (!file_) throw std::runtime_error("cannot read \"" + path_ + '"');
    for (std::string text; std::getline(file_, text);) {
      ++line_;
      if (!text.empty() && text.back() == '\r') text.pop_back();
      if (text.find_first_not_of(" \t") != std::string::npos && text.front() != '#') add(text);
    }
    if (file_.bad()) fail("cannot be read to its end");
    if (points_.size() < 2)
      fail("found " + std::to_string(points_.size()) + " points, expected two at least");
  }

  const std::vector<TablePoint>& points() const { return points_; }
  [[noreturn]] void fail(const std::string& problem) const {
    throw std::runtime_error(path_ + ':' + std::to_string(line_) + ": " + problem);
  }

 private:
  void add(std::string_view text) {
    std::string_view rest = text;
    const std::optional<double> x = takeNumber(rest);
    if (!x && points_.empty() && !std::exchange(hasTitle_, true)) return;
    const std::optional<double> density = x ? takeNumber(rest) : std::nullopt;
    if (!density || rest.find_first_not_of(" \t,;") != std::string_view::npos) {
      fail("found \"" + std::string(text.substr(0, 60)) + "\", expected two numbers: x,density");
    }
    if (!std::isfinite(*x)) fail("found x = " + formatNumber(*x) + ", expected a finite number");
    if (!(*density >= 0) || !std::isfinite(*density))
      fail("found density " + formatNumber(*density) + ", expected a finite number, at least 0");
    if (!points_.empty() && *x < points_.back().x)
      fail("x goes back from " + formatNumber(points_.back().x) + " to " + formatNumber(*x));
    if (points_.size() == kMostPoints)
      fail("found more than " + std::to_string(kMostPoints) + " points, which is too many");
    points_.push_back({*x, *density});
  }

  std::string path_;
  std::ifstream file_;
  std::size_t line_ = 0;
  bool hasTitle_ = false;
  std::vector<TablePoint> points_;
};

}  // namespace

CanonicalFunction readTabulatedFunction(const std::filesystem::path& path) {
  const Table table(path);
  const std::vector<TablePoint>& p = table.points();
  std::vector<CanonicalFunction::Stretch> stretches;
  double end = 0;
  bool isEmpty = true;
  for (std::size_t i = 1; i < p.size(); ++i) {
    const double next = p[i].x - p.front().x, width = next - end;
    if (!(width > 0)) continue;  // a jump
    stretches.push_back(
        {.end = next, .constant = p[i - 1].density, .slope = (p[i].density - p[i - 1].density) / width});
    isEmpty = isEmpty && p[i - 1].density == 0 && p[i].density == 0;
    end = next;
  }
  if (stretches.empty()) table.fail("all points have the same x");
  if (isEmpty) table.fail("all densities are 0");
  return {{.name = path.string(), .formula = "straight lines between points", .source = "a table"},
          std::move(stretches)};
}

}  // namespace pbrtmedia
