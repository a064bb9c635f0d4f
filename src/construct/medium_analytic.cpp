// SPDX-License-Identifier: BSD-2-Clause
#include <string>
#include <variant>

#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "construct/plugins.h"
#include "fields/analytic_density.h"
#include "media/procedural_medium.h"

namespace pbrtmedia {
namespace {

struct Box {
  Point3f p0{0, 0, 0}, p1{1, 1, 1};
};

void readNumber(ParamReader& in, std::string_view name, double& value) {
  // As written in the file: 0.1, not the float next to it.
  if (const std::optional<float> found = in.optionalFloat(name)) value = decimalOf(*found);
}

// The parameters of each function, and the box that shows all of it.
Box read(ParamReader&, SineSphere&) { return {{-10, -10, 0}, {10, 10, 20}}; }
Box read(ParamReader& in, Ball& ball) {
  ball.center = in.findPoint3("center", ball.center);
  readNumber(in, "radius", ball.radius);
  readNumber(in, "edge", ball.edge);
  const auto r = static_cast<float>(ball.radius);
  return {ball.center - Vector3f(r, r, r), ball.center + Vector3f(r, r, r)};
}
template <class Layer>
Box readLayer(ParamReader& in, Layer& layer) {
  readNumber(in, "from", layer.from);
  readNumber(in, "to", layer.to);
  return {};
}
Box read(ParamReader& in, Slab& slab) { return readLayer(in, slab); }
Box read(ParamReader& in, Ramp& ramp) { return readLayer(in, ramp); }
Box read(ParamReader& in, Needle& needle) {
  readNumber(in, "floor", needle.floor);
  readNumber(in, "height", needle.height);
  readNumber(in, "position", needle.position);
  readNumber(in, "width", needle.width);
  return {};
}

}  // namespace

std::optional<MediumPlan> readAnalyticMedium(const MediumInput& input) {
  ParamReader& in = input.in;
  const MediumDescription& medium = input.medium;
  ProceduralMediumParams p;
  readFieldMediumParams(in, medium, DensityKind::Procedural, p);
  const std::optional<std::string> name = in.optionalString("function");
  if (!name) {
    if (!in.has(ParamKind::String, "function"))
      in.error("parameter \"string function\" is missing" + suggestion("", analyticNames()));
    return std::nullopt;
  }
  std::optional<AnyAnalytic> function = findAnalytic(*name);
  if (!function) {
    in.error(ParamKind::String, "function",
             "unknown function \"" + *name + "\"" + suggestion(*name, analyticNames()));
    return std::nullopt;
  }
  const Box box = std::visit([&](auto& f) { return read(in, f); }, *function);
  p.field.p0 = box.p0;
  p.field.p1 = box.p1;
  try {
    p.field.function = makeAnalyticDensity(*function);
  } catch (const SceneError& e) {
    in.error(ParamKind::String, "function", *name + ": " + e.what());
    return std::nullopt;
  }
  if (!readMediumBox(in, p.field.p0, p.field.p1)) return std::nullopt;
  return [p, place = medium.ctm->start](Textures&) { return makeProceduralMedium(p, "analytic", place); };
}

}  // namespace pbrtmedia
