// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "integrators/bdpt/bdpt_setup.h"
#include "integrators/bdpt/found_emission.h"
#include "integrators/bdpt/path_vertex.h"
#include "integrators/path/path_samples.h"
#include "materials/transport_mode.h"

namespace pbrtmedia {

/// Walks one subpath, from the camera or from a light. Boundaries without material are crossed on the way and
/// are no vertices.
class SubpathTracer {
 public:
  SubpathTracer(const BdptSetup& setup, SampleContext& context)
      : setup_(setup), context_(context), samples_(context.sampler, context.rng, setup.sampledVertices) {}
  SubpathTracer(const SubpathTracer&) = delete;
  SubpathTracer& operator=(const SubpathTracer&) = delete;

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
  PathVertex& addVertex();
  void findDensity();
  bool scatter();
  bool scatterOnSurface(PathVertex& vertex);
  bool scatterBelowSurface();
  bool leaveSurface(PathVertex& vertex, const BsdfSample& sample);
  bool scatterInMedium(PathVertex& vertex);
  bool playRoulette();
  void trace();

  bool startInMedium(const LightSelector::Choice& choice, Point2f uPosition, Point2f uDirection,
                     Point3f camera, const MediumState& atCamera);

  bool seesOnlyEmission() const { return static_cast<int>(path_.scatterings()) >= setup_.maxDepth; }

  const BdptSetup& setup_;
  SampleContext& context_;
  PathSamples samples_;
  std::optional<FoundEmission> found_;  ///< of a path from the camera
  bool looksBeyond_ = false;            ///< a last way looks for emission

  // The way at hand.
  SubpathWay way_;
  Exclusions rayStart_;
  BoundaryPlane startPlane_;
  ScatterPoint from_;
  MediumState state_;
  WePdf pdfCamera_{};    ///< of the first way from the camera
  float firstSize_ = 1;  ///< of the way's `beta` at the start
  ScatteringsInPlace inPlace_;

  Subpath path_;
};

}  // namespace pbrtmedia
