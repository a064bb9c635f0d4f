// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/subpath_tracer.h"

#include <algorithm>

#include "base/warp.h"
#include "integrators/bdpt/light_surroundings.h"
#include "materials/bssrdf.h"
#include "materials/material.h"
#include "materials/subsurface_exit.h"
#include "shapes/curves.h"
#include "spectrum/largest_channel.h"
#include "world/boundary_planes.h"
#include "world/media_below.h"
#include "world/medium_light.h"

namespace pbrtmedia {
namespace {

/// Subpaths of less weight than this, relative to their start, are thinned out.
constexpr float kRouletteWeight = 0.03f;
constexpr std::size_t kMostReserved = 16;

/// Density per solid angle of `wo` given `wi` relative to that of `wi` given `wo`, for a lobe without extent:
/// eta² cos d(direction) is the same on both sides of a surface.
double specularPdfBack(const Bsdf& bsdf, const SurfaceInteraction& si, Vector3f wi) {
  const double cosO = absDot(si.wo, bsdf.shadingNormal()), cosI = absDot(wi, bsdf.shadingNormal());
  if (!(cosI > 0)) return 1;
  const float outside = dot(si.wo, si.n);
  const double eta = outside * dot(wi, si.n) < 0 ? double{bsdf.eta()} : 1;
  return cosO / cosI * (outside > 0 ? 1 / sqr(eta) : sqr(eta));
}

}  // namespace

bool isStrand(const Primitive& primitive) { return dynamic_cast<const Curves*>(primitive.shape) != nullptr; }

Subpath SubpathTracer::fromCamera(const Ray& ray, const MediumState& state, bool isSeen, WePdf pdf,
                                  FoundRadiance& found, bool looksBeyond) {
  found.clear();
  found_ = &found;
  looksBeyond_ = looksBeyond;
  path_.firstOthers = isSeen ? 1 : 0;
  pdfCamera_ = pdf;
  ray_ = ray;
  state_ = state;
  trace();
  return std::move(path_);
}

std::optional<Subpath> SubpathTracer::fromLight(const Ray& toCamera, const MediumState& atCamera) {
  path_.fromLight = true;
  if (!setup_.startSelector || setup_.maxDepth == 0) return std::nullopt;
  const LightSelector::Choice choice = setup_.startSelector->choose(toCamera.o, context_.sampler.get1D());
  const Point2f uPosition = context_.sampler.get2D(), uDirection = context_.sampler.get2D();
  if (setup_.scene.mediumLight(choice.light)) {
    ray_.time = toCamera.time;
    if (!startInMedium(choice, uPosition, uDirection, toCamera.o, atCamera)) return std::nullopt;
    trace();
    return std::move(path_);
  }
  const Light& light = *setup_.scene.lights()[choice.light];
  if (!setup_.weights.startsOn(light)) return std::nullopt;
  const LeSample s = light.sampleLe(uPosition, uDirection, toCamera.time);
  const float pdf = choice.probability * s.pdf.position * s.pdf.direction;
  if (!(pdf > 0) || s.radiance.isBlack()) return std::nullopt;
  const PrimitiveId target = setup_.scene.lightTarget(choice.light);
  LightSurroundings around =
      surroundingsOf(setup_, target, light.isAtInfinity(), s.ray, s.normal, toCamera.o, atCamera, context_);
  ray_ = s.ray;
  rayStart_ = around.start;
  startPlane_ = around.plane;
  state_ = std::move(around.state);
  beta_ = s.radiance * (absDot(s.normal, s.ray.d) / pdf);
  path_.light = {.index = choice.light,
                 .light = &light,
                 .p = s.ray.o,
                 .n = s.normal,
                 .d = -s.ray.d,
                 .isArea = target.isValid()};
  trace();
  return std::move(path_);
}

/// From a point inside an emissive medium, in any direction.
bool SubpathTracer::startInMedium(const LightSelector::Choice& choice, Point2f uPosition, Point2f uDirection,
                                  Point3f camera, const MediumState& atCamera) {
  const MediumLight& light = *setup_.scene.mediumLight(choice.light);
  ray_.o = light.samplePoint(uPosition, ray_.time);
  ray_.d = sampleUniformSphere(uDirection);
  const double pdf =
      double{choice.probability} * light.pointPdf(ray_.o, ray_.time) * StrategyWeights::kAnyDirection;
  if (!setup_.media || !(pdf > 0)) return false;
  state_ = surroundingsOf(setup_, PrimitiveId{}, false, ray_, Normal3f(), camera, atCamera, context_).state;
  beta_ = light.emissionAt(ray_.o, ray_.time, state_, context_.counters) * static_cast<float>(1 / pdf);
  path_.light = {.index = choice.light, .medium = &light, .p = ray_.o, .d = -ray_.d};
  return !beta_.isBlack() && beta_.isFinite();
}

Contribution& SubpathTracer::foundHere() {
  if (found_->size() <= scatterings_) found_->resize(scatterings_ + 1);
  return (*found_)[scatterings_];
}

void SubpathTracer::trace() {
  path_.vertices.reserve(std::min(kMostReserved, static_cast<std::size_t>(setup_.maxDepth)));
  firstSize_ = largestChannel(beta_);
  while (goOn() == Event::Vertex) {
    const bool isLast = !looksBeyond_ && seesOnlyEmission();
    const PathVertex& vertex = path_.vertices.back();
    // The last scattering may have another vertex, where light comes out from below.
    if (isLast && !(found_ && vertex.isOnSurface() && vertex.hit.primitive->material->hasBssrdf())) return;
    if (!scatter() || isLast) return;
  }
}

/// Follows the ray through boundaries without material to the next vertex.
SubpathTracer::Event SubpathTracer::goOn() {
  if (seesOnlyEmission()) {
    if (!found_ || (!setup_.scene.hasVisibleEmitters() && !setup_.mediaEmit)) return Event::End;
  }
  depth_ = {};
  passedEmitters_.clear();
  const bool isFromCamera = found_ && path_.vertices.empty();
  MediaWalk walk(
      setup_.walkContext(context_), state_,
      isFromCamera ? LineWalk::fromCamera(setup_.scene, ray_) : LineWalk(setup_.scene, ray_, rayStart_),
      &from_);
  return follow(walk, startPlane_);
}

SubpathTracer::Event SubpathTracer::follow(MediaWalk& walk, BoundaryPlane start) {
  const std::uint32_t hider = path_.fromLight && path_.vertices.empty()
                                  ? setup_.scene.hiderOf(path_.light.index)
                                  : PrimitiveId::kNone;
  for (;;) {
    const SceneHit* const nearest = walk.ahead();
    if (seesOnlyEmission()) {
      const bool blocked = nearest && nearest->primitive->material && !nearest->isEmitter();
      if (blocked || (!nearest && setup_.scene.infiniteLights().empty())) {
        if (setup_.mediaEmit) collectMediumEmission(walk.stretch());
        return Event::End;
      }
    }
    if (!state_.isVacuum()) {
      Event event = Event::End;
      if (!passMedium(walk.stretch(), nearest, start, event)) return event;
    }
    const std::optional<SceneHit> hit = walk.next();
    if (!hit) {
      if (found_) collectBackground();
      return Event::End;
    }
    if (hider != PrimitiveId::kNone && hit->isHider(hider)) return Event::End;
    const bool scatters = hit->primitive->material != nullptr;
    if (!scatters && !hit->isEmitter() && !setup_.media) {
      walk.cross(*hit);
      continue;
    }
    const SurfaceInteraction si = setup_.scene.surface(*hit, ray_);
    if (found_ && hit->isEmitter()) collectHit(*hit, si);
    if (scatters) {
      if (seesOnlyEmission()) return Event::End;
      if (path_.fromLight && setup_.hasStrands && isStrand(*hit->primitive)) return Event::End;
      addSurfaceVertex(walk, *hit, si);
      return Event::Vertex;
    }
    if (setup_.media) {
      start = planeAt(*hit, si, Vec3d(ray_.o) + walk.tEnd() * Vec3d(ray_.d), ray_.d, ray_.time);
    }
    walk.cross(*hit, si);
  }
}

/// The media between two surfaces, `hit` the one at the end. True: the path passes.
bool SubpathTracer::passMedium(const MediaStretch& stretch, const SceneHit* hit, const BoundaryPlane& start,
                               Event& event) {
  if (found_ && setup_.mediaEmit) collectMediumEmission(stretch);
  if (seesOnlyEmission()) {
    beta_ *= stretch.transmittance(context_.stream(), context_.counters);
    depth_ += stretch.control().depth;
    return !beta_.isBlack();
  }
  const MediumFlight flight = stretch.sampleFreeFlight(beta_, context_.stream(), context_.counters);
  beta_ *= flight.weight;
  if (beta_.isBlack()) return false;
  if (!flight.collided) {
    depth_ += stretch.control().depth;
    return true;
  }
  addMediumVertex(stretch, flight, hit, start);
  if (isFinite(path_.vertices.back().p)) {
    event = Event::Vertex;
  } else {
    path_.vertices.pop_back();  // beyond what coordinates can tell: nothing is out there
  }
  return false;
}

void SubpathTracer::addMediumVertex(const MediaStretch& stretch, const MediumFlight& flight,
                                    const SceneHit* hit, const BoundaryPlane& start) {
  const FlightControl control = stretch.upTo(flight.t).control();
  depth_ += control.depth;
  PathVertex vertex;
  vertex.at = scatterPointOn(setup_.scene, ray_, flight.t, stretch.tMax(), hit, start, context_.counters);
  vertex.p = vertex.at.p;
  vertex.phase = flight.phase;
  vertex.wo = -ray_.d;
  const float mean = control.rate.average();
  if (mean > 0) vertex.rate = control.rate / mean;
  addVertex(std::move(vertex));
}

void SubpathTracer::addSurfaceVertex(MediaWalk& walk, const SceneHit& hit, const SurfaceInteraction& si) {
  PathVertex vertex;
  vertex.hit = hit;
  vertex.si = si;
  if (setup_.media && setup_.scene.hasMediumBoundaries()) vertex.coincident = walk.coincidentWith(hit, si);
  vertex.bsdf = hit.primitive->material->bsdf(
      vertex.si, found_ ? TransportMode::Radiance : TransportMode::Importance, /*mergeSpecular=*/true);
  if (hit.primitive->material->hasBssrdf()) vertex.bsdf.separateSubsurface();
  vertex.p = si.p;
  vertex.wo = si.wo;
  addVertex(std::move(vertex));
}

void SubpathTracer::addVertex(PathVertex vertex) {
  vertex.beta = beta_;
  vertex.state = state_;
  vertex.depth = depth_;
  if (!path_.vertices.empty()) {
    vertex.pdf = StrategyWeights::arrival(pdfDirection_, path_.vertices.back().p, vertex, depth_);
  } else if (found_) {
    // Where light subpaths do not find the camera, all strategies share this factor.
    vertex.pdf =
        path_.firstOthers > 0 ? StrategyWeights::arrival(pdfCamera_, ray_.o, ray_.d, vertex, depth_) : 1;
  } else {
    LightPoint& light = path_.light;
    if (light.medium) light.directionDensity = light.medium->directionPdf(vertex.p, light.d, ray_.time);
    light.emitted = setup_.weights.emitted(light, vertex.p, ray_.time);
    vertex.pdf = setup_.weights.departure(light, vertex, depth_, ray_.time);
    path_.firstOthers = squaredRatio(setup_.weights.looked(light, vertex.p), light.emitted);
  }
  if (found_ && setup_.hasStrands && vertex.isOnSurface() && isStrand(*vertex.hit.primitive)) {
    vertex.pdf = double{kInfinity};
  }
  vertex.number = scatterings_++;
  path_.vertices.push_back(std::move(vertex));
}

/// Chooses the way from the last vertex; false: the subpath ends there.
bool SubpathTracer::scatter() {
  PathVertex& vertex = path_.vertices.back();
  samples_.startVertex(static_cast<int>(vertex.number));
  return vertex.isOnSurface() ? scatterOnSurface(vertex) : scatterInMedium(vertex);
}

bool SubpathTracer::scatterOnSurface(PathVertex& vertex) {
  ++context_.counters.surfaceScatterings;
  const SurfaceInteraction& si = vertex.si;
  const BsdfSample sample = vertex.bsdf.sample(si.wo, samples_.get2D());
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  beta_ *= sample.f * (absDot(sample.wi, vertex.bsdf.shadingNormal()) / sample.pdf);
  if (beta_.isBlack()) return false;
  return any(sample.flags & BsdfFlags::Subsurface) ? scatterBelowSurface() : leaveSurface(vertex, sample);
}

/// From where the path went below a surface to where it comes out again, as `volpath` does it. Light subpaths
/// end: the camera's find what comes out.
bool SubpathTracer::scatterBelowSurface() {
  if (path_.fromLight) return false;
  const PathVertex& entry = path_.vertices.back();
  const Material& material = *entry.hit.primitive->material;
  const std::optional<Bssrdf> bssrdf = material.bssrdf(entry.si);
  if (!bssrdf) return false;
  const float uWay = samples_.get1D();
  const std::optional<SubsurfaceEmergence> out = sampleEmergence(
      setup_.scene, *bssrdf, entry.si, ray_.time, material, uWay, samples_.get2D(), context_.counters.rays);
  if (!out) return false;
  beta_ *= out->weight;
  if (beta_.isBlack()) return false;
  if (setup_.media && setup_.scene.hasMediumBoundaries()) {
    passMediaBelow(setup_.walkContext(context_), state_, {entry.hit, entry.si, entry.coincident}, *out,
                   ray_.time);
  }
  PathVertex exit;
  exit.number = entry.number;
  exit.hit = out->hit;
  exit.si = out->si;
  exit.si.wo = Vector3f(exit.si.shading.n);
  exit.bsdf = Bsdf(exit.si, TransportMode::Radiance);
  exit.bsdf.add(Lobe(Rgb(1), RareLobe(SubsurfaceExit(bssrdf->eta(), /*isRadiance=*/true))));
  exit.p = exit.si.p;
  exit.wo = exit.si.wo;
  exit.beta = beta_;
  exit.state = state_;
  exit.pdf = double{kInfinity};
  path_.vertices.push_back(std::move(exit));
  PathVertex& vertex = path_.vertices.back();
  const BsdfSample sample = vertex.bsdf.sample(vertex.wo, samples_.get2D());
  if (!(sample.pdf > 0) || sample.f.isBlack()) return false;
  beta_ *= sample.f * (absDot(sample.wi, vertex.bsdf.shadingNormal()) / sample.pdf);
  return leaveSurface(vertex, sample);
}

bool SubpathTracer::leaveSurface(PathVertex& vertex, const BsdfSample& sample) {
  const SurfaceInteraction& si = vertex.si;
  vertex.isSpecular = any(sample.flags & BsdfFlags::Specular);
  pdfDirection_ = vertex.isSpecular ? 1 : double{sample.pdf};
  setup_.weights.scattersOn(path_, vertex.isSpecular ? specularPdfBack(vertex.bsdf, si, sample.wi)
                                                     : double{vertex.bsdf.pdf(sample.wi, si.wo)});
  if (setup_.media) {
    setup_.media->leaveSurface(state_, vertex.hit, si, vertex.coincident, sample.wi, context_.counters,
                               context_.mismatches);
  }
  startPlane_ = {};
  if (!state_.isVacuum()) startPlane_ = planeAt(vertex.hit, si, Vec3d(si.p), sample.wi, ray_.time);
  rayStart_ = vertex.coincident.startingWith(vertex.hit.hit.id);
  from_ = {};
  ray_.o = si.p;
  ray_.d = sample.wi;
  ray_.tMax = kInfinity;
  return playRoulette();
}

bool SubpathTracer::scatterInMedium(PathVertex& vertex) {
  ++context_.counters.mediumScatterings;
  if (inPlace_.isStuck(ray_.o, vertex.at)) {
    ++context_.counters.stuckPaths;
    return false;
  }
  const PhaseFunction::Sample sample = vertex.phase->sample(vertex.wo, samples_.get2D());
  if (!(sample.value > 0)) return false;
  pdfDirection_ = double{sample.value};
  setup_.weights.scattersOn(path_, double{vertex.phase->evaluate(sample.wi, vertex.wo)});
  startPlane_ = vertex.at.near;
  rayStart_ = {};
  from_ = vertex.at;
  ray_.o = vertex.p;
  ray_.d = sample.wi;
  ray_.tMax = kInfinity;
  return playRoulette();
}

bool SubpathTracer::playRoulette() {
  const float survival = largestChannel(beta_) / (kRouletteWeight * firstSize_);
  if (!(survival < 1)) return true;
  if (context_.rng.uniform() >= survival) return false;
  beta_ /= survival;
  return true;
}

/// What the media emit between two surfaces. Other strategies find what is where their light samples look.
void SubpathTracer::collectMediumEmission(const MediaStretch& stretch) {
  for (std::size_t i = 0; i < state_.activeCount(); ++i) {
    const PlacedMedium m = state_.active(i);
    if (!m.medium->isEmissive()) continue;
    const EmissionSamples found = stretch.sampleEmission(i, context_.stream(), context_.counters);
    if (found.count == 0) continue;
    const auto number = path_.vertices.empty() ? std::nullopt : setup_.scene.lightOf(m);
    const MediumLight* const light = number ? setup_.scene.mediumLight(*number) : nullptr;
    const auto span = light ? light->span(ray_.o, ray_.d, ray_.time) : std::nullopt;
    LightPoint point;
    if (span) {
      point = {.index = *number,
               .medium = light,
               .d = ray_.d,
               .directionDensity = light->directionPdf(ray_.o, ray_.d, ray_.time)};
    }
    for (const EmissionSamples::Sample& e : found) {
      double weight = 1;
      if (span && e.t >= span->tMin && e.t <= span->tMax) {
        point.p = Point3f(Vec3d(ray_.o) + e.t * Vec3d(ray_.d));
        weight = weightOf(point, depth_ + stretch.upTo(e.t).control().depth);
      }
      foundHere().add(beta_ * e.radiance, weight);
    }
  }
}

/// An emitter without material illuminates by its side that is met first. Directly seen are all.
void SubpathTracer::collectHit(const SceneHit& hit, const SurfaceInteraction& si) {
  bool isHidden = false;
  if (hit.light != SceneHit::kNoLight && !hit.primitive->material) {
    isHidden = std::ranges::find(passedEmitters_, hit.hit.id.geometry) != passedEmitters_.end();
    if (!isHidden) passedEmitters_.push_back(hit.hit.id.geometry);
  }
  const Rgb emitted = hit.areaLight().emitted(si.n, si.wo);
  if (emitted.isBlack()) return;
  double weight = 1;
  if (isHidden || hit.light == SceneHit::kNoLight) {
    weight = isDirect() ? 1 : 0;
  } else if (!path_.vertices.empty()) {
    weight = weightOf({.index = hit.light,
                       .light = setup_.scene.lights()[hit.light],
                       .p = si.p,
                       .n = si.n,
                       .d = ray_.d,
                       .isArea = true},
                      depth_);
  }
  foundHere().add(beta_ * emitted, weight);
}

void SubpathTracer::collectBackground() {
  for (const std::uint32_t index : setup_.scene.infiniteLights()) {
    const Light* const light = setup_.scene.lights()[index];
    const Rgb background = light->background(ray_.d);
    if (background.isBlack()) continue;
    const double weight =
        path_.vertices.empty() ? 1 : weightOf({.index = index, .light = light, .d = ray_.d}, depth_);
    foundHere().add(beta_ * background, weight);
  }
}

/// Of the light that the way at hand has found, behind that depth of it.
double SubpathTracer::weightOf(const LightPoint& light, Rgb depth) const {
  const StrategyWeights& weights = setup_.weights;
  const PathVertex& last = path_.vertices.back();
  if (light.isSplit()) {
    if (last.isSpecular) return 1;
    const float pdf = weights.lookedDirection(light, last.p);
    return double{powerHeuristic(static_cast<float>(pdfDirection_), pdf)};
  }
  const double found = StrategyWeights::arrival(pdfDirection_, last.p, light, depth);
  double others = last.isSpecular ? 0 : squaredRatio(weights.looked(light, last.p), found);
  const std::size_t count = path_.vertices.size();
  const double taken = squaredRatio(weights.emitted(light, last.p, ray_.time), found) *
                       squaredRatio(weights.departure(light, last, depth, ray_.time), last.pdf);
  if (taken > 0) {
    if (count == 1) {
      others += taken * (last.isSpecular ? 0 : path_.firstOthers);
    } else {
      const PathVertex& before = path_.vertices[count - 2];
      others += taken * ((last.isSpecular || before.isSpecular ? 0 : 1) + before.others);
    }
  }
  return 1 / (1 + others);
}

}  // namespace pbrtmedia
