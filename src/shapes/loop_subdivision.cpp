// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/loop_subdivision.h"

#include <algorithm>
#include <numbers>
#include <span>
#include <stdexcept>
#include <tuple>

#include "base/interruption.h"

namespace pbrtmedia {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNone = 0xffffffffu;
/// Some 2 GB while they are made.
constexpr std::size_t kMaxTriangles = std::size_t{1} << 24;

/// A triangle's edge from `from` to `to`; `opposite` is its third corner.
struct HalfEdge {
  std::uint32_t from, to, opposite;
  std::uint32_t triangle, corner;  ///< it starts at this corner of this triangle
  auto key() const { return std::minmax(from, to); }
};

std::vector<HalfEdge> sortedHalfEdges(const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      edges.push_back({triangles[i][k], triangles[i][(k + 1) % 3], triangles[i][(k + 2) % 3], i, k});
    }
  }
  std::ranges::sort(edges, [](const HalfEdge& a, const HalfEdge& b) {
    leaveIfStopped();
    const auto ka = a.key(), kb = b.key();
    return ka != kb ? ka < kb : a.triangle < b.triangle;
  });
  return edges;
}

/// Calls f(first, last) for each undirected edge with its half-edges.
template <class F>
void forEachEdge(const std::vector<HalfEdge>& edges, F f) {
  for (std::size_t i = 0; i < edges.size();) {
    leaveIfStopped();
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].key() == edges[i].key()) ++end;
    f(i, end);
    i = end;
  }
}

/// Neighbours of a vertex.
struct Ring {
  Vec3d sum{};                                 ///< of all neighbours
  std::uint32_t valence = 0;                   ///< number of neighbours
  std::uint32_t boundary[2] = {kNone, kNone};  ///< neighbours along the border

  bool isBoundary() const { return boundary[0] != kNone; }
};

struct Surface {
  std::vector<Vec3d> positions;
  std::vector<Triangle> triangles;
};

std::vector<Ring> rings(const Surface& s, const std::vector<HalfEdge>& edges) {
  std::vector<Ring> result(s.positions.size());
  forEachEdge(edges, [&](std::size_t first, std::size_t last) {
    const std::uint32_t a = edges[first].from, b = edges[first].to;
    for (const auto& [at, other] : {std::pair{a, b}, std::pair{b, a}}) {
      Ring& ring = result[at];
      ring.sum += s.positions[other];
      ++ring.valence;
      if (last - first == 1) ring.boundary[ring.boundary[0] == kNone ? 0 : 1] = other;
    }
  });
  return result;
}

double interiorWeight(std::uint32_t valence) { return valence == 3 ? 3.0 / 16 : 3.0 / (8.0 * valence); }

/// (1 - n w) v + w (sum of n neighbours), over the border neighbours only when there is a border.
Vec3d relax(Vec3d v, const Ring& ring, const std::vector<Vec3d>& positions, double interior,
            double boundary) {
  if (ring.isBoundary()) {
    return (1 - 2 * boundary) * v + boundary * (positions[ring.boundary[0]] + positions[ring.boundary[1]]);
  }
  return (1 - ring.valence * interior) * v + interior * ring.sum;
}

Surface subdivideOnce(const Surface& s) {
  const auto edges = sortedHalfEdges(s.triangles);
  const auto around = rings(s, edges);
  Surface next;
  next.positions.reserve(s.positions.size() + edges.size() / 2);
  for (std::size_t i = 0; i < s.positions.size(); ++i) {
    next.positions.push_back(
        relax(s.positions[i], around[i], s.positions, interiorWeight(around[i].valence), 1.0 / 8));
  }
  std::vector<Triangle> middle(s.triangles.size());  // vertex on the edge that starts at each corner
  forEachEdge(edges, [&](std::size_t first, std::size_t last) {
    const HalfEdge& e = edges[first];
    const Vec3d ends = s.positions[e.from] + s.positions[e.to];
    const bool isBoundary = last - first == 1;
    const auto index = static_cast<std::uint32_t>(next.positions.size());
    next.positions.push_back(
        isBoundary
            ? 0.5 * ends
            : 3.0 / 8 * ends + 1.0 / 8 * (s.positions[e.opposite] + s.positions[edges[first + 1].opposite]));
    for (std::size_t k = first; k < last; ++k) middle[edges[k].triangle][edges[k].corner] = index;
  });
  next.triangles.reserve(4 * s.triangles.size());
  for (std::size_t i = 0; i < s.triangles.size(); ++i) {
    const auto [a, b, c] = s.triangles[i];
    const auto [ab, bc, ca] = middle[i];
    next.triangles.insert(next.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return next;
}

/// For one vertex and each of its triangles, the neighbour before and after it in counter-clockwise order.
struct Wedge {
  std::uint32_t vertex, from, to;
};

std::vector<Wedge> sortedWedges(const std::vector<Triangle>& triangles) {
  std::vector<Wedge> wedges;
  wedges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) wedges.push_back({t[k], t[(k + 1) % 3], t[(k + 2) % 3]});
  }
  std::ranges::sort(wedges, [](const Wedge& a, const Wedge& b) {
    leaveIfStopped();
    return std::tie(a.vertex, a.from) < std::tie(b.vertex, b.from);
  });
  return wedges;
}

