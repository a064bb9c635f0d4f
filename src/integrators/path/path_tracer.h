// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <vector>

#include "integrators/path/indirect_light.h"
#include "integrators/path/path.h"
#include "integrators/path/path_event.h"
#include "integrators/path/path_samples.h"
#include "integrators/path/transmittance_shares.h"
#include "lighting/light_receiver.h"
#include "materials/bsdf.h"
#include "media/phase/phase_function.h"
#include "render/ray_layers.h"
#include "singlescattering/shared_explorers.h"
#include "singlescattering/single_scattering.h"
#include "world/media_walk.h"
#include "world/visibility.h"

namespace pbrtmedia {

/// What all paths of an integrator share.
struct PathSetup {
  const Scene& scene;
  const PathParams& params;
  std::size_t lightCount;                    ///< of Scene::illuminants() that illuminate
  const LightSelector* selector;             ///< of these; null: there are none
  const MediaTopology* media;                ///< null: media are ignored
  const SingleScattering* singleScattering;  ///< null: collisions alone sample lights in media
  bool mediaEmit;                            ///< some medium may emit
  SharedExplorers* explorers = nullptr;      ///< of camera rays; null: each path explores for itself
};

/// One path of `path` or `volpath`, from the camera to its end. Every vertex takes one light sample, and its
/// continuation is at the same time the other half of direct lighting: what it finds emitting is weighted by
/// the power heuristic (Veach & Guibas 1995, doi:10.1145/218380.218498). So the last vertex still sends a ray
/// that looks for emission only, and `maxDepth` counts vertices as in PBRT-v3.
///
/// With an IndirectLight the last vertex is the first that scatters in a medium or diffusely on a surface. A
/// surface that has specular lobes too goes on by these as often as their number says.
class PathTracer {
 public:
  PathTracer(const PathSetup& setup, const RayDifferential& ray, const MediumState& start,
             SampleContext& context, IndirectLight* indirect = nullptr);
  /// The estimate of the radiance arriving at the ray's origin. Once.
  Rgb trace();

 private:
  struct MediumVertex {
    ScatterPoint at;
    const PhaseFunction* phase;
    double t, tMin, tMax;              ///< on the ray, and the stretch in media that it was sampled on
    std::optional<double> extinction;  ///< LitStretch; nothing: no lights were sampled on the stretch
    float scattered;                   ///< what the flight says of the albedo, of the channel with most
  };

  /// The way from one scattering event toward the next.
  struct Way {
    MediaWalk walk;
    BoundaryPlane start;  ///< of the stretch at hand
    /// Emitters without material that the ray has met, by PrimitiveId::geometry: the rest of each is hidden.
    std::vector<std::uint32_t> passedEmitters{};
  };

  MediaWalk::Context walkContext() const;
  MediaWalk::Context shadowContext() const;
  /// Scatters from `event` on until the path ends; what it has gathered.
  Rgb scatterFrom(PathEvent event);
  // Each path event is one function. Those that return bool tell whether the path goes on.
  PathEvent flyToEvent();
  /// Adds radiance that was scattered so often; `here`: by what at the vertex at hand.
  void gather(Rgb radiance, int scatterings, RayLayers::Scatterer here);
  void tellSurface(const Bsdf& bsdf);
  void tellScattering();
  PathEvent followWay(Way& way);
  bool passMedium(const Way& way, const SceneHit* hit, PathEvent& event);
  MediumFlight fly(const MediaStretch& stretch);
  bool splitsChannels() const;
  void followChannels(const Way& way);
  void lightStretch(const LitStretch& stretch, const SceneHit* hit, const BoundaryPlane& start);
  void collectMediumEmission(const MediaStretch& stretch);
  void collectEmission(Way& way, const SceneHit& hit, const SurfaceInteraction& si);
  void collectBackground();
  bool scatterOnSurface();
  bool scatterBelowSurface();
  bool leaveSurface(const Bsdf& bsdf, const BsdfSample& sample);
  struct LobeChoice {
    BsdfFlags lobes = BsdfFlags::All;
    float share = 1;  ///< probability
    Point2f u;        ///< for the sample of their direction
  };
  LobeChoice askForIndirectLight(const Bsdf& bsdf);
  bool scatterInMedium();
  void lightSurface(const Bsdf& bsdf);
  void lightMedium();
  bool playRoulette(bool inMedium);

  struct PickedLight {
    std::size_t index;
    float probability;   ///< of the pick
    LightSample sample;  ///< pdf includes `probability`
  };
  std::optional<PickedLight> pickLight();
  Rgb arriving(const PickedLight& light, Point3f p, const Exclusions& start, const MediumState& state,
               const ScatterPoint* from = nullptr);
  void gatherLight(const PickedLight& light, Rgb radiance, RayLayers::Scatterer here);
  Rgb arrivingShare(const PickedLight& light, Point3f p, const Exclusions& start, const MediumState& state,
                    float directionPdf, const ScatterPoint* from = nullptr);
  float lightWeight(const PickedLight& light, float directionPdf) const;
  float comparableDensity(const PickedLight& light) const;
  bool sharesByTransmittance(const PickedLight& light, float directionPdf) const;
  float collisionShare(std::size_t light, Point3f p) const;
  Rgb emissionWeight(std::size_t light, const SurfaceInteraction* si);
  Rgb scatteringShare(const TransmittanceShares& shares);
  float mediumEmissionWeight(const MediumLight& source, std::size_t light) const;
  SurfaceInteraction surfaceAt(const SceneHit& hit) const;
  void startSegment(Point3f o, Vector3f d, const BoundaryPlane& plane, const Exclusions& start);
  bool seesOnlyEmission() const { return bounces_ >= lastVertex_; }
  /// Whether weights at a vertex after so many scatterings know the transmittance of what its rays pass. Not
  /// at the last one: what it looks at is dimmed by estimates, as light samples are, and no flight ends.
  bool knowsTransmittance(int scatterings) const {
    return setup_.params.misTransmittance != MisTransmittance::None && setup_.media &&
           scatterings < lastVertex_;
  }

  const PathSetup& setup_;
  SampleContext& context_;
  IndirectLight* indirect_;  ///< null: the path goes on
  PathSamples samples_;
  RenderCounters& counters_;

  RayDifferential ray_;
  Exclusions rayStart_;
  BoundaryPlane startPlane_;
  ScatterPoint from_;  ///< where the ray starts, if in a medium
  MediumState state_;
  RayLayers* layers_ = nullptr;   ///< null: nobody wants to know
  RayLayers::Scatterer first_{};  ///< what scattered first, once something has
  SurfaceVertex surface_;
  MediumVertex medium_{};

  Rgb beta_{1.0f}, radiance_;
  int bounces_ = 0;
  std::uint64_t ledFlights_ = 0;  ///< so far
  int lastVertex_;                ///< number of the last scattering
  ScatteringsInPlace inPlace_;
  float etaScale_ = 1;  ///< undoes the radiance scaling of refraction in roulette decisions
  // The vertex the current segment starts on, as multiple importance sampling sees it.
  bool isDirect_ = true;               ///< camera or perfect specular vertex: emission counts fully
  float directionPdf_ = 0;             ///< solid-angle density of the segment's direction
  LightReceiver receiver_{Point3f()};  ///< what the light sample there was chosen for
  struct PassedStretch {
    MediumState state;
    double tMin, tMax;
  };
  std::vector<PassedStretch> passed_;  ///< by the current segment; for weights that know the transmittance
};

}  // namespace pbrtmedia
