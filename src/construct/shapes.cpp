// SPDX-License-Identifier: BSD-2-Clause
#include "construct/shapes.h"

#include <array>
#include <utility>

#include "construct/plugins.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "shapes/hyperboloid.h"
#include "shapes/loop_subdivision.h"
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
using ReadShape = std::optional<ShapePlan> (*)(const ShapeInput&);

/// A quadric is cheap: it is made at once, so that its own checks are part of the reading.
template <class Quadric>
std::optional<ShapePlan> planQuadric(const ShapeInput& input, const typename Quadric::Params& params) {
  try {
    auto made = std::make_shared<std::unique_ptr<Shape>>(std::make_unique<Quadric>(params, input.placement));
    return ShapePlan{[made](Diagnostics&) { return std::move(*made); }, std::nullopt, std::nullopt};
  } catch (const std::invalid_argument& e) {
    input.in.error(e.what());
    return std::nullopt;
  }
}

std::optional<ShapePlan> readSphere(const ShapeInput& input) {
  Sphere::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.zmin = input.in.optionalFloat("zmin");
  p.zmax = input.in.optionalFloat("zmax");
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Sphere>(input, p);
}

std::optional<ShapePlan> readCylinder(const ShapeInput& input) {
  Cylinder::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.zmin = input.in.findFloat("zmin", p.zmin);
  p.zmax = input.in.findFloat("zmax", p.zmax);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Cylinder>(input, p);
}

std::optional<ShapePlan> readDisk(const ShapeInput& input) {
  Disk::Params p;
  p.height = input.in.findFloat("height", p.height);
  p.radius = input.in.findFloat("radius", p.radius);
  p.innerradius = input.in.findFloat("innerradius", p.innerradius);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Disk>(input, p);
}

std::optional<ShapePlan> readCone(const ShapeInput& input) {
  Cone::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.height = input.in.findFloat("height", p.height);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Cone>(input, p);
}

std::optional<ShapePlan> readParaboloid(const ShapeInput& input) {
  Paraboloid::Params p;
  p.radius = input.in.findFloat("radius", p.radius);
  p.zmin = input.in.findFloat("zmin", p.zmin);
  p.zmax = input.in.findFloat("zmax", p.zmax);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Paraboloid>(input, p);
}

std::optional<ShapePlan> readHyperboloid(const ShapeInput& input) {
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

/// The array a mesh problem speaks of, as the user wrote it.
ParamKind kindOf(const std::string& parameter) {
  if (parameter == "P") return ParamKind::Point3;
  if (parameter == "N") return ParamKind::Normal;
  if (parameter == "S") return ParamKind::Vector3;
  if (parameter == "uv") return ParamKind::Point2;
  return ParamKind::Integer;
}

/// Reports them; true when the mesh can be made.
bool report(const ShapeInput& input, const std::vector<MeshProblem>& problems) {
  bool usable = true;
  for (const MeshProblem& problem : problems) {
    if (problem.severity == Severity::Error) {
      input.in.error(kindOf(problem.parameter), problem.parameter, problem.message);
      usable = false;
    } else {
      input.in.diagnostics().warning(
          input.in.locationOf(kindOf(problem.parameter), problem.parameter),
          input.in.context() + ": parameter \"" + problem.parameter + "\": " + problem.message);
    }
  }
  return usable;
}

/// Point2 "uv", point2 "st", float "uv", float "st": the first that is there.
std::vector<Point2f> takeUv(ParamReader& in) {
  for (const std::string_view name : {"uv", "st"}) {
    if (in.has(ParamKind::Point2, name)) return in.takePoint2s(name);
  }
  for (const std::string_view name : {"uv", "st"}) {
    if (!in.has(ParamKind::Float, name)) continue;
    const std::span<const float> numbers = in.floats(name);
    if (numbers.size() % 2 != 0) {
      in.error(ParamKind::Float, name,
               "found " + std::to_string(numbers.size()) + " numbers, expected pairs");
    }
    std::vector<Point2f> uv(numbers.size() / 2);
    for (std::size_t i = 0; i < uv.size(); ++i) uv[i] = {numbers[2 * i], numbers[2 * i + 1]};
    return uv;
  }
  return {};
}

template <class Params>
ShapePlan planMesh(const ShapeInput& input, std::string_view typeName, std::shared_ptr<Params> params) {
  const ShapePlacement placement = input.placement;
  return {[params, placement, typeName](Diagnostics&) -> std::unique_ptr<Shape> {
            return std::make_unique<TriangleMesh>(std::move(*params), placement, typeName);
          },
          std::nullopt, std::nullopt};
}

bool requireArrays(const ShapeInput& input) {
  bool complete = true;
  if (!input.in.has(ParamKind::Integer, "indices")) {
    input.in.error("parameter \"integer indices\" is missing");
    complete = false;
  }
  if (!input.in.has(ParamKind::Point3, "P")) {
    input.in.error("parameter \"point P\" is missing");
    complete = false;
  }
  return complete;
}

std::optional<ShapePlan> readTriangleMesh(const ShapeInput& input) {
  const bool complete = requireArrays(input);
  auto params = std::make_shared<TriangleMesh::Params>();
  params->indices = input.in.takeInts("indices");
  params->P = input.in.takePoint3s("P");
  params->N = input.in.takeNormals("N");
  params->S = input.in.takeVector3s("S");
  params->uv = takeUv(input.in);
  params->faceIndices = input.in.takeInts("faceIndices");
  ShapePlan alphas;
  readAlpha(input, alphas);
  if (!complete || !report(input, TriangleMesh::validate(*params))) return std::nullopt;
  ShapePlan plan = planMesh(input, "trianglemesh", std::move(params));
  plan.alpha = alphas.alpha;
  plan.shadowAlpha = alphas.shadowAlpha;
  return plan;
}

std::optional<ShapePlan> readLoopSubdivision(const ShapeInput& input) {
  const bool complete = requireArrays(input);
  auto params = std::make_shared<LoopSubdivisionParams>();
  const Range levels = Range::closed(0, LoopSubdivisionParams::kMaxLevels);
  const std::optional<int> alias = input.in.optionalInt("nlevels", levels);
  params->levels = input.in.findInt("levels", alias.value_or(params->levels), levels);
  input.in.findString("scheme", "");  // accepted and ignored by PBRT-v3 too
  params->indices = input.in.takeInts("indices");
  params->P = input.in.takePoint3s("P");
  if (!complete || !report(input, validateLoop(*params))) return std::nullopt;
  const ShapePlacement placement = input.placement;
  return ShapePlan{[params, placement](Diagnostics&) -> std::unique_ptr<Shape> {
                     return std::make_unique<TriangleMesh>(subdivideLoop(*params), placement, "loopsubdiv");
                   },
                   std::nullopt, std::nullopt};
}

std::optional<ShapePlan> readPlyMesh(const ShapeInput& input) {
  const auto file = input.in.findInputFile("filename");
  if (!file && !input.in.has(ParamKind::String, "filename"))
    input.in.error("parameter \"filename\" is missing");
  ShapePlan plan;
  readAlpha(input, plan);
  if (!file) return std::nullopt;
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

constexpr std::array<Plugin<ReadShape>, 9> kShapes = {{{"sphere", readSphere},
                                                       {"cylinder", readCylinder},
                                                       {"disk", readDisk},
                                                       {"cone", readCone},
                                                       {"paraboloid", readParaboloid},
                                                       {"hyperboloid", readHyperboloid},
                                                       {"trianglemesh", readTriangleMesh},
                                                       {"plymesh", readPlyMesh},
                                                       {"loopsubdiv", readLoopSubdivision}}};

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
