// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "lights/light.h"
#include "media/emission/emission_volume.h"
#include "media/medium.h"
#include "world/medium_state.h"
#include "world/primitive.h"

namespace pbrtmedia {

/// An emissive medium where it is placed, as a source of light: directions toward points inside it, chosen
/// where it emits. What arrives from a direction is for the caller to find out (shadowEmission), by distance
/// along it, as it does for scattered rays: light then comes from where the medium lets it out, however dense
/// it is, and light samples and hits of scattered rays differ in nothing but the density of their directions.
/// References and directions are in the world, at a time of the scene where the placement moves.
class MediumLight final : public Illuminant {
 public:
  /// `volume` is that of `medium.medium`, in the space of its definition; borrowed.
  MediumLight(const PlacedMedium& medium, const EmissionVolume& volume);

  Rgb power() const override;
  std::optional<LightExtent> extent() const override;
  /// Of a light at one of its points that has the power of all, at the time at which movements start.
  double arrivingLuminance(Point3f reference, Point2f u) const override;

  /// A direction, its density per solid angle and the distance behind which nothing emits; no radiance.
  /// `u` gives two of the three coordinates of a point and chooses the cell; the rest is hashed from it.
  LightSample sampleDirection(Point3f reference, Point2f u, float time) const;
  /// Its density for unit `wi`.
  double directionPdf(Point3f reference, Vector3f wi, float time) const;
  /// Where light samples look for emission along unit `wi`.
  std::optional<Span<double>> span(Point3f reference, Vector3f wi, float time) const;
  /// A point where paths may start, in the world: chosen where directions are looked along for.
  Point3f samplePoint(Point2f u, float time) const { return Point3f(pointAt(u, time)); }
  /// Its density per volume of the world.
  double pointPdf(Point3f p, float time) const;
  /// sigma_a Le there, per length of the world: where `state` is in force the medium may be absent, or hidden
  /// by another, and is black.
  Rgb emissionAt(Point3f p, float time, const MediumState& state, RenderCounters& counters) const;
  const PlacedMedium& medium() const { return medium_; }

 private:
  /// A point of the volume in the world.
  Vec3d pointAt(Point2f u, float time) const;
  /// A line from `reference` in the space of the medium's definition.
  Segment lineOf(Point3f reference, Vector3f wi, float time) const;

  PlacedMedium medium_;
  const EmissionVolume& volume_;
};

/// An emissive medium that primitives name, and the box around those that have it inside: in their space,
/// empty if there are none.
struct MediumEmitter {
  const Medium* medium;
  Bounds3f boundary;
  bool moves = true;  ///< with the placements of the primitives
};
/// The emissive media of primitives that are placed together. Of those that move with an object only the ones
/// that it has inside somewhere: others are around it.
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
