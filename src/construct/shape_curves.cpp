// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "construct/shape_kinds.h"
#include "construct/tolerance.h"
#include "shapes/curves.h"

namespace pbrtmedia {
namespace {

constexpr std::array<std::string_view, 3> kTypes = {"flat", "ribbon", "cylinder"};
constexpr std::array<std::string_view, 2> kBases = {"bezier", "bspline"};

/// "width0" or "width1". A negative one is that of the same strand without its sign.
float readWidth(ParamReader& in, std::string_view name, float fallback) {
  const float width = in.findFloat(name, fallback);
  if (width < 0) {
    const std::string_view written = in.has(ParamKind::Float, name) ? name : "width";
    tolerate(in, ParamKind::Float, written,
             "found " + shownNumber(width) +
                 ", expected >= 0; taken without its sign; PBRT-v3 shades such a curve wrongly");
  }
  return std::abs(width);
}

/// Number of halvings; PBRT-v3 reads either kind.
int readSplitDepth(ParamReader& in, int fallback) {
  const float asFloat = in.findFloat("splitdepth", static_cast<float>(fallback));
  const int depth = in.findInt("splitdepth", static_cast<int>(std::clamp(asFloat, -1e6f, 1e6f)));
  return std::clamp(depth, 0, Curves::kMaxSplitDepth);  // speed only
}

/// An unknown word is what PBRT-v3 takes it for.
CurveType readType(ParamReader& in) {
  const std::string word = in.findString("type", std::string(kTypes[0]));
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (word == kTypes[i]) return static_cast<CurveType>(i);
  }
  tolerate(in, ParamKind::String, "type",
           "unknown type \"" + word + '"' + suggestion(word, kTypes) + "; taken as cylinder, as in PBRT-v3");
  return CurveType::Cylinder;
}

/// What it stands for; nothing, told, when the word is unknown.
std::optional<CurveBasis> readBasis(ParamReader& in) {
  const std::string word = in.findString("basis", std::string(kBases[0]));
  if (word == kBases[0]) return CurveBasis::Bezier;
  if (word == kBases[1]) return CurveBasis::BSpline;
  tolerate(in, ParamKind::String, "basis",
           "unknown basis \"" + word + '"' + suggestion(word, kBases) + std::string(kShapeLeftOut));
  return std::nullopt;
}

}  // namespace

ShapePlan readCurve(const ShapeInput& input) {
  ParamReader& in = input.in;
  const float width = in.findFloat("width", 1);
  const float width0 = readWidth(in, "width0", width), width1 = readWidth(in, "width1", width);
  const int degree = in.findInt("degree", 3);
  const std::optional<CurveBasis> basis = readBasis(in);
  Curves::Params params;
  params.type = readType(in);
  params.splitDepth = readSplitDepth(in, params.splitDepth);
  std::vector<Normal3f> normals = in.takeNormals("N");
  if (params.type != CurveType::Ribbon && !normals.empty()) {
    in.diagnostics().warning(in.locationOf(ParamKind::Normal, "N"),
                             in.context() + ": \"N\" is for curves of type ribbon only; it is left out");
    normals.clear();
  }
  const std::vector<Point3f> points = in.takePoint3s("P");
  if (!in.has(ParamKind::Point3, "P")) {
    tolerate(in, "parameter \"point P\" is missing" + std::string(kShapeLeftOut));
    return {};
  }
  if (!basis) return {};
  try {
    params.addStrand(points, degree, *basis, width0, width1, normals);
  } catch (const std::invalid_argument& e) {
    tolerate(in, e.what() + std::string(kShapeLeftOut));
    return {};
  }
  if (params.segments.empty()) {
    tolerate(in, "the curve has no width or no length" + std::string(kShapeLeftOut));
    return {};
  }
  ShapePlan plan;
  plan.strands = std::make_shared<Curves::Params>(std::move(params));
  plan.make = [strands = plan.strands, placement = input.placement](Diagnostics&) {
    return std::make_unique<Curves>(std::move(*strands), placement);
  };
  return plan;
}

}  // namespace pbrtmedia
