// SPDX-License-Identifier: BSD-2-Clause
#include "materials/disney.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "materials/bssrdf.h"
#include "materials/bump_map.h"
#include "materials/material_parts.h"

namespace pbrtmedia {
namespace {

/// The distance of PBRT-v3's profile in units of "scatterdistance", chosen to look like other renderers.
constexpr float kDistanceScale = 0.2f;

void addUnlessBlack(Bsdf& bsdf, Rgb weight, const RareLobe::Model& model) {
  if (!weight.isBlack()) bsdf.add(Lobe(weight, RareLobe(model)));
}

TrowbridgeReitz distributionOf(float roughness, float anisotropic) {
  const float aspect = std::sqrt(std::max(0.0f, 1 - 0.9f * anisotropic));
  return {sqr(roughness) / aspect, sqr(roughness) * aspect};
}

/// Reflectance straight on of a dielectric.
float reflectanceOf(float eta) { return sqr((eta - 1) / (eta + 1)); }

Rgb mixed(float t, Rgb a, Rgb b) { return (1 - t) * a + t * b; }

}  // namespace

/// What several lobes need of the textures.
struct DisneyMaterial::Point {
  Rgb color, tint;
  float metallic, eta, roughness, specTrans;
  float diffuse;  ///< share of what is neither metal nor glass

