// SPDX-License-Identifier: BSD-2-Clause
#include "construct/medium_bounds.h"

#include <algorithm>
#include <array>
#include <string>

#include "construct/enum_parameter.h"
#include "construct/tolerance.h"
#include "construct/tracking_parameters.h"

namespace pbrtmedia {
namespace {

constexpr std::array<std::string_view, 3> kSources = {"exact", "constant", "progressive"};

constexpr int kMaxCellsPerAxis = 1024;
constexpr int kMostWarmUpPasses = 1024;
constexpr std::int64_t kMaxCells = std::int64_t{1} << 27;  ///< 1.5 GiB of bounds

WantedCells readCells(ParamReader& in) {
  const std::span<const int> found = in.ints("supervoxels");
  if (found.empty()) return std::nullopt;
  const auto refuse = [&](const std::string& what) {
    in.error(ParamKind::Integer, "supervoxels", what);
    return std::nullopt;
  };
  if (found.size() != 1 && found.size() != 3) {
    return refuse("found " + std::to_string(found.size()) +
                  " numbers, expected one, or three for x, y and z");
  }
  std::array<int, 3> cells{};
  std::int64_t product = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    cells[a] = found[found.size() == 1 ? 0 : a];
    if (cells[a] < 0 || cells[a] > kMaxCellsPerAxis) {
      return refuse("found " + std::to_string(cells[a]) + ", expected 0 (one for all) to " +
                    std::to_string(kMaxCellsPerAxis));
    }
    product *= std::max(1, cells[a]);
  }
  if (product > kMaxCells) {
    return refuse("found " + std::to_string(product) + " super-voxels in all, expected at most " +
                  std::to_string(kMaxCells));
  }
  return cells;
}

/// The methods that ask for no pieces.
template <class Find>
std::string othersOf(const std::vector<std::string_view>& names, const Find& find) {
  std::vector<std::string_view> fit;
  std::copy_if(names.begin(), names.end(), std::back_inserter(fit),
               [&](std::string_view name) { return !traitsOf(*find(name)).needsPieces; });
  return joinedNames(fit);
}

}  // namespace

BoundsParams readBounds(ParamReader& in, BoundsParams::Source fallback) {
  BoundsParams p;
  p.cells = readCells(in);
  p.source = findOwnEnum(in, "bounds", kSources, fallback);
  const auto belongsTo = [&](BoundsParams::Source source, std::string_view name,
                             ParamKind kind = ParamKind::Float) {
    if (p.source == source || !in.has(kind, name)) return p.source == source;
    std::string text = "needs \"string bounds\" \"";
    text += kSources[static_cast<std::size_t>(source)];
    text += '"';
    in.error(kind, name, text);
    return false;
  };
  if (belongsTo(BoundsParams::Source::Constant, "majorant")) {
    if (const std::optional<float> majorant = in.optionalFloat("majorant", Range::positive())) {
      p.majorant = *majorant;
    } else if (!in.has(ParamKind::Float, "majorant")) {
      in.error(ParamKind::String, "bounds", "\"constant\" needs a \"float majorant\": an extinction");
    }
  }
  if (belongsTo(BoundsParams::Source::Progressive, "initialextinction"))
    p.initialExtinction = in.findFloat("initialextinction", p.initialExtinction, Range::positive());
  if (belongsTo(BoundsParams::Source::Progressive, "epsilon"))
    p.epsilon = in.findFloat("epsilon", p.epsilon, Range::positive());
  if (belongsTo(BoundsParams::Source::Progressive, "boundslack"))
    p.slack = in.findFloat("boundslack", p.slack, Range::nonNegative());
  if (belongsTo(BoundsParams::Source::Progressive, "warmup", ParamKind::Integer))
    p.warmUpPasses = in.findInt("warmup", p.warmUpPasses, Range::closed(0, kMostWarmUpPasses));
  if (belongsTo(BoundsParams::Source::Progressive, "warmuplookups", ParamKind::Integer)) {
    if (const std::optional<int> most = in.optionalInt("warmuplookups", Range::nonNegative()))
      p.warmUpLookups = static_cast<std::uint64_t>(*most);
  }
  return p;
}

void checkPieces(ParamReader& in, const FieldMediumParams& p, bool inPieces) {
  const bool exact = p.bounds.source == BoundsParams::Source::Exact;
  if (inPieces && exact) return;
  const auto refuse = [&](std::string_view parameter, std::string_view name, const std::string& others) {
    std::string text = "\"";
    text += name;
    text += "\" goes from voxel to voxel, but ";
    text += inPieces ? "bounds that are not \"exact\" cut across them" : "this density has none";
    text += "; these work here: " + others;
    in.error(ParamKind::String, parameter, text);
  };
  if (p.estimator && traitsOf(*p.estimator).needsPieces)
    refuse("transmittance", nameOf(*p.estimator), othersOf(estimatorNames(), findEstimator));
  if (traitsOf(p.flights).needsPieces)
    refuse("freeflight", nameOf(p.flights), othersOf(flightNames(), findFlight));
}

}  // namespace pbrtmedia
