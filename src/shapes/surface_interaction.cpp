// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/surface_interaction.h"

namespace pbrtmedia {
namespace {

/// Where the line meets the plane through p with normal n; not finite when it runs parallel to the plane.
Vec3d meetPlane(Point3f origin, Vector3f direction, Vec3d p, Vec3d n) {
  const Vec3d o(origin), d(direction);
  return o + dot(n, p - o) / dot(n, d) * d;
}

}  // namespace

void SurfaceInteraction::computeDifferentials(const RayDifferential& ray) {
  dpdx = dpdy = {};
  dudx = dvdx = dudy = dvdy = 0;
  if (!ray.hasDifferentials) return;
  const Vec3d position(p), normal(n);
  const Vec3d dx = meetPlane(ray.rxOrigin, ray.rxDirection, position, normal) - position;
  const Vec3d dy = meetPlane(ray.ryOrigin, ray.ryDirection, position, normal) - position;
  if (!isFinite(Vector3f(dx)) || !isFinite(Vector3f(dy))) return;
  dpdx = Vector3f(dx);
  dpdy = Vector3f(dy);

  // Least squares for dp = dp/du du + dp/dv dv by the normal equations; rank-deficient: no footprint.
  const Vec3d a(dpdu), b(dpdv);
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
  if (!(det > 1e-14 * aa * bb)) return;
  const auto solve = [&](Vec3d d, float& du, float& dv) {
    const auto u = static_cast<float>((bb * dot(a, d) - ab * dot(b, d)) / det);
    const auto v = static_cast<float>((aa * dot(b, d) - ab * dot(a, d)) / det);
    if (!std::isfinite(u) || !std::isfinite(v)) return;
    du = u;
    dv = v;
  };
  solve(dx, dudx, dvdx);
  solve(dy, dudy, dvdy);
}

void SurfaceInteraction::setShading(Normal3f ns, Vector3f dpdus, Vector3f dpdvs, Normal3f dndus,
                                    Normal3f dndvs, bool orientationIsAuthoritative) {
  if (orientationIsAuthoritative) {
    n = faceForward(n, ns);
  } else if (dot(ns, n) < 0) {
    ns = -ns;
    dndus = -dndus;
    dndvs = -dndvs;
  }
  shading = {ns, dpdus, dpdvs, dndus, dndvs};
}

SurfaceInteraction transformInteraction(const Transform& worldFromObject, const SurfaceInteraction& si) {
  const auto mapNormal = [&](Normal3f from, Normal3f& du, Normal3f& dv) {
    du = worldFromObject.normal(du);
    dv = worldFromObject.normal(dv);
    return Normal3f(normalize(worldFromObject.normal(Vec3d(from))));
  };
  SurfaceInteraction r = si;
  r.p = worldFromObject.point(si.p);
  r.wo = Vector3f(normalize(worldFromObject.vector(Vec3d(si.wo))));
  r.n = mapNormal(si.n, r.dndu, r.dndv);
  r.dpdu = worldFromObject.vector(si.dpdu);
  r.dpdv = worldFromObject.vector(si.dpdv);
  r.shading.n = mapNormal(si.shading.n, r.shading.dndu, r.shading.dndv);
  r.shading.n = faceForward(r.shading.n, r.n);
  r.shading.dpdu = worldFromObject.vector(si.shading.dpdu);
  r.shading.dpdv = worldFromObject.vector(si.shading.dpdv);
  r.dpdx = worldFromObject.vector(si.dpdx);
  r.dpdy = worldFromObject.vector(si.dpdy);
  return r;
}

}  // namespace pbrtmedia