  Rgb base() const { return diffuse * color; }
};

DisneyMaterial::DisneyMaterial(const DisneyParams& params) : params_(params) {
  const auto require = [](const void* texture, std::string_view name) {
    requireTexture(texture, "disney", name);
  };
  require(params.color, "color");
  require(params.metallic, "metallic");
  require(params.eta, "eta");
  require(params.roughness, "roughness");
  require(params.specularTint, "speculartint");
  require(params.anisotropic, "anisotropic");
  require(params.sheen, "sheen");
  require(params.sheenTint, "sheentint");
  require(params.clearcoat, "clearcoat");
  require(params.clearcoatGloss, "clearcoatgloss");
  require(params.specTrans, "spectrans");
  require(params.scatterDistance, "scatterdistance");
  require(params.flatness, "flatness");
  require(params.diffTrans, "difftrans");
}

DisneyMaterial::Point DisneyMaterial::pointAt(const SurfaceInteraction& si) const {
  Point at;
  at.color = reflectanceAt(*params_.color, si);
  const float luminance = at.color.luminance();
  at.tint = luminance > 0 ? at.color / luminance : Rgb(1);
  at.metallic = params_.metallic->evaluate(si);
  at.eta = params_.eta->evaluate(si);
  at.roughness = params_.roughness->evaluate(si);
  at.specTrans = params_.specTrans->evaluate(si);
  at.diffuse = (1 - at.metallic) * (1 - at.specTrans);
  return at;
}

std::size_t DisneyMaterial::maxLobes() const {
  const DisneyParams& p = params_;
  const bool isColoured = !isAlwaysBlack(*p.color), isThrough = !isAlways(*p.specTrans, 0);
  std::size_t count = 1;  // reflection
  if (!isAlways(*p.metallic, 1) && !isAlways(*p.specTrans, 1)) {
    if (hasBssrdf()) {
      ++count;
    } else if (isColoured) {
      count += p.isThin && !isAlways(*p.flatness, 0) && !isAlways(*p.flatness, 1) ? 2 : 1;
    }
    if (isColoured) ++count;  // retro-reflection
    if (!isAlways(*p.sheen, 0)) ++count;
  }
  if (!isAlways(*p.clearcoat, 0)) ++count;
  if (isColoured && isThrough) ++count;
  if (isColoured && p.isThin && !isAlways(*p.diffTrans, 0)) ++count;
  return count;
}

bool DisneyMaterial::hasBssrdf() const { return !params_.isThin && !isAlwaysBlack(*params_.scatterDistance); }

std::optional<Bssrdf> DisneyMaterial::bssrdf(const SurfaceInteraction& si) const {
  const Rgb distance = reflectanceAt(*params_.scatterDistance, si);
  if (params_.isThin || distance.isBlack()) return std::nullopt;
  const Point at = pointAt(si);
  if (!(at.diffuse > 0)) return std::nullopt;
  return Bssrdf(DisneyProfile{at.base(), kDistanceScale * distance}, at.eta);
}

Bsdf DisneyMaterial::bsdf(SurfaceInteraction& si, TransportMode mode, bool) const {
  applyBumpMap(params_.bumpMap, si);
  const Point at = pointAt(si);
  Bsdf bsdf(si, mode, params_.isThin ? 1 : at.eta);
  if (at.diffuse > 0) addDiffuse(at, si, mode, bsdf);
  addGlossy(at, si, mode, bsdf);
  return bsdf;
}

void DisneyMaterial::addDiffuse(const Point& at, const SurfaceInteraction& si, TransportMode mode,
                                Bsdf& bsdf) const {
  if (params_.isThin) {
    const float flat = params_.flatness->evaluate(si), reflected = 1 - 0.5f * params_.diffTrans->evaluate(si);
    addUnlessBlack(bsdf, (1 - flat) * reflected * at.base(), DisneyDiffuse{});
    addUnlessBlack(bsdf, flat * reflected * at.base(), DisneyFlatDiffuse{at.roughness});
  } else if (reflectanceAt(*params_.scatterDistance, si).isBlack()) {
    addUnlessBlack(bsdf, at.base(), DisneyDiffuse{});
  } else {
    Lobe entrance(Rgb(1), SpecularTransmission{1, at.eta, mode});
    entrance.setFlag(BsdfFlags::Subsurface);
    bsdf.add(entrance);
  }
  addUnlessBlack(bsdf, at.base(), DisneyRetro{at.roughness});
  const float sheen = params_.sheen->evaluate(si);
  if (sheen > 0) {
    addUnlessBlack(bsdf, at.diffuse * sheen * mixed(params_.sheenTint->evaluate(si), Rgb(1), at.tint),
                   DisneySheen{});
  }
}

void DisneyMaterial::addGlossy(const Point& at, const SurfaceInteraction& si, TransportMode mode,
                               Bsdf& bsdf) const {
  const float anisotropic = params_.anisotropic->evaluate(si);
  const TrowbridgeReitz distribution = distributionOf(at.roughness, anisotropic);
  const Rgb dielectric = reflectanceOf(at.eta) * mixed(params_.specularTint->evaluate(si), Rgb(1), at.tint);
  bsdf.add(Lobe(Rgb(1), RareLobe(DisneyReflection{distribution, mixed(at.metallic, dielectric, at.color),
                                                  at.metallic, at.eta})));
  const float coat = params_.clearcoat->evaluate(si);
  if (coat > 0) {
    const float gloss = params_.clearcoatGloss->evaluate(si);
    // The law has no limit in its form at 1, and below this no digits in single precision.
    constexpr float kLeastAlpha = 1e-3f, kMostAlpha = 0.999f;
    addUnlessBlack(bsdf, Rgb(coat),
                   DisneyClearcoat{std::clamp(lerp(gloss, 0.1f, 0.001f), kLeastAlpha, kMostAlpha)});
  }
  if (at.specTrans > 0) {
    const Rgb through = at.specTrans * sqrt(at.color);
    // A thin sheet blurs what is behind it by its index: Burley 2015, section 5.3.
    const bool thin = params_.isThin;
    const TrowbridgeReitz ofThrough =
        thin ? distributionOf((0.65f * at.eta - 0.35f) * at.roughness, anisotropic) : distribution;
    if (!through.isBlack()) {
      // Facets between equal indices bend nothing.
      if (at.eta == 1) {
        bsdf.add(Lobe(through, SpecularTransmission{1, 1, mode}));
      } else {
        bsdf.add(Lobe(through, MicrofacetTransmission{ofThrough, 1, at.eta, mode, !thin}));
      }
    }
  }
  if (params_.isThin) {
    const Rgb through = 0.5f * params_.diffTrans->evaluate(si) * at.color;
    if (!through.isBlack()) bsdf.add(Lobe(through, LambertTransmission{}));
  }
}

}  // namespace pbrtmedia
