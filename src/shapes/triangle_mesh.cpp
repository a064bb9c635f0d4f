// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/triangle_mesh.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace pbrtmedia {
namespace {

/// Below this determinant of the corner (u, v) the tangents follow no parametrisation (scene-language
/// reference 13.3).
constexpr double kDegenerateUv = 1e-8;

std::string at(std::string_view array, std::size_t index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

template <class T>
void checkCount(std::vector<MeshProblem>& problems, const char* name, const std::vector<T>& values,
                std::size_t expected, const char* of) {
  if (values.empty() || values.size() == expected) return;
  problems.push_back({Severity::Error, name,
                      "has " + std::to_string(values.size()) + " elements, expected " +
                          std::to_string(expected) + ", one per " + of});
}

template <class T>
void checkFinite(std::vector<MeshProblem>& problems, const char* name, const std::vector<T>& values) {
  const auto bad = std::ranges::find_if(values, [](const T& v) { return !isFinite(v); });
  if (bad == values.end()) return;
  problems.push_back({Severity::Error, name,
                      at(name, static_cast<std::size_t>(bad - values.begin())) + " is not a finite number"});
}

Vec3d interpolate(double b0, double b1, double b2, const auto& p) {
  return b0 * Vec3d(p[0]) + b1 * Vec3d(p[1]) + b2 * Vec3d(p[2]);
}

/// Derivatives by (u, v) of what has the values `p` at corners with parameters `uv`.
struct UvDerivatives {
  Vec3d du, dv;
};
std::optional<UvDerivatives> uvDerivatives(const std::array<Point2f, 3>& uv, const std::array<Vec3d, 3>& p) {
  const Point2d e0 = Point2d(uv[0]) - Point2d(uv[2]), e1 = Point2d(uv[1]) - Point2d(uv[2]);
  const double determinant = e0.x * e1.y - e0.y * e1.x;
  if (!(std::abs(determinant) >= kDegenerateUv)) return std::nullopt;
  const Vec3d d0 = p[0] - p[2], d1 = p[1] - p[2];
  return UvDerivatives{(e1.y * d0 - e0.y * d1) / determinant, (e0.x * d1 - e1.x * d0) / determinant};
}

}  // namespace

std::vector<MeshProblem> TriangleMesh::validate(const Params& params) {
  std::vector<MeshProblem> problems;
  if (params.P.empty()) problems.push_back({Severity::Error, "P", "is missing or empty"});
  if (params.indices.size() < 3) {
    problems.push_back(
        {Severity::Error, "indices",
         "holds " + std::to_string(params.indices.size()) + " numbers, expected three per triangle"});
  } else if (params.indices.size() % 3 != 0) {
    problems.push_back({Severity::Warning, "indices",
                        "holds " + std::to_string(params.indices.size()) +
                            " numbers, not a multiple of three; the incomplete last triangle is left out"});
  }
  const auto bad = std::ranges::find_if(
      params.indices, [&](int i) { return i < 0 || static_cast<std::size_t>(i) >= params.P.size(); });
  if (bad != params.indices.end() && !params.P.empty()) {
    problems.push_back({Severity::Error, "indices",
                        at("indices", static_cast<std::size_t>(bad - params.indices.begin())) + " is " +
                            std::to_string(*bad) + ", expected 0 to " + std::to_string(params.P.size() - 1) +
                            " for the " + std::to_string(params.P.size()) + " vertices in P"});
  }
  checkCount(problems, "N", params.N, params.P.size(), "vertex in P");
  checkCount(problems, "S", params.S, params.P.size(), "vertex in P");
  checkCount(problems, "faceIndices", params.faceIndices, params.indices.size() / 3, "triangle");
  if (params.uv.size() > params.P.size()) {
    problems.push_back({Severity::Warning, "uv",
                        "has " + std::to_string(params.uv.size()) + " elements for " +
                            std::to_string(params.P.size()) + " vertices; the rest is left out"});
  } else {
    checkCount(problems, "uv", params.uv, params.P.size(), "vertex in P");
  }
  checkFinite(problems, "P", params.P);
  checkFinite(problems, "N", params.N);
  checkFinite(problems, "S", params.S);
  checkFinite(problems, "uv", params.uv);
  return problems;
}

TriangleMesh::TriangleMesh(Params params, const ShapePlacement& placement, std::string_view typeName)
    : typeName_(typeName) {
  std::string errors;
  for (const MeshProblem& problem : validate(params)) {
    if (problem.severity != Severity::Error) continue;
    if (!errors.empty()) errors += "; ";
    errors += problem.parameter + ": " + problem.message;
  }
  if (!errors.empty()) throw std::invalid_argument(errors);

  const Transform& t = placement.worldFromObject;
  if (t.isSingular()) {  // pressed flat: normals have no image, and those of the faces remain, as in PBRT-v3
    params.N.clear();
    params.S.clear();
  }
  triangles_.resize(params.indices.size() / 3);
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      triangles_[i][k] = static_cast<std::uint32_t>(params.indices[3 * i + k]);
  }
  positions_ = std::move(params.P);
  positions_.reserve(positions_.size() + 1);
  for (Point3f& p : positions_) p = t.point(p);
  for (const auto& corners : triangles_) {
    for (const std::uint32_t i : corners) bounds_.expand(positions_[i]);
  }
  positions_.emplace_back();