/// The neighbours in counter-clockwise order, from border to border where there is one. `wedges`: those of
/// one vertex, by `from`. Empty when they do not form one fan.
std::vector<std::uint32_t> orderedRing(std::span<const Wedge> wedges) {
  std::vector<std::uint32_t> ends;
  ends.reserve(wedges.size());
  for (const Wedge& w : wedges) ends.push_back(w.to);
  std::ranges::sort(ends);
  const auto start =
      std::ranges::find_if(wedges, [&](const Wedge& w) { return !std::ranges::binary_search(ends, w.from); });
  const bool isBoundary = start != wedges.end();
  std::uint32_t at = isBoundary ? start->from : wedges.front().from;
  std::vector<std::uint32_t> ring{at};
  for (std::size_t i = 0; i < wedges.size(); ++i) {
    const auto next = std::ranges::lower_bound(wedges, at, {}, &Wedge::from);
    if (next == wedges.end() || next->from != at) return {};
    at = next->to;
    const bool closes = !isBoundary && i + 1 == wedges.size();
    if (closes != (at == ring.front())) return {};
    if (!closes) ring.push_back(at);
  }
  return ring;
}

/// Normal of the limit surface from its two tangents: the subdominant eigenvectors of the scheme, applied to
/// the control points (PBRT-v3 applies them to the limit positions, which is nearly the same).
Vec3d limitNormal(Vec3d v, const std::vector<Vec3d>& ring, bool isBoundary) {
  const std::size_t n = ring.size();
  Vec3d s, t;
  if (!isBoundary) {
    for (std::size_t k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
      s += std::cos(angle) * ring[k];
      t += std::sin(angle) * ring[k];
    }
    return cross(s, t);
  }
  s = ring.front() - ring.back();  // along the border
  if (n == 2) {                    // t: away from the border
    t = ring[0] + ring[1] - 2.0 * v;
  } else if (n == 3) {
    t = ring[1] - v;
  } else {
    const double theta = std::numbers::pi / static_cast<double>(n - 1);
    t = -std::sin(theta) * (ring.front() + ring.back());
    for (std::size_t k = 1; k + 1 < n; ++k) {
      t += (2 - 2 * std::cos(theta)) * std::sin(static_cast<double>(k) * theta) * ring[k];
    }
  }
  return cross(s, t);
}

Surface compacted(const LoopSubdivisionParams& params) {
  Surface s;
  std::vector<std::uint32_t> newIndex(params.P.size(), kNone);
  s.triangles.resize(params.indices.size() / 3);
  for (std::size_t i = 0; i < 3 * s.triangles.size(); ++i) {
    auto& index = newIndex[static_cast<std::size_t>(params.indices[i])];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(s.positions.size());
      s.positions.emplace_back(params.P[static_cast<std::size_t>(params.indices[i])]);
    }
    s.triangles[i / 3][i % 3] = index;
  }
  return s;
}

}  // namespace

