// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "integrators/bdpt/bdpt_setup.h"
#include "integrators/bdpt/contribution.h"
#include "integrators/bdpt/path_vertex.h"

namespace pbrtmedia {

/// Radiance that a camera subpath finds by itself, by the number of its scatterings up to the last that finds
/// some: strategies without a vertex from the light's end.
using FoundRadiance = std::vector<Contribution>;

/// What lights and media emit toward a camera subpath along the way that it is on, weighed against the
/// strategies that look for the same light.
class FoundEmission {
 public:
  /// Borrows all of them. `path`: so far; `way`: the one behind its last vertex.
  FoundEmission(const BdptSetup& setup, SampleContext& context, const Subpath& path, const SubpathWay& way,
                FoundRadiance& found)
      : setup_(setup), context_(context), path_(path), way_(way), found_(found) {
    found_.clear();
  }

  void startWay() { passedEmitters_.clear(); }
  /// What the media emit between two surfaces.
  void addMedia(const MediaStretch& stretch, const MediumState& state);
  void addHit(const SceneHit& hit, const SurfaceInteraction& si);
  void addBackground();

 private:
  /// Of a light that the way has found, behind that depth of it.
  double weightOf(const LightPoint& light, Rgb depth) const;
  bool isDirect() const { return path_.vertices.empty() || path_.vertices.back().isSpecular; }
  /// What the subpath finds after as many scatterings as there are now.
  Contribution& here();

  const BdptSetup& setup_;
  SampleContext& context_;
  const Subpath& path_;
  const SubpathWay& way_;
  FoundRadiance& found_;
  std::vector<std::uint32_t> passedEmitters_;  ///< without material, by PrimitiveId::geometry
};

}  // namespace pbrtmedia
