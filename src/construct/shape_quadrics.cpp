// SPDX-License-Identifier: BSD-2-Clause
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "construct/shape_kinds.h"
#include "construct/tolerance.h"
#include "shapes/cone.h"
#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "shapes/hyperboloid.h"
#include "shapes/paraboloid.h"
#include "shapes/sphere.h"

namespace pbrtmedia {
namespace {

/// A quadric is cheap: it is made at once, so that its own checks are part of the reading. One of which
/// nothing is left is left out.
template <class Quadric>
ShapePlan planQuadric(const ShapeInput& input, const typename Quadric::Params& params) {
  try {
    auto made = std::make_shared<std::unique_ptr<Shape>>(std::make_unique<Quadric>(params, input.placement));
    return planOf([made](Diagnostics&) { return std::move(*made); });
  } catch (const std::invalid_argument& e) {
    tolerate(input.in, e.what() + std::string(kShapeLeftOut));
    return {};
  }
}

/// "radius". A negative one is that of the same surface without its sign.
float readRadius(ParamReader& in, float fallback) {
  const float radius = in.findFloat("radius", fallback);
  if (radius < 0) {
    tolerate(in, ParamKind::Float, "radius",
             "found " + shownNumber(radius) +
                 ", expected a number > 0; taken without its sign; PBRT-v3 shades "
                 "such a surface wrongly");
  }
  return std::abs(radius);
}

}  // namespace

ShapePlan readSphere(const ShapeInput& input) {
  Sphere::Params p;
  p.radius = readRadius(input.in, p.radius);
  p.zmin = input.in.optionalFloat("zmin");
  p.zmax = input.in.optionalFloat("zmax");
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Sphere>(input, p);
}

ShapePlan readCylinder(const ShapeInput& input) {
  Cylinder::Params p;
  p.radius = readRadius(input.in, p.radius);
  p.zmin = input.in.findFloat("zmin", p.zmin);
  p.zmax = input.in.findFloat("zmax", p.zmax);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Cylinder>(input, p);
}

ShapePlan readDisk(const ShapeInput& input) {
  Disk::Params p;
  p.height = input.in.findFloat("height", p.height);
  p.radius = readRadius(input.in, p.radius);
  p.innerradius = std::abs(input.in.findFloat("innerradius", p.innerradius));  // only its square counts
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Disk>(input, p);
}

ShapePlan readCone(const ShapeInput& input) {
  Cone::Params p;
  p.radius = readRadius(input.in, p.radius);
  p.height = input.in.findFloat("height", p.height);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Cone>(input, p);
}

ShapePlan readParaboloid(const ShapeInput& input) {
  Paraboloid::Params p;
  p.radius = readRadius(input.in, p.radius);
  p.zmin = input.in.findFloat("zmin", p.zmin);
  p.zmax = input.in.findFloat("zmax", p.zmax);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  return planQuadric<Paraboloid>(input, p);
}

namespace {

/// PBRT-v3's surface is not the one that its documentation speaks of.
void reportWaist(const ShapeInput& input, const Hyperboloid::Params& params) {
  const Hyperboloid::Waist waist = Hyperboloid::waist(params);
  if (!waist.isElsewhere) return;
  std::ostringstream os;
  os.precision(4);
  os << input.in.context()
     << ": the line from p1 to p2 is nearest to the axis at another height than z = 0, where "
     << "PBRT-v3 renders another surface than it sweeps, with radius " << waist.radius << " at p1 instead of "
     << waist.sweptRadius
     << "; that surface is rendered. For the swept one lay its waist at z = 0 (Translate)";
  input.in.diagnostics().tolerated(input.shape.location, os.str());
}

}  // namespace

ShapePlan readHyperboloid(const ShapeInput& input) {
  Hyperboloid::Params p;
  p.p1 = input.in.findPoint3("p1", p.p1);
  p.p2 = input.in.findPoint3("p2", p.p2);
  p.phimax = input.in.findFloat("phimax", p.phimax);
  if (isFinite(p.p1) && isFinite(p.p2) && p.p1.z != p.p2.z && Hyperboloid::isEmpty(p)) {
    input.in.diagnostics().tolerated(
        input.shape.location,
        input.in.context() +
            ": PBRT-v3's surface has no part between the heights of p1 and p2, as the line between "
            "them is nearest to the axis far from z = 0: nothing is rendered. For the surface "
            "that the line sweeps lay its waist at z = 0 (Translate)");
    return {};
  }
  ShapePlan plan = planQuadric<Hyperboloid>(input, p);
  if (plan.make) reportWaist(input, p);
  return plan;
}

}  // namespace pbrtmedia
