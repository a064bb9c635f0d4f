// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/curves.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shapes/curve_crossing.h"
#include "shapes/parameter_checks.h"

namespace pbrtmedia {
namespace {

/// Of the larger width: how far chords may be from the curve, as in PBRT-v3.
constexpr double kFlatness = 0.05;
/// Widths around a strand's tangent within which a ray that starts there is still on the strand.
constexpr double kStartWidths = 2;
/// Relative, and absolute for distances below the normal numbers: roots that differ by no more are one, found
/// again.
constexpr double kSameRoot = 4 * 0x1p-24, kSameTinyRoot = 2 * 0x1p-149;
/// More pieces than these are made only of more segments.
constexpr std::size_t kMostSplitPieces = std::size_t{1} << 24;
constexpr std::size_t kMostPieces = std::numeric_limits<std::uint32_t>::max() - 1;

void requireFinite(std::string_view name, std::span<const Point3f> values) {
  for (const Point3f& v : values) {
    if (!isFinite(v)) rejectParameter(name, "finite numbers", v);
  }
}

void requireWidth(std::string_view name, float width) {
  if (!(width >= 0 && width < kInfinity)) rejectParameter(name, "a finite number >= 0", width);
}

Normal3f unitNormal(Normal3f n) {
  const Vec3d wide(n);
  const double size = length(wide);
  if (!(size > 0 && std::isfinite(size))) rejectParameter("N", "normals of finite length above 0", n);
  return Normal3f(wide / size);
}

CubicBezier cubicOf(const Curves::Segment& s) {
  return {{Vec3d(s.p[0]), Vec3d(s.p[1]), Vec3d(s.p[2]), Vec3d(s.p[3])}};
}

/// The derivative; where that is 0 (doubled points, a cusp) one close by, or any direction.
Vec3d tangent(const CubicBezier& c, double u) {
  constexpr double kStep = 1e-3;
  for (const double nearby : {u, u < 0.5 ? u + kStep : u - kStep}) {
    const Vec3d d = c.derivative(nearby);
    if (d != Vec3d{}) return d;
  }
  return {1, 0, 0};
}

}  // namespace

bool Curves::isEmpty(const Segment& s) {
  const bool isPoint = s.p[0] == s.p[1] && s.p[1] == s.p[2] && s.p[2] == s.p[3];
  return isPoint || (s.width0 == 0 && s.width1 == 0);
}

void Curves::Params::addStrand(std::span<const Point3f> points, int degree, CurveBasis basis, float width0,
                               float width1, std::span<const Normal3f> strandNormals) {
  if (degree != 2 && degree != 3) rejectParameter("degree", "2 or 3", degree);
  const std::size_t count = curveSegmentCount(points.size(), degree, basis);
  if (count == 0) {
    const std::string more = basis == CurveBasis::Bezier
                                 ? " and " + std::to_string(degree) + " for each further segment"
                                 : " or more";
    rejectParameter("P", std::to_string(degree + 1) + " points" + more,
                    std::to_string(points.size()) + (points.size() == 1 ? " point" : " points"));
  }
  requireFinite("P", points);
  requireWidth("width0", width0);
  requireWidth("width1", width1);
  if (type == CurveType::Ribbon && strandNormals.size() != count + 1) {
    rejectParameter("N", std::to_string(count + 1) + " normals, one more than there are segments",
                    strandNormals.size());
  }
  const auto strand = static_cast<std::uint32_t>(segments.empty() ? 0 : segments.back().strand + 1);
  const auto widthAt = [&](std::size_t i) {
    return lerp(static_cast<float>(i) / static_cast<float>(count), width0, width1);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const CubicBezier c = curveSegment(points, i, degree, basis);
    const Segment segment{{Point3f(c.p[0]), Point3f(c.p[1]), Point3f(c.p[2]), Point3f(c.p[3])},
                          widthAt(i),
                          widthAt(i + 1),
                          strand};
    if (isEmpty(segment)) continue;
    if (type == CurveType::Ribbon) {
      normals.push_back({unitNormal(strandNormals[i]), unitNormal(strandNormals[i + 1])});
    }
    segments.push_back(segment);
  }
}

void Curves::Params::append(const Params& other) {
  const std::uint32_t first = segments.empty() ? 0 : segments.back().strand + 1;
  for (const Segment& s : other.segments) {
    segments.push_back(s);
    segments.back().strand += first;
  }
  normals.insert(normals.end(), other.normals.begin(), other.normals.end());
}

Curves::Curves(Params params, const ShapePlacement& placement)
    : type_(params.type),
      splitDepth_(std::clamp(params.splitDepth, 0, kMaxSplitDepth)),
      segments_(std::move(params.segments)),
      normals_(std::move(params.normals)),
      worldFromObject_(placement.worldFromObject),
      objectFromWorld_(placement.worldFromObject.inverse()),
      flips_(placement.flipsNormal()) {
  CHECK(!segments_.empty()) << "curves need a segment";
  CHECK_EQ(normals_.size(), type_ == CurveType::Ribbon ? segments_.size() : 0);
  if (segments_.size() > kMostPieces) rejectParameter("P", "fewer segments", segments_.size());
  while (splitDepth_ > 0 && segments_.size() << splitDepth_ > kMostSplitPieces) --splitDepth_;
  segments_.shrink_to_fit();
  const Matrix4& m = worldFromObject_.matrix();
  for (std::size_t i = 0; i < 3; ++i) {
    worldReach_[i] = std::abs(m.m[i][0]) + std::abs(m.m[i][1]) + std::abs(m.m[i][2]);
  }
  for (const Segment& s : segments_) {
    bounds_.expand(boundsOf(cubicOf(s), std::max(double{s.width0}, double{s.width1})));
  }
}

std::uint32_t Curves::primitiveCount() const {
  return static_cast<std::uint32_t>(segments_.size() << splitDepth_);
}

Bounds3f Curves::bounds() const { return bounds_; }

Curves::Piece Curves::piece(std::uint32_t primitive) const {
  const CubicBezier whole = cubicOf(segmentOf(primitive));
  if (splitDepth_ == 0) return {whole, 0, 1};
  const std::uint32_t count = std::uint32_t{1} << splitDepth_, index = primitive & (count - 1);
  const double u0 = double(index) / count, u1 = double(index + 1) / count;
  return {whole.part(u0, u1), u0, u1};
}

Bounds3f Curves::boundsOf(const CubicBezier& curve, double width) const {
  Bounds3d hull;
  for (const Vec3d& p : curve.p) hull.expand(worldFromObject_.point(p));
  const Vec3d grow = width / 2 * worldReach_;
  Bounds3f r;
  r.expand(Point3f(hull.min - grow));
  r.expand(Point3f(hull.max + grow));
  for (std::size_t i = 0; i < 3; ++i) {
    r.min[i] = std::nextafter(r.min[i], -kInfinity);
    r.max[i] = std::nextafter(r.max[i], kInfinity);
  }
  return r;
}

Bounds3f Curves::primitiveBounds(std::uint32_t primitive) const {
  const Piece part = piece(primitive);
  const Segment& s = segmentOf(primitive);
  const double w0 = lerp(part.u0, double{s.width0}, double{s.width1});
  const double w1 = lerp(part.u1, double{s.width0}, double{s.width1});
  return boundsOf(part.curve, std::max(w0, w1));
}

Vec3d Curves::ribbonNormal(std::uint32_t primitive, double u) const {
  const auto& ends = normals_[primitive >> splitDepth_];
  const Vec3d a(ends[0]), b(ends[1]);
  // PBRT-v3 takes no angles beyond 90 degrees.
  const double angle = std::acos(std::clamp(dot(a, b), 0.0, 1.0)), sine = std::sin(angle);
  if (!(sine > 1e-6)) return (1 - u) * a + u * b;
  return (std::sin((1 - u) * angle) * a + std::sin(u * angle) * b) / sine;
}

double Curves::seenWidth(std::uint32_t primitive, double u, Vec3d d) const {
  const Segment& s = segmentOf(primitive);
  const double width = lerp(u, double{s.width0}, double{s.width1});
  return type_ == CurveType::Ribbon ? width * absDot(ribbonNormal(primitive, u), d) : width;
}

std::optional<UserGeometry::Root> Curves::intersect(std::uint32_t primitive, const Ray& ray, double tMin,
                                                    double tMax, std::span<const float> excludedT) const {
  const Vec3d o = objectFromWorld_.point(Vec3d(ray.o)), direction = objectFromWorld_.vector(Vec3d(ray.d));
  const double perT = length(direction);  // object length
  if (!(perT > 0) || !std::isfinite(perT)) return std::nullopt;
  const Vec3d d = direction / perT;
  const Piece part = piece(primitive);
  const RaySpace space(o, d, part.curve.p[3] - part.curve.p[0]);

  struct Nearest {
    const Curves& curves;
    std::uint32_t primitive;
    const RaySpace& space;
    double perT, tMin, tMax;
    std::span<const float> excludedT;
    std::optional<Root> root;

    double widthAt(double u) const { return curves.seenWidth(primitive, u, space.z); }
    double zMax() const { return (root ? root->t : tMax) * perT; }
    void take(Vec3d spine, double u, double v) {
      const double t = spine.z / perT;
      const auto rounded = static_cast<float>(t);
      if (!std::isfinite(rounded) || rounded < tMin || rounded > tMax || (root && t >= root->t)) return;
      if (!excludedT.empty() && isWhereItStarts(spine, u)) return;
      root = Root{t, Point2f(Point2d(u, v))};
    }
    /// Whether some excluded point lies beside the strand's tangent here.
    bool isWhereItStarts(Vec3d spine, double u) const {
      const Segment& s = curves.segmentOf(primitive);
      const Vec3d along = space.vector(cubicOf(s).derivative(u));
      const double reach = kStartWidths * lerp(u, double{s.width0}, double{s.width1}), size = length(along);
      return std::ranges::any_of(excludedT, [&](float t) {
        const double here = spine.z / perT;
        if (std::abs(t - here) <= std::max(kSameRoot * here, kSameTinyRoot)) return true;
        const Vec3d from = Vec3d(0, 0, t * perT) - spine;
        return length(cross(along, from)) <= reach * size;
      });
    }
  };
  Nearest nearest{*this, primitive, space, perT, tMin, tMax, excludedT, std::nullopt};

  const Segment& s = segmentOf(primitive);
  CubicBezier inRaySpace;
  for (std::size_t i = 0; i < 4; ++i) inRaySpace.p[i] = space.point(part.curve.p[i]);
  const double widest = std::max(double{s.width0}, double{s.width1});
  CurveCrossing<Nearest>(nearest, widest).find(inRaySpace, part.u0, part.u1, kFlatness * widest);
  return nearest.root;
}

SurfaceInteraction Curves::interaction(const RayHit& hit, const Ray& ray) const {
  const std::uint32_t primitive = hit.id.primitive;
  const double u{hit.uv.x}, v{hit.uv.y};
  const Vec3d o = objectFromWorld_.point(Vec3d(ray.o)), direction = objectFromWorld_.vector(Vec3d(ray.d));
  const CubicBezier spine = cubicOf(segmentOf(primitive));
  const Vec3d dpdu = tangent(spine, u);
  const Vec3d d = normalize(direction);
  const RaySpace space(o, d, dpdu);

  const Vec3d along = normalize(dpdu);
  Vec3d across = type_ == CurveType::Ribbon ? cross(ribbonNormal(primitive, u), along) : Vec3d{};
  if (across == Vec3d{}) across = space.y;  // the ray and dp/du
  across = normalize(across);
  if (type_ == CurveType::Cylinder) {
    const double angle = -radians(lerp(v, -90.0, 90.0));
    across = std::cos(angle) * across + std::sin(angle) * cross(along, across);
  }

  SurfaceInteraction si;
  si.p = Point3f(o + double{hit.t} * direction);
  si.time = ray.time;
  si.wo = Vector3f(-d);
  si.n = Normal3f((flips_ ? -1.0 : 1.0) * normalize(cross(along, across)));
  si.uv = hit.uv;
  si.dpdu = Vector3f(dpdu);
  si.dpdv = Vector3f(seenWidth(primitive, u, d) * across);
  si.shading = {si.n, si.dpdu, si.dpdv, {}, {}};
  si.primitive = hit.id;
  si.turnsToRays = turnsToRays(type_);
  SurfaceInteraction world = transformInteraction(worldFromObject_, si);
  world.p = Point3f(Vec3d(ray.o) + double{hit.t} * Vec3d(ray.d));  // rounded once
  world.wo = Vector3f(normalize(-Vec3d(ray.d)));
  return world;
}

double Curves::area(std::uint32_t primitive) const {
  constexpr int kChords = 8;
  const Piece part = piece(primitive);
  const Segment& s = segmentOf(primitive);
  double spineLength = 0;
  Vec3d last = worldFromObject_.point(part.curve.p[0]);
  for (int i = 1; i <= kChords; ++i) {
    const Vec3d next = worldFromObject_.point(part.curve.at(double(i) / kChords));
    spineLength += distance(last, next);
    last = next;
  }
  const double scale = std::cbrt(std::abs(worldFromObject_.matrix().determinant3()));
  return spineLength * scale * lerp((part.u0 + part.u1) / 2, double{s.width0}, double{s.width1});
}

ShapeSample Curves::sample(std::uint32_t, Point2f) const { return {}; }

}  // namespace pbrtmedia
