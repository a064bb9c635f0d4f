// SPDX-License-Identifier: BSD-2-Clause
#include "materials/bsdf.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "materials/shading_frame.h"

namespace pbrtmedia {

namespace {

constexpr BsdfFlags sideOf(bool isReflection) {
  return isReflection ? BsdfFlags::Reflection : BsdfFlags::Transmission;
}

}  // namespace

Bsdf::Bsdf(const SurfaceInteraction& si, TransportMode mode, float eta)
    : frame_(shadingFrame(si)), ng_(si.n), eta_(eta), mode_(mode) {}

void Bsdf::add(const Lobe& lobe) {
  CHECK_LT(count_, kMaxLobes) << "too many lobes at one surface point";
  lobes_[count_++] = lobe;
}

std::size_t Bsdf::count(BsdfFlags allowed) const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < count_; ++i) n += matches(lobes_[i].flags(), allowed) ? 1 : 0;
  return n;
}

float Bsdf::shadingCorrection(Vector3f wo, Vector3f wi) const {
  const float across = absDot(wo, ng_) * absDot(wi, frame_.n);
  return across > 0 ? absDot(wo, frame_.n) * absDot(wi, ng_) / across : 0;
}

Rgb Bsdf::f(Vector3f woWorld, Vector3f wiWorld, BsdfFlags allowed) const {
  const Vector3f wo = frame_.toLocal(woWorld), wi = frame_.toLocal(wiWorld);
  if (wo.z == 0) return {};
  const BsdfFlags side = sideOf(dot(wiWorld, ng_) * dot(woWorld, ng_) > 0);
  Rgb sum;
  for (std::size_t i = 0; i < count_; ++i) {
    const BsdfFlags flags = lobes_[i].flags();
    if (matches(flags, allowed) && any(flags & side) && !any(flags & BsdfFlags::Specular))
      sum += lobes_[i].f(wo, wi);
  }
  if (mode_ == TransportMode::Importance) sum *= shadingCorrection(woWorld, wiWorld);
  return sum;
}

float Bsdf::pdf(Vector3f woWorld, Vector3f wiWorld, BsdfFlags allowed) const {
  const Vector3f wo = frame_.toLocal(woWorld), wi = frame_.toLocal(wiWorld);
  if (wo.z == 0) return 0;
  float sum = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (!matches(lobes_[i].flags(), allowed)) continue;
    if (!any(lobes_[i].flags() & BsdfFlags::Specular)) sum += lobes_[i].pdf(wo, wi);
    ++n;
  }
  return n > 0 ? sum / static_cast<float>(n) : 0;
}

BsdfSample Bsdf::sample(Vector3f woWorld, Point2f u, BsdfFlags allowed) const {
  const std::size_t matching = count(allowed);
  const Vector3f wo = frame_.toLocal(woWorld);
  if (matching == 0 || wo.z == 0) return {};

  const float stretched = u.x * static_cast<float>(matching);
  const std::size_t choice = std::min(static_cast<std::size_t>(stretched), matching - 1);
  const Point2f reused{std::min(stretched - static_cast<float>(choice), kOneMinusEpsilon), u.y};
  std::size_t picked = 0;
  for (std::size_t skip = choice;; ++picked) {
    if (matches(lobes_[picked].flags(), allowed) && skip-- == 0) break;
  }

  const LobeSample s = lobes_[picked].sample(wo, reused);
  if (!(s.pdf > 0)) return {};
  BsdfSample result{s.f, frame_.toWorld(s.wi), s.pdf, s.flags};
  if (any(s.flags & BsdfFlags::Transmission)) {
    constexpr BsdfFlags kMarks = BsdfFlags::Subsurface | BsdfFlags::Specular;
    result.flags = result.flags | (lobes_[picked].flags() & kMarks);
  }
  if (!any(result.flags & BsdfFlags::Specular)) {
    const BsdfFlags side = sideOf(dot(result.wi, ng_) * dot(woWorld, ng_) > 0);
    result.f = {};
    for (std::size_t i = 0; i < count_; ++i) {
      const Lobe& lobe = lobes_[i];
      if (!matches(lobe.flags(), allowed) || any(lobe.flags() & BsdfFlags::Specular)) continue;
      if (i != picked) result.pdf += lobe.pdf(wo, s.wi);
      if (any(lobe.flags() & side)) result.f += i == picked ? s.f : lobe.f(wo, s.wi);
    }
  }
  result.pdf /= static_cast<float>(matching);
  if (mode_ == TransportMode::Importance) result.f *= shadingCorrection(woWorld, result.wi);
  return result;
}

void Bsdf::separateSubsurface() {
  for (std::size_t i = 0; i < count_; ++i) {
    if (any(lobes_[i].flags() & BsdfFlags::Subsurface)) lobes_[i].setFlag(BsdfFlags::Specular);
  }
}

void Bsdf::forgetSubsurface() {
  for (std::size_t i = 0; i < count_; ++i) lobes_[i].clearFlag(BsdfFlags::Subsurface);
}

void Bsdf::scale(Rgb weight) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    Lobe lobe = lobes_[i];
    lobe.scale(weight);
    if (!lobe.weight().isBlack()) lobes_[kept++] = lobe;
  }
  count_ = kept;
}

}  // namespace pbrtmedia