  normals_ = std::move(params.N);
  reversesNormals_ = placement.reverseOrientation;
  for (Normal3f& n : normals_) n = placement.reverseOrientation ? -t.normal(n) : t.normal(n);
  tangents_ = std::move(params.S);
  for (Vector3f& s : tangents_) s = t.vector(s);
  uv_ = std::move(params.uv);
  if (!uv_.empty()) uv_.resize(vertexCount());
  faceIndices_.assign(params.faceIndices.begin(), params.faceIndices.end());

  // A mirroring CTM turns the cross product of the world-space edges; undone, so that the object's front
  // stays.
  const bool onlyTangents = normals_.empty() && !tangents_.empty();
  isSampledFromBehind_ = placement.reverseOrientation && (!normals_.empty() || !tangents_.empty());
  flipsFace_ = onlyTangents ? t.swapsHandedness() : placement.flipsNormal();
}

Shape::Geometry TriangleMesh::geometry() const {
  return TriangleBuffers{
      .positions = {positions_.data(), vertexCount()}, .indices = triangles_, .paddedPositions = true};
}

std::array<Point3f, 3> TriangleMesh::corners(std::uint32_t primitive) const {
  const auto& c = triangles_[primitive];
  return {positions_[c[0]], positions_[c[1]], positions_[c[2]]};
}

std::array<Point2f, 3> TriangleMesh::cornerUv(std::uint32_t primitive) const {
  if (uv_.empty()) return {Point2f(0, 0), Point2f(1, 0), Point2f(1, 1)};
  const auto& c = triangles_[primitive];
  return {uv_[c[0]], uv_[c[1]], uv_[c[2]]};
}

Vec3d TriangleMesh::faceVector(std::uint32_t primitive) const {
  const auto p = corners(primitive);
  const Vec3d n = cross(Vec3d(p[1]) - Vec3d(p[0]), Vec3d(p[2]) - Vec3d(p[0]));
  return flipsFace_ ? -n : n;
}

Vec3d TriangleMesh::interpolatedNormal(std::uint32_t primitive, const Weights& b) const {
  if (normals_.empty()) return {};
  const auto& c = triangles_[primitive];
  return interpolate(b.b0, b.b1, b.b2, std::array{normals_[c[0]], normals_[c[1]], normals_[c[2]]});
}

Vec3d TriangleMesh::orientedNormal(std::uint32_t primitive, Vec3d shadingNormal) const {
  const Vec3d face = faceVector(primitive);
  const double size = length(face);
  if (!(size > 0)) {  // never hit; still something finite
    const double other = length(shadingNormal);
    return other > 0 ? shadingNormal / other : Vec3d(0, 0, 1);
  }
  return faceForward(face / size, shadingNormal);  // a zero shading normal changes nothing
}

