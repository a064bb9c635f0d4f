// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "integrators/primitive.h"
#include "lights/light.h"
#include "media/medium.h"

namespace pbrtmedia {

/// An emissive medium as a source of light: points inside it, chosen where it emits. Its densities are per
/// solid angle and length, as what a direction meets is a stretch and no point, and the radiance of a sample
/// is what the medium emits per length there. Whether the medium is present at the point at all is for the
/// caller to see: boundaries say so.
class MediumLight final : public Light {
 public:
  MediumLight(const Medium& medium, std::unique_ptr<const EmissionVolume> volume);

  std::string_view typeName() const override { return "medium"; }
  bool isDelta() const override { return false; }
  /// `u` gives two of the three coordinates and chooses the cell; the rest is hashed from it.
  LightSample sample(Point3f reference, Point2f u) const override;
  /// A direction alone has no density here: see the two below.
  float pdf(Point3f, Vector3f, const SurfaceInteraction*) const override { return 0; }
  Rgb power() const override;

  /// Density of `sample(reference, .)` for the point `t` along unit `wi`, per solid angle and length.
  double pdfAt(Point3f reference, Vector3f wi, double t) const;
  /// Density per length that a ray from `reference` along `wi` is taken to have for finding emission at `t`,
  /// for weights: of Medium::sampleEmission if nothing but the medium's own bounds cut the ray.
  double distancePdf(Point3f reference, Vector3f wi, double t) const;
  const Medium& medium() const { return medium_; }

 private:
  const Medium& medium_;
  std::unique_ptr<const EmissionVolume> volume_;
};

/// One light for each emissive medium that these directly placed primitives name and whose extent is known:
/// by its own bounds, or by the box around the primitives that have it inside.
std::vector<std::unique_ptr<MediumLight>> makeMediumLights(std::span<const Primitive* const> primitives);

}  // namespace pbrtmedia
