// SPDX-License-Identifier: BSD-2-Clause
#include "world/medium_light.h"

#include <bit>
#include <cmath>

#include "base/hash.h"
#include "media/emission/emission_volume.h"
#include "shapes/shape.h"

namespace pbrtmedia {
namespace {

/// Three numbers in [0, 1) with 48, 48 and 53 bits: cells are many, and single precision would miss some.
std::array<double, 3> refine(Point2f u) {
  const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
  const std::uint64_t hash = hashCombine(bits(u.x), bits(u.y));
  const auto finer = [](float x, std::uint64_t word) {
    return std::min(double{x} + static_cast<double>(word >> 40) * 0x1p-48, 1 - 0x1p-53);
  };
  return {finer(u.x, mix64(hash + 1)), finer(u.y, mix64(hash + 2)),
          static_cast<double>(mix64(hash + 3) >> 11) * 0x1p-53};
}

/// Volume in the medium's space of a unit of volume in the world.
double volumeScale(const Transform& mediaFromWorld) {
  return std::abs(mediaFromWorld.matrix().determinant3());
}

}  // namespace

MediumLight::MediumLight(const PlacedMedium& medium, const EmissionVolume& volume)
    : medium_(medium), volume_(volume) {}

Vec3d MediumLight::pointAt(Point2f u, float time) const {
  const Vec3d p(volume_.sample(refine(u)));
  return medium_.placement ? medium_.placement->mediaFromWorld(time).inverse().point(p) : p;
}

double MediumLight::arrivingLuminance(Point3f reference, Point2f u) const {
  const double squared = lengthSquared(pointAt(u, -kInfinity) - Vec3d(reference));
  if (!(squared > 0)) return 0;
  return double{(power() * static_cast<float>(1 / (4 * double{kPi} * squared))).luminance()};
}

LightSample MediumLight::sampleDirection(Point3f reference, Point2f u, float time) const {
  LightSample s;
  const Vec3d d = pointAt(u, time) - Vec3d(reference);
  const double squared = lengthSquared(d);
  if (!(squared > 0)) return s;
  s.wi = Vector3f(d / std::sqrt(squared));
  const auto where = span(reference, s.wi, time);
  if (!where) return s;  // it has only been grazed
  s.distance = std::nextafter(static_cast<float>(where->tMax), kInfinity);
  s.pdf = static_cast<float>(directionPdf(reference, s.wi, time));
  return s;
}

Rgb MediumLight::power() const {
  const Rgb total = volume_.total() * (4 * kPi);
  if (!medium_.placement) return total;
  return total / static_cast<float>(volumeScale(medium_.placement->mediaFromWorld(-kInfinity)));
}

std::optional<LightExtent> MediumLight::extent() const {
  if (medium_.placement) return std::nullopt;  // it may move
  const Bounds3f bounds = volume_.bounds();
  if (bounds.isEmpty()) return std::nullopt;
  return LightExtent{.bounds = bounds};
}

Segment MediumLight::lineOf(Point3f reference, Vector3f wi, float time) const {
  const Segment line{reference, wi, 0, static_cast<double>(kInfinity)};
  return medium_.placement ? medium_.placement->toObject(line, time) : line;
}

double MediumLight::directionPdf(Point3f reference, Vector3f wi, float time) const {
  const double density = volume_.directionDensity(lineOf(reference, wi, time));
  if (!medium_.placement) return density;
  return density * volumeScale(medium_.placement->mediaFromWorld(time));
}

double MediumLight::pointPdf(Point3f p, float time) const {
  if (!medium_.placement) return volume_.density(p);
  const Transform mediaFromWorld = medium_.placement->mediaFromWorld(time);
  return volume_.density(Point3f(mediaFromWorld.point(Vec3d(p)))) * volumeScale(mediaFromWorld);
}

Rgb MediumLight::emissionAt(Point3f p, float time, const MediumState& state, RenderCounters& counters) const {
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    if (!(state.active(i) == medium_)) continue;
    if (!medium_.placement) return medium_.medium->at(p, counters).emission;
    const Vec3d here = medium_.placement->mediaFromWorld(time).point(Vec3d(p));
    return medium_.medium->at(Point3f(here), counters).emission;
  }
  return {};
}

std::optional<Span<double>> MediumLight::span(Point3f reference, Vector3f wi, float time) const {
  const Segment line = lineOf(reference, wi, time);
  return clipToBox(Bounds3d{Vec3d(volume_.bounds().min), Vec3d(volume_.bounds().max)}, Vec3d(line.o),
                   Vec3d(line.d), line.tMin, line.tMax);
}

std::vector<MediumEmitter> mediumEmittersOf(std::span<const Primitive* const> primitives, bool inObject) {
  std::vector<MediumEmitter> emitters;
  const auto emitterOf = [&](const Medium* medium, bool moves) -> MediumEmitter* {
    if (!medium || !medium->isEmissive()) return nullptr;
    for (MediumEmitter& e : emitters) {
      if (e.medium == medium && e.moves == moves) return &e;
    }
    return &emitters.emplace_back(MediumEmitter{medium, {}, moves});
  };
  for (const Primitive* p : primitives) {
    const MediumInterface& media = p->media;
    if (media.same()) continue;
    if (MediumEmitter* const inside = emitterOf(media.inside, inObject && media.insideMoves)) {
      inside->boundary.expand(p->shape->bounds());
    }
    if (!inObject || !media.outsideMoves) emitterOf(media.outside, false);
  }
  return emitters;
}

std::size_t MediumLights::Hash::operator()(const PlacedMedium& m) const {
  return std::hash<const void*>()(m.medium) ^ (std::hash<const void*>()(m.placement) * 31);
}

const EmissionVolume* MediumLights::volumeOf(const MediumEmitter& emitter) {
  MediumEmitter key = emitter;
  const Bounds3f own = key.medium->bounds();
  if (own.isEmpty() || maxComponent(own.diagonal()) < kInfinity) key.boundary = {};  // it does not matter
  for (const Volume& v : volumes_) {
    if (v.emitter.medium == key.medium && v.emitter.boundary == key.boundary) return v.volume.get();
  }
  volumes_.push_back({key, key.medium->emissionVolume(key.boundary)});
  return volumes_.back().volume.get();
}

void MediumLights::add(std::span<const MediumEmitter> emitters, const Placement* placement) {
  for (MediumEmitter emitter : emitters) {
    if (placement && !emitter.boundary.isEmpty()) {
      emitter.boundary = placement->mediaFromObject().bounds(emitter.boundary);
    }
    const EmissionVolume* const volume = volumeOf(emitter);
    if (!volume) continue;
    const PlacedMedium placed{emitter.medium, placement};
    numbers_.emplace(placed, lights_.size());
    lights_.emplace_back(placed, *volume);
  }
}

std::optional<std::size_t> MediumLights::find(const PlacedMedium& medium) const {
  const auto found = numbers_.find(medium);
  if (found == numbers_.end()) return std::nullopt;
  return found->second;
}

}  // namespace pbrtmedia