SurfaceInteraction TriangleMesh::interaction(const RayHit& hit, const Ray& ray) const {
  const std::uint32_t triangle = hit.id.primitive;
  Weights b{.b0 = 1.0 - hit.uv.x - hit.uv.y, .b1 = hit.uv.x, .b2 = hit.uv.y};
  if (b.b0 < 0) {  // rounding beyond the far edge
    const double sum = b.b1 + b.b2;
    b = {0, b.b1 / sum, b.b2 / sum};
  }
  const auto cornersFloat = corners(triangle);
  const std::array<Vec3d, 3> p{Vec3d(cornersFloat[0]), Vec3d(cornersFloat[1]), Vec3d(cornersFloat[2])};
  const auto uv = cornerUv(triangle);
  const Vec3d rawNs = interpolatedNormal(triangle, b), n = orientedNormal(triangle, rawNs);

  SurfaceInteraction si;
  si.p = Point3f(interpolate(b.b0, b.b1, b.b2, p));
  si.time = ray.time;
  si.wo = Vector3f(normalize(-Vec3d(ray.d)));
  si.n = Normal3f(n);
  si.uv = {static_cast<float>(b.b0 * uv[0].x + b.b1 * uv[1].x + b.b2 * uv[2].x),
           static_cast<float>(b.b0 * uv[0].y + b.b1 * uv[1].y + b.b2 * uv[2].y)};
  const auto dp = uvDerivatives(uv, p);
  if (dp && lengthSquared(cross(dp->du, dp->dv)) > 0) {
    si.dpdu = Vector3f(dp->du);
    si.dpdv = Vector3f(dp->dv);
  } else {
    const auto [s, t] = coordinateSystem(n);
    si.dpdu = Vector3f(s);
    si.dpdv = Vector3f(t);
  }
  si.shading = {si.n, si.dpdu, si.dpdv, {}, {}};
  si.primitive = hit.id;
  if (!faceIndices_.empty()) si.faceIndex = faceIndices_[triangle];
  if (normals_.empty() && tangents_.empty()) return si;

  const double nsLength = length(rawNs);
  const Vec3d ns = nsLength > 0 ? rawNs / nsLength : n;
  const auto& c = triangles_[triangle];
  Vec3d s(si.dpdu);
  if (!tangents_.empty()) {
    const Vec3d given =
        interpolate(b.b0, b.b1, b.b2, std::array{tangents_[c[0]], tangents_[c[1]], tangents_[c[2]]});
    if (lengthSquared(given) > 0) s = given;
  }
  // The unit tangent t = s x n, then t x n = -s: both turned by 180 degrees about n, see the class comment.
  const Vec3d across = cross(normalize(s), ns);
  Vec3d dpdus, dpdvs;
  if (lengthSquared(across) > 0) {
    dpdvs = normalize(across);
    dpdus = cross(dpdvs, ns);
  } else {
    std::tie(dpdus, dpdvs) = coordinateSystem(ns);
  }
  Vec3d dndu, dndv;
  if (nsLength > 0) {
    const auto dn = uvDerivatives(uv, {Vec3d(normals_[c[0]]), Vec3d(normals_[c[1]]), Vec3d(normals_[c[2]])});
    const double side = reversesNormals_ ? -1 : 1;
    if (dn) {
      dndu = side * dn->du;
      dndv = side * dn->dv;
    }
  }
  si.setShading(Normal3f(ns), Vector3f(dpdus), Vector3f(dpdvs), Normal3f(dndu), Normal3f(dndv),
                /*orientationIsAuthoritative=*/!normals_.empty());
  return si;
}

Point2f TriangleMesh::uvAt(const RayHit& hit) const {
  const auto uv = cornerUv(hit.id.primitive);
  const float b0 = std::max(0.0f, 1 - hit.uv.x - hit.uv.y);
  return b0 * uv[0] + hit.uv.x * uv[1] + hit.uv.y * uv[2];
}

double TriangleMesh::area(std::uint32_t primitive) const { return 0.5 * length(faceVector(primitive)); }

ShapeSample TriangleMesh::sample(std::uint32_t primitive, Point2f u) const {
  const double root = std::sqrt(static_cast<double>(u.x));
  const Weights b{.b0 = 1 - root, .b1 = u.y * root, .b2 = root - u.y * root};
  const auto pdf = static_cast<float>(1 / area(primitive));
  return {.p = Point3f(interpolate(b.b0, b.b1, b.b2, corners(primitive))),
          .n = Normal3f(orientedNormal(primitive, interpolatedNormal(primitive, b))),
          .pdf = std::isfinite(pdf) ? pdf : 0};
}

bool TriangleMesh::isClosed() const {
  // Vertices at equal positions get one number.
  std::vector<std::uint32_t> order(vertexCount()), welded(vertexCount());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::array{positions_[i].x, positions_[i].y, positions_[i].z};
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool isSame = i > 0 && positions_[order[i]] == positions_[order[i - 1]];
    welded[order[i]] = isSame ? welded[order[i - 1]] : order[i];
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * triangles_.size());
  for (const auto& c : triangles_) {
    const std::array v{welded[c[0]], welded[c[1]], welded[c[2]]};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;  // a line: no surface
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(v[k], v[(k + 1) % 3]));
  }
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    if (i + 1 == edges.size() || edges[i] != edges[i + 1]) return false;
    if (i + 2 < edges.size() && edges[i] == edges[i + 2]) return false;
  }
  return !edges.empty();
}

}  // namespace pbrtmedia
