// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_choice.h"

#include <charconv>
#include <optional>
#include <vector>

#include "base/diagnostics.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kMaxListed = 32;

[[noreturn]] void refuse(std::span<const GridCandidate> grids, const std::string& why) {
  throw SceneError(SourceLocation{}, why + "; the file holds:\n" + listGrids(grids));
}

std::optional<std::size_t> asNumber(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::vector<std::size_t> matching(std::span<const GridCandidate> grids, auto fits) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    if (fits(grids[i])) found.push_back(i);
  }
  return found;
}

std::size_t chooseUnnamed(std::span<const GridCandidate> grids) {
  const auto densities = matching(grids, [](const GridCandidate& g) { return g.isDensity; });
  if (densities.size() == 1) return densities.front();
  const auto named =
      matching(grids, [](const GridCandidate& g) { return g.isDensity && g.name == "density"; });
  if (named.size() == 1) return named.front();
  refuse(grids, densities.empty() ? "no grid is a density (float or double)"
                                  : "several grids could be the density: name one");
}

/// "name[2]": the third grid called name.
std::optional<std::size_t> nthOfName(std::span<const GridCandidate> grids, std::string_view wanted) {
  const std::size_t bracket = wanted.rfind('[');
  if (bracket == std::string_view::npos || wanted.back() != ']') return std::nullopt;
  const auto n = asNumber(wanted.substr(bracket + 1, wanted.size() - bracket - 2));
  const auto same =
      matching(grids, [&](const GridCandidate& g) { return g.name == wanted.substr(0, bracket); });
  return n && *n < same.size() ? std::optional(same[*n]) : std::nullopt;
}

}  // namespace

std::string listGrids(std::span<const GridCandidate> grids) {
  if (grids.empty()) return "    nothing";
  std::string text;
  for (std::size_t i = 0; i < grids.size() && i < kMaxListed; ++i) {
    if (i > 0) text += '\n';
    text += "    " + std::to_string(i) + ": \"" + grids[i].name + "\" (" + grids[i].description + ")";
  }
  if (grids.size() > kMaxListed) text += "\n    and " + std::to_string(grids.size() - kMaxListed) + " more";
  return text;
}

std::size_t chooseGrid(std::span<const GridCandidate> grids, std::string_view wanted) {
  if (wanted.empty()) return chooseUnnamed(grids);
  const auto exact = matching(grids, [&](const GridCandidate& g) { return g.name == wanted; });
  if (!exact.empty()) return exact.front();
  if (const auto nth = nthOfName(grids, wanted)) return *nth;
  if (const auto number = asNumber(wanted)) {
    if (*number < grids.size()) return *number;
    refuse(grids, "there is no grid number " + std::string(wanted));
  }
  const auto prefixed = matching(grids, [&](const GridCandidate& g) { return g.name.starts_with(wanted); });
  if (prefixed.size() == 1) return prefixed.front();
  refuse(grids, (prefixed.empty() ? "no grid is called \"" : "several grids have names that begin with \"") +
                    std::string(wanted) + '"');
}

}  // namespace pbrtmedia
