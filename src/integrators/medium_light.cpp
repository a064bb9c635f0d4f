// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/medium_light.h"

#include <bit>
#include <cmath>

#include "base/hash.h"
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

}  // namespace

MediumLight::MediumLight(const Medium& medium, std::unique_ptr<const EmissionVolume> volume)
    : medium_(medium), volume_(std::move(volume)) {}

LightSample MediumLight::sample(Point3f reference, Point2f u) const {
  LightSample s;
  const EmissionVolume::Sample at = volume_->sample(refine(u));
  const Vec3d d = Vec3d(at.p) - Vec3d(reference);
  const double squared = lengthSquared(d);
  if (!(squared > 0)) return s;
  const double r = std::sqrt(squared);
  RenderCounters uncounted;  // this interface counts nothing
  s.wi = Vector3f(d / r);
  s.distance = static_cast<float>(r);
  s.pdf = static_cast<float>(at.pdf * squared);
  s.radiance = medium_.at(at.p, uncounted).emission;
  return s;
}

Rgb MediumLight::power() const { return volume_->total() * (4 * kPi); }

double MediumLight::pdfAt(Point3f reference, Vector3f wi, double t) const {
  return volume_->pdf(Segment{reference, wi, 0, t}.at(t)) * t * t;
}

double MediumLight::distancePdf(Point3f reference, Vector3f wi, double t) const {
  const auto span = clipToBox(Bounds3d{Vec3d(volume_->bounds().min), Vec3d(volume_->bounds().max)},
                              Vec3d(reference), Vec3d(wi), 0.0, static_cast<double>(kInfinity));
  if (!span) return 0;
  return medium_.emissionDistancePdf({reference, wi, span->tMin, span->tMax}, t);
}

std::vector<std::unique_ptr<MediumLight>> makeMediumLights(std::span<const Primitive* const> primitives) {
  std::vector<std::unique_ptr<MediumLight>> lights;
  std::vector<const Medium*> seen;
  for (const Primitive* p : primitives) {
    for (const Medium* medium : {p->media.inside, p->media.outside}) {
      if (!medium || !medium->isEmissive() || p->media.same()) continue;
      if (std::find(seen.begin(), seen.end(), medium) != seen.end()) continue;
      seen.push_back(medium);
      Bounds3f boundary;
      for (const Primitive* other : primitives) {
        if (other->media.inside == medium && !other->media.same()) boundary.expand(other->shape->bounds());
      }
      if (auto volume = medium->emissionVolume(boundary)) {
        lights.push_back(std::make_unique<MediumLight>(*medium, std::move(volume)));
      }
    }
  }
  return lights;
}

}  // namespace pbrtmedia
