// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/pixel_stream.h"
#include "integrators/path/path_event.h"
#include "integrators/sppm/photon.h"
#include "lighting/light_selector.h"
#include "lights/light.h"
#include "media/phase/phase_function.h"
#include "samplers/sampler.h"
#include "world/media_walk.h"
#include "world/scatter_point.h"

namespace pbrtmedia {

/// What all photons of an iteration share.
struct PhotonSetup {
  const Scene& scene;             ///< after Scene::prepareEmission
  const MediaTopology* media;     ///< null: there are none
  const LightSelector& selector;  ///< of Scene::illuminants(), the same everywhere
  int fewestScatterings = 1;      ///< before a photon is stored; direct light is known better otherwise
  int mostScatterings = 0;        ///< before the last vertex
  float time = 0;                 ///< of the scene
};

/// The photons of some light paths, in their order.
struct Photons {
  std::vector<SurfacePhoton> onSurfaces;
  std::vector<MediumPhoton> inMedia;
};

/// One light path from a light to its end, as `PathTracer` is one from the camera. Importance is scattered by
/// Material::bsdf's adjoint, and flies by MediaStretch::sampleFlightOfLight, so that photons are what paths
/// from where they are would find, under any law. Boundaries without material cost no depth.
///
/// What has lost much of the power it started with is thinned out by roulette. Only the light takes
/// dimensions of a sampler: well distributed directions of scattering took time and left the noise of a room
/// as it was.
class PhotonTracer {
 public:
  /// `sampler`: started; gives the dimensions of the light, `rng` the rest.
  PhotonTracer(const PhotonSetup& setup, Sampler& sampler, Rng& rng, RenderCounters& counters)
      : setup_(setup), sampler_(sampler), rng_(rng), counters_(counters) {}
  /// Once.
  void trace(Photons& out);

 private:
  struct MediumVertex {
    ScatterPoint at;
    const PhaseFunction* phase;
    Rgb sigmaS;
    std::size_t number;  ///< of the medium that collided, among those of the state
  };

  bool leaveLight();
  bool leaveMedium(const MediumLight& light, float probability, Point2f uPosition, Point2f uDirection);
  MediumState stateAtLight(const Light& light);
  PathEvent flyToEvent();
  bool collides(const MediaWalk& walk, const SceneHit* nearest, const BoundaryPlane& start);
  bool scatterOnSurface(Photons& out);
  bool scatterInMedium(Photons& out);
  bool storesHere() const { return scatterings_ >= setup_.fewestScatterings; }
  bool mayScatter() const { return scatterings_ < setup_.mostScatterings; }
  bool playRoulette();
  Point2f uniformSquare();
  void startSegment(Point3f o, Vector3f d, const BoundaryPlane& plane, const Exclusions& start);
  MediaWalk::Context walkContext() const { return {setup_.scene, setup_.media, counters_, counters_.rays}; }

  const PhotonSetup& setup_;
  Sampler& sampler_;
  Rng& rng_;
  RenderCounters& counters_;

  Ray ray_;
  Exclusions rayStart_;
  std::uint32_t hider_ = PrimitiveId::kNone;  ///< Scene::hiderOf the light; of the first segment
  BoundaryPlane startPlane_;
  ScatterPoint from_;  ///< where the ray starts, if in a medium
  MediumState state_;
  /// Of those of the state, the medium whose collision or emission the light on this stretch comes from.
  std::optional<std::size_t> source_;
  Rgb power_;
  float startSize_ = 0;  ///< largest channel of the power at the light
  int scatterings_ = 0;
  ScatteringsInPlace inPlace_;
  SurfaceVertex surface_;
  MediumVertex medium_{};
};

}  // namespace pbrtmedia
