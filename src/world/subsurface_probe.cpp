// SPDX-License-Identifier: BSD-2-Clause
#include "world/subsurface_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "materials/shading_frame.h"
#include "world/line_walk.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kAxes = 3, kChannels = 3;
/// Of the tangents and the normal: most light comes out not far away, where the surface is flat.
constexpr std::array<float, kAxes> kAxisProbability{0.25f, 0.25f, 0.5f};

/// Tangents and normal of the entry.
std::array<Vector3f, kAxes> axesOf(const SurfaceInteraction& entry) {
  const Frame frame = shadingFrame(entry);
  return {frame.s, frame.t, frame.n};
}

/// One of `count` equal parts of the unit interval, u stretched for reuse.
std::size_t pickPart(float& u, std::size_t count) {
  const float stretched = u * static_cast<float>(count);
  const std::size_t part = std::min(static_cast<std::size_t>(stretched), count - 1);
  u = std::min(stretched - static_cast<float>(part), kOneMinusEpsilon);
  return part;
}

std::size_t pickAxis(float& u) {
  std::size_t axis = 0;
  while (axis + 1 < kAxes && u >= kAxisProbability[axis]) u -= kAxisProbability[axis++];
  u = std::min(u / kAxisProbability[axis], kOneMinusEpsilon);
  return axis;
}

/// Density [1/area] of the point `d` away from the entry with normal n, over all axes and channels; of a line
/// with one hit.
float pdfOf(const Bssrdf& bssrdf, const std::array<Vector3f, kAxes>& axes,
            const std::array<float, kChannels>& reach, Vector3f d, Normal3f n) {
  std::array<float, kAxes> along{};
  for (std::size_t a = 0; a < kAxes; ++a) along[a] = dot(axes[a], d);
  const float distance = length(d);
  float sum = 0;
  for (std::size_t a = 0; a < kAxes; ++a) {
    const float radius = std::hypot(along[(a + 1) % kAxes], along[(a + 2) % kAxes]);
    const float projected = kAxisProbability[a] * absDot(axes[a], n) / kChannels;
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (distance < reach[c]) sum += projected * bssrdf.pdfRadius(c, radius);
    }
  }
  return sum;
}

}  // namespace

std::optional<SubsurfaceEmergence> sampleEmergence(const Scene& scene, const Bssrdf& bssrdf,
                                                   const SurfaceInteraction& entry, float time,
                                                   const Material& material, float uWay, Point2f u,
                                                   std::uint64_t& queries) {
  const std::array<Vector3f, kAxes> axes = axesOf(entry);
  const std::size_t axis = pickAxis(uWay), channel = pickPart(uWay, kChannels);
  std::array<float, kChannels> reach{};
  for (std::size_t c = 0; c < kChannels; ++c) reach[c] = bssrdf.reach(c);
  const float radius = bssrdf.sampleRadius(channel, u.x);
  if (radius < 0 || !(radius < reach[channel])) return std::nullopt;

  const float half = std::sqrt(std::max(0.0f, sqr(reach[channel]) - sqr(radius))), phi = 2 * kPi * u.y;
  const Vector3f away =
      radius * (std::cos(phi) * axes[(axis + 1) % kAxes] + std::sin(phi) * axes[(axis + 2) % kAxes]);
  Ray line;
  line.o = entry.p + away - half * axes[axis];
  line.d = axes[axis];
  line.tMax = 2 * half;
  line.time = time;
  std::vector<SceneHit> found;
  LineWalk walk(scene, line, {});
  while (const std::optional<SceneHit> hit = walk.next(queries)) {
    if (hit->primitive->material == &material) found.push_back(*hit);
  }
  if (found.empty()) return std::nullopt;
  const SceneHit hit = found[pickPart(uWay, found.size())];
  const SurfaceInteraction si = scene.surface(hit, line);
  const Vector3f d = si.p - entry.p;
  const float pdf = pdfOf(bssrdf, axes, reach, d, si.n);
  if (!(pdf > 0)) return std::nullopt;
  return SubsurfaceEmergence{hit, si, bssrdf.radial(length(d)) * (static_cast<float>(found.size()) / pdf)};
}

}  // namespace pbrtmedia
