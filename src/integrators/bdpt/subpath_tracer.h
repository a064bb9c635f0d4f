// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <vector>

#include "integrators/bdpt/bdpt_setup.h"
#include "integrators/bdpt/contribution.h"
#include "integrators/bdpt/path_vertex.h"
#include "integrators/path/path_samples.h"
#include "materials/transport_mode.h"

namespace pbrtmedia {

/// Radiance that a camera subpath finds by itself, by the number of its scatterings up to the last that finds
/// some: strategies without a vertex from the light's end.
/// Whether a surface is that of curves (BdptSetup::hasStrands).
bool isStrand(const Primitive& primitive);

using FoundRadiance = std::vector<Contribution>;

/// Walks one subpath, from the camera or from a light. Boundaries without material are crossed on the way and
/// are no vertices.
class SubpathTracer {
 public:
  SubpathTracer(const BdptSetup& setup, SampleContext& context)
      : setup_(setup), context_(context), samples_(context.sampler, context.rng, setup.sampledVertices) {}

  /// With up to setup.maxDepth scatterings, and a last way that only looks for emission, unless `looksBeyond`
  /// is false. `isSeen`: light subpaths find the camera too where this ray starts; `pdf` is its density.
  Subpath fromCamera(const Ray& ray, const MediumState& state, bool isSeen, WePdf pdf, FoundRadiance& found,
                     bool looksBeyond = true);
  /// The same from a light, `toCamera` being the camera's ray, of which it is known what media it starts in.
  /// Nothing when no light is sampled.
  std::optional<Subpath> fromLight(const Ray& toCamera, const MediumState& atCamera);

 private:
  enum class Event { End, Vertex };
  Event goOn();
  Event follow(MediaWalk& walk, BoundaryPlane start);
  bool passMedium(const MediaStretch& stretch, const SceneHit* hit, const BoundaryPlane& start, Event& event);
  void addMediumVertex(const MediaStretch& stretch, const MediumFlight& flight, const SceneHit* hit,
                       const BoundaryPlane& start);
  void addSurfaceVertex(MediaWalk& walk, const SceneHit& hit, const SurfaceInteraction& si);
  void addVertex(PathVertex vertex);
  bool scatter();
  bool scatterOnSurface(PathVertex& vertex);
  bool scatterBelowSurface();
  bool leaveSurface(PathVertex& vertex, const BsdfSample& sample);
  bool scatterInMedium(PathVertex& vertex);
  bool playRoulette();
  void trace();

  void collectMediumEmission(const MediaStretch& stretch);
  void collectHit(const SceneHit& hit, const SurfaceInteraction& si);
  void collectBackground();
  double weightOf(const LightPoint& light, Rgb depth) const;
  bool startInMedium(const LightSelector::Choice& choice, Point2f uPosition, Point2f uDirection,
                     Point3f camera, const MediumState& atCamera);

  bool seesOnlyEmission() const { return static_cast<int>(scatterings_) >= setup_.maxDepth; }
  bool isDirect() const { return path_.vertices.empty() || path_.vertices.back().isSpecular; }
  /// What the subpath finds after as many scatterings as there are now.
  Contribution& foundHere();

  const BdptSetup& setup_;
  SampleContext& context_;
  PathSamples samples_;
  FoundRadiance* found_ = nullptr;  ///< of a path from the camera
  bool looksBeyond_ = false;        ///< a last way looks for emission

  // The way at hand.
  Ray ray_;
  Exclusions rayStart_;
  BoundaryPlane startPlane_;
  ScatterPoint from_;
  MediumState state_;
  Rgb beta_{1.0f};
  Rgb depth_;                                  ///< of the way at hand, so far; by the control
  WePdf pdfCamera_{};                          ///< of the first way from the camera
  double pdfDirection_ = 0;                    ///< per solid angle, of the others
  float firstSize_ = 1;                        ///< of `beta_` at the start
  std::vector<std::uint32_t> passedEmitters_;  ///< without material, by PrimitiveId::geometry
  ScatteringsInPlace inPlace_;
  std::size_t scatterings_ = 0;  ///< so far

  Subpath path_;
};

}  // namespace pbrtmedia
