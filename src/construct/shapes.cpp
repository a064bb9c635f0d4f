// SPDX-License-Identifier: BSD-2-Clause
#include "construct/shapes.h"

#include <array>
#include <initializer_list>
#include <utility>

#include "construct/plugins.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "shapes/heightfield.h"
#include "shapes/hyperboloid.h"
#include "shapes/loop_subdivision.h"
#include "shapes/nurbs.h"
#include "shapes/paraboloid.h"
#include "shapes/ply.h"
#include "shapes/sphere.h"
#include "shapes/triangle_mesh.h"

namespace pbrtmedia {
namespace {

/// What a reader of shapes gets.
struct ShapeInput {
  ShapeDescription& shape;
  ParamReader& in;
  ShapePlacement placement;
};
using ReadShape = ShapePlan (*)(const ShapeInput&);

/// A quadric is cheap: it is made at once, so that its own checks are part of the reading.
template <class Quadric>
ShapePlan planQuadric(const ShapeInput& input, const typename Quadric::Params& params) {
  try {
    auto made = std::make_shared<std::unique_ptr<Shape>>(std::make_unique<Quadric>(params, input.placement));
    return ShapePlan{[made](Diagnostics&) { return std::move(*made); }, std::nullopt, std::nullopt};
  } catch (const std::invalid_argument& e) {
    input.in.error(e.what());
    return {};
  }
}

ShapePlan readSphere(const ShapeInput& input) {
  Sphere::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.zmin = input.in.optionalFloat("zmin");
  p.zmax = input.in.optionalFloat("zmax");
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Sphere>(input, p);
}

ShapePlan readCylinder(const ShapeInput& input) {
  Cylinder::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.zmin = input.in.findFloat("zmin", p.zmin);
  p.zmax = input.in.findFloat("zmax", p.zmax);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Cylinder>(input, p);
}

ShapePlan readDisk(const ShapeInput& input) {
  Disk::Params p;
  p.height = input.in.findFloat("height", p.height);
  p.radius = input.in.findFloat("radius", p.radius);
  p.innerradius = input.in.findFloat("innerradius", p.innerradius);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Disk>(input, p);
}

ShapePlan readCone(const ShapeInput& input) {
  Cone::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.height = input.in.findFloat("height", p.height);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Cone>(input, p);
}

ShapePlan readParaboloid(const ShapeInput& input) {
  Paraboloid::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.zmin = input.in.findFloat("zmin", p.zmin);
  p.zmax = input.in.findFloat("zmax", p.zmax);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Paraboloid>(input, p);
}

ShapePlan readHyperboloid(const ShapeInput& input) {
  Hyperboloid::Params p;
  p.p1 = input.in.findPoint3("p1", p.p1);
  p.p2 = input.in.findPoint3("p2", p.p2);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Hyperboloid>(input, p);
}

/// Opaque unless the parameter is given (scene-language reference 13.9).
void readAlpha(const ShapeInput& input, ShapePlan& plan) {
  Texturable texturable(input.in, input.shape.scope);
  plan.alpha = texturable.optionalFloat("alpha");
  plan.shadowAlpha = texturable.optionalFloat("shadowalpha");
  // Only exactly 0 cuts, so any other constant is no cut at all.
  const auto isOpaque = [](const std::optional<TextureUse<float>>& a) {
    return a && a->isConstant() && a->constant != 0;
  };
  if (isOpaque(plan.alpha)) plan.alpha.reset();
  if (isOpaque(plan.shadowAlpha)) plan.shadowAlpha.reset();
}

/// How a user may have written (u, v): the first that is there counts.
constexpr std::array<std::pair<ParamKind, std::string_view>, 4> kUvNames = {{{ParamKind::Point2, "uv"},
                                                                             {ParamKind::Point2, "st"},
                                                                             {ParamKind::Float, "uv"},
                                                                             {ParamKind::Float, "st"}}};

/// The array a mesh problem speaks of, as the user wrote it.
std::pair<ParamKind, std::string_view> writtenAs(ParamReader& in, std::string_view parameter) {
  if (parameter == "P") return {ParamKind::Point3, parameter};
  if (parameter == "N") return {ParamKind::Normal, parameter};
  if (parameter == "S") return {ParamKind::Vector3, parameter};
  if (parameter != "uv") return {ParamKind::Integer, parameter};
  for (const auto& [kind, name] : kUvNames) {
    if (in.has(kind, name)) return {kind, name};
  }
  return kUvNames.front();
}

/// Reports them; true when the mesh can be made.
bool report(const ShapeInput& input, const std::vector<MeshProblem>& problems) {
  bool usable = true;
  for (const MeshProblem& problem : problems) {
    const auto& [kind, name] = writtenAs(input.in, problem.parameter);
    if (problem.severity == Severity::Error) {
      input.in.error(kind, name, problem.message);
      usable = false;
    } else {
      input.in.diagnostics().warning(
          input.in.locationOf(kind, name),
          input.in.context() + ": parameter \"" + std::string(name) + "\": " + problem.message);
    }
  }
  return usable;
}

std::vector<Point2f> takeUv(ParamReader& in) {
  std::vector<Point2f> uv;
  bool found = false;
  for (const auto& [kind, name] : kUvNames) {
    if (!in.has(kind, name) || std::exchange(found, true))
      continue;  // the others are known, but do not count
    if (kind == ParamKind::Point2) {
      uv = in.takePoint2s(name);
      continue;
    }
    const std::span<const float> numbers = in.floats(name);
    if (numbers.size() % 2 != 0)
      in.error(kind, name, "found " + std::to_string(numbers.size()) + " numbers, expected pairs");
    uv.resize(numbers.size() / 2);
    for (std::size_t i = 0; i < uv.size(); ++i) uv[i] = {numbers[2 * i], numbers[2 * i + 1]};
  }
  return uv;
}

template <class Params>
ShapePlan planMesh(const ShapeInput& input, std::string_view typeName, std::shared_ptr<Params> params) {
  const ShapePlacement placement = input.placement;
  return {[params, placement, typeName](Diagnostics&) -> std::unique_ptr<Shape> {
            return std::make_unique<TriangleMesh>(std::move(*params), placement, typeName);
          },
          std::nullopt, std::nullopt};
}

/// Whether all are there.
bool require(ParamReader& in, std::initializer_list<std::pair<ParamKind, std::string_view>> parameters) {
  bool complete = true;
  for (const auto& [kind, name] : parameters) {
    if (in.has(kind, name)) continue;
    in.error("parameter \"" + std::string(keyword(kind)) + ' ' + std::string(name) + "\" is missing");
    complete = false;
  }
  return complete;
}

ShapePlan readTriangleMesh(const ShapeInput& input) {
  const bool complete = require(input.in, {{ParamKind::Integer, "indices"}, {ParamKind::Point3, "P"}});
  auto params = std::make_shared<TriangleMesh::Params>();
  params->indices = input.in.takeInts("indices");
  params->P = input.in.takePoint3s("P");
  params->N = input.in.takeNormals("N");
  params->S = input.in.takeVector3s("S");
  params->uv = takeUv(input.in);
  params->faceIndices = input.in.takeInts("faceIndices");
  ShapePlan alphas;
  readAlpha(input, alphas);
  if (!complete || !report(input, TriangleMesh::validate(*params))) return {};
  ShapePlan plan = planMesh(input, "trianglemesh", std::move(params));
  plan.alpha = alphas.alpha;
  plan.shadowAlpha = alphas.shadowAlpha;
  return plan;
}

ShapePlan readLoopSubdivision(const ShapeInput& input) {
  const bool complete = require(input.in, {{ParamKind::Integer, "indices"}, {ParamKind::Point3, "P"}});
  auto params = std::make_shared<LoopSubdivisionParams>();
  const Range levels = Range::closed(0, LoopSubdivisionParams::kMaxLevels);
  const std::optional<int> alias = input.in.optionalInt("nlevels", levels);
  params->levels = input.in.findInt("levels", alias.value_or(params->levels), levels);
  input.in.findString("scheme", "");  // accepted and ignored by PBRT-v3 too
  params->indices = input.in.takeInts("indices");
  params->P = input.in.takePoint3s("P");
  if (!complete || !report(input, validateLoop(*params))) return {};
  const ShapePlacement placement = input.placement;
  return ShapePlan{[params, placement](Diagnostics&) -> std::unique_ptr<Shape> {
                     return std::make_unique<TriangleMesh>(subdivideLoop(*params), placement, "loopsubdiv");
                   },
                   std::nullopt, std::nullopt};
}

ShapePlan readPlyMesh(const ShapeInput& input) {
  require(input.in, {{ParamKind::String, "filename"}});
  const auto file = input.in.findInputFile("filename");
  ShapePlan plan;
  readAlpha(input, plan);
  if (!file) return plan;
  const ShapePlacement placement = input.placement;
  const SourceLocation location = input.in.locationOf(ParamKind::String, "filename");
  plan.make = [path = *file, placement, location](Diagnostics& diagnostics) -> std::unique_ptr<Shape> {
    PlyMesh ply = readPly(path);
    const std::string context = "PLY file \"" + path.string() + "\": ";
    for (const std::string& notice : ply.notices) diagnostics.warning(location, context + notice);
    std::string problems;
    for (const MeshProblem& problem : TriangleMesh::validate(ply.mesh)) {
      if (problem.severity == Severity::Error) {
        problems += (problems.empty() ? "" : "; ") + problem.parameter + ": " + problem.message;
      } else {
        diagnostics.warning(location, context + problem.parameter + ": " + problem.message);
      }
    }
    if (!problems.empty()) throw SceneError(location, context + problems);
    return std::make_unique<TriangleMesh>(std::move(ply.mesh), placement, "plymesh");
  };
  return plan;
}

/// A mesh that is tessellated while it is read: its checks belong to the reading, and its input is small.
template <class Tessellate>
ShapePlan planTessellation(const ShapeInput& input, std::string_view typeName, const Tessellate& tessellate) {
  try {
    return planMesh(input, typeName, std::make_shared<TriangleMesh::Params>(tessellate()));
  } catch (const std::invalid_argument& e) {
    input.in.error(e.what());
    return {};
  }
}

ShapePlan readHeightfield(const ShapeInput& input) {
  ParamReader& in = input.in;
  const bool complete =
      require(in, {{ParamKind::Integer, "nu"}, {ParamKind::Integer, "nv"}, {ParamKind::Float, "Pz"}});
  const std::size_t before = in.diagnostics().errorCount();
  HeightfieldParams p;
  p.nu = in.findInt("nu", 2, Range::atLeast(2));
  p.nv = in.findInt("nv", 2, Range::atLeast(2));
  p.Pz = in.takeFloats("Pz");
  if (!complete || in.diagnostics().errorCount() > before) return {};
  return planTessellation(input, "heightfield", [&] { return tessellateHeightfield(p); });
}

ShapePlan readNurbs(const ShapeInput& input) {
  ParamReader& in = input.in;
  bool complete = require(in, {{ParamKind::Integer, "nu"},
                               {ParamKind::Integer, "nv"},
                               {ParamKind::Integer, "uorder"},
                               {ParamKind::Integer, "vorder"},
                               {ParamKind::Float, "uknots"},
                               {ParamKind::Float, "vknots"}});
  if (!in.has(ParamKind::Point3, "P") && !in.has(ParamKind::Float, "Pw")) {
    in.error("parameter \"point P\" or \"float Pw\" is missing");
    complete = false;
  }
  const std::size_t before = in.diagnostics().errorCount();
  NurbsParams p;
  p.nu = in.findInt("nu", 0);
  p.nv = in.findInt("nv", 0);
  p.uorder = in.findInt("uorder", 0);
  p.vorder = in.findInt("vorder", 0);
  p.uknots = in.takeFloats("uknots");
  p.vknots = in.takeFloats("vknots");
  p.u0 = in.optionalFloat("u0");
  p.u1 = in.optionalFloat("u1");
  p.v0 = in.optionalFloat("v0");
  p.v1 = in.optionalFloat("v1");
  p.P = in.takePoint3s("P");
  p.Pw = in.takeFloats("Pw");
  if (!complete || in.diagnostics().errorCount() > before) return {};
  return planTessellation(input, "nurbs", [&] { return tessellateNurbs(p); });
}

constexpr std::array<Plugin<ReadShape>, 11> kShapes = {{{"sphere", readSphere},
                                                        {"cylinder", readCylinder},
                                                        {"disk", readDisk},
                                                        {"cone", readCone},
                                                        {"paraboloid", readParaboloid},
                                                        {"hyperboloid", readHyperboloid},
                                                        {"trianglemesh", readTriangleMesh},
                                                        {"plymesh", readPlyMesh},
                                                        {"loopsubdiv", readLoopSubdivision},
                                                        {"heightfield", readHeightfield},
                                                        {"nurbs", readNurbs}}};

}  // namespace

std::optional<ShapePlan> readShape(ShapeDescription& shape, ParamReader& in, Diagnostics& diagnostics) {
  const auto* plugin = findPlugin<ReadShape>(kShapes, shape, "Shape", diagnostics);
  if (plugin == nullptr) return std::nullopt;
  // A moving shape is built in its own space and placed by an animated instance.
  const Transform place = shape.ctm->isAnimated() ? Transform() : shape.ctm->start;
  if (shape.ctm->start.isSingular() || shape.ctm->end.isSingular()) {
    in.error("the transformation is singular: it has no inverse");
    return std::nullopt;
  }
  return plugin->read({shape, in, ShapePlacement{place, shape.reverseOrientation}});
}

}  // namespace pbrtmedia