std::vector<MeshProblem> validateLoop(const LoopSubdivisionParams& params) {
  auto problems = TriangleMesh::validate(
      {.indices = params.indices, .P = params.P, .N = {}, .S = {}, .uv = {}, .faceIndices = {}});
  const auto add = [&](const char* parameter, std::string message) {
    problems.push_back({Severity::Error, parameter, std::move(message)});
  };
  if (params.levels < 0 || params.levels > LoopSubdivisionParams::kMaxLevels) {
    add("levels", "is " + std::to_string(params.levels) + ", expected 0 to " +
                      std::to_string(LoopSubdivisionParams::kMaxLevels));
  } else if (const std::size_t count = (params.indices.size() / 3) << (2 * params.levels);
             count > kMaxTriangles) {
    int most = params.levels;
    while (most > 0 && (params.indices.size() / 3) << (2 * most) > kMaxTriangles) --most;
    add("levels", "is " + std::to_string(params.levels) + ", which gives " + std::to_string(count) +
                      " triangles; expected at most " + std::to_string(kMaxTriangles) + ", so up to " +
                      std::to_string(most) + " levels for this mesh");
  }
  if (std::ranges::any_of(problems, [](const auto& p) { return p.severity == Severity::Error; }))
    return problems;

  std::vector<Triangle> triangles(params.indices.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      triangles[i][k] = static_cast<std::uint32_t>(params.indices[3 * i + k]);
    const auto& t = triangles[i];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      add("indices", "triangle " + std::to_string(i) + " uses a vertex twice");
      return problems;
    }
  }
  const auto edges = sortedHalfEdges(triangles);
  forEachEdge(edges, [&](std::size_t first, std::size_t last) {
    if (problems.size() > 8) return;
    const std::string name = "the edge of vertices " + std::to_string(edges[first].key().first) + " and " +
                             std::to_string(edges[first].key().second);
    if (last - first > 2) add("indices", name + " belongs to more than two triangles");
    if (last - first == 2 && edges[first].from == edges[first + 1].from) {
      add("indices", name + " has the same direction in both its triangles; one of them must be turned");
    }
  });
  if (std::ranges::any_of(problems, [](const auto& p) { return p.severity == Severity::Error; }))
    return problems;
  const auto wedges = sortedWedges(triangles);
  for (std::size_t i = 0; i < wedges.size();) {
    std::size_t end = i;
    while (end < wedges.size() && wedges[end].vertex == wedges[i].vertex) ++end;
    if (orderedRing({&wedges[i], end - i}).empty()) {
      add("indices", "the triangles at vertex " + std::to_string(wedges[i].vertex) + " do not form one fan");
      break;
    }
    i = end;
  }
  return problems;
}

TriangleMesh::Params subdivideLoop(const LoopSubdivisionParams& params) {
  std::string errors;
  for (const MeshProblem& problem : validateLoop(params)) {
    if (problem.severity == Severity::Error)
      errors += (errors.empty() ? "" : "; ") + problem.parameter + ": " + problem.message;
  }
  if (!errors.empty()) throw std::invalid_argument(errors);

  Surface s = compacted(params);
  for (int i = 0; i < params.levels; ++i) s = subdivideOnce(s);

  const auto around = rings(s, sortedHalfEdges(s.triangles));
  std::vector<Vec3d> limit;
  limit.reserve(s.positions.size());
  for (std::size_t i = 0; i < s.positions.size(); ++i) {
    const std::uint32_t n = around[i].valence;
    limit.push_back(
        relax(s.positions[i], around[i], s.positions, 1 / (n + 3 / (8 * interiorWeight(n))), 1.0 / 5));
  }
  TriangleMesh::Params mesh;
  mesh.P.reserve(limit.size());
  for (const Vec3d& p : limit) mesh.P.emplace_back(p);
  mesh.N.reserve(limit.size());
  const auto wedges = sortedWedges(s.triangles);
  std::vector<Vec3d> ring;
  for (std::size_t i = 0; i < wedges.size();) {
    std::size_t end = i;
    while (end < wedges.size() && wedges[end].vertex == wedges[i].vertex) ++end;
    ring.clear();
    for (const std::uint32_t k : orderedRing({&wedges[i], end - i})) ring.push_back(s.positions[k]);
    const std::uint32_t vertex = wedges[i].vertex;
    const Vec3d n = limitNormal(s.positions[vertex], ring, around[vertex].isBoundary());
    const double size = length(n);
    // Clockwise side, as in PBRT-v3. Zero: the triangle's own normal is used.
    leaveIfStopped();
    mesh.N.emplace_back(size > 0 ? -n / size : Vec3d{});
    i = end;
  }
  mesh.indices.reserve(3 * s.triangles.size());
  for (const Triangle& t : s.triangles) {
    for (const std::uint32_t k : t) mesh.indices.push_back(static_cast<int>(k));
  }
  return mesh;
}

}  // namespace pbrtmedia
