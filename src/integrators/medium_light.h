// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "integrators/medium_state.h"
#include "integrators/primitive.h"
#include "lights/light.h"
#include "media/medium.h"

namespace pbrtmedia {

/// An emissive medium where it is placed, as a source of light: points inside it, chosen where it emits. Its
/// densities are per solid angle and length, as what a direction meets is a stretch and no point, and the
/// radiance of a sample is what the medium emits per length there. Whether the medium is present at the point
/// at all is for the caller to see: boundaries say so. References and directions are in the world, at a time
/// of the scene where the placement moves.
class MediumLight final : public Light {
 public:
  /// `volume` is that of `medium.medium`, in the space of its definition; borrowed.
  MediumLight(const PlacedMedium& medium, const EmissionVolume& volume);

  std::string_view typeName() const override { return "medium"; }
  bool isDelta() const override { return false; }
  /// At the time at which movements start: for the selection of lights.
  LightSample sample(Point3f reference, Point2f u) const override;
  /// `u` gives two of the three coordinates and chooses the cell; the rest is hashed from it.
  LightSample sample(Point3f reference, Point2f u, float time) const;
  /// A direction alone has no density here: see the two below.
  float pdf(Point3f, Vector3f, const SurfaceInteraction*) const override { return 0; }
  Rgb power() const override;

  /// Density of `sample(reference, .)` for the point `t` along unit `wi`, per solid angle and length.
  double pdfAt(Point3f reference, Vector3f wi, double t, float time) const;
  /// Density per length that a ray from `reference` along `wi` is taken to have for finding emission at `t`,
  /// for weights: of Medium::sampleEmission if nothing but the medium's own bounds cut the ray.
  double distancePdf(Point3f reference, Vector3f wi, double t, float time) const;
  const PlacedMedium& medium() const { return medium_; }

 private:
  PlacedMedium medium_;
  const EmissionVolume& volume_;
};

/// An emissive medium that primitives name, and the box around those that have it inside: in their space,
/// empty if there are none.
struct MediumEmitter {
  const Medium* medium;
  Bounds3f boundary;
};
/// The emissive media of primitives that are placed together. Of an object only those that it has inside
/// somewhere: others are around it.
std::vector<MediumEmitter> mediumEmittersOf(std::span<const Primitive* const> primitives, bool inObject);

/// The lights that the media of a scene are: one for each emissive medium and placement, if its extent is
/// known, by its own bounds or by its boundary.
class MediumLights {
 public:
  /// `placement`: of the object that the emitters are of; null: they are placed directly.
  void add(std::span<const MediumEmitter> emitters, const Placement* placement);
  std::size_t size() const { return lights_.size(); }
  const MediumLight& operator[](std::size_t i) const { return lights_[i]; }
  /// Nothing when the medium is no light there.
  std::optional<std::size_t> find(const PlacedMedium& medium) const;

 private:
  /// All placements of a medium share one.
  struct Volume {
    MediumEmitter emitter;  ///< in the space of the medium's definition
    std::unique_ptr<const EmissionVolume> volume;
  };
  struct Hash {
    std::size_t operator()(const PlacedMedium& m) const;
  };
  const EmissionVolume* volumeOf(const MediumEmitter& emitter);

  std::vector<Volume> volumes_;
  std::deque<MediumLight> lights_;
  std::unordered_map<PlacedMedium, std::size_t, Hash> numbers_;
};

}  // namespace pbrtmedia
