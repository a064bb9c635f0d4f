// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "construct/lights.h"
#include "construct/materials.h"
#include "construct/media.h"
#include "construct/shapes.h"
#include "construct/textures.h"
#include "scene/description.h"
#include "world/camera_medium.h"
#include "world/scene_builder.h"

namespace pbrtmedia {

/// The world block: shapes, media, lights, objects and instances. `read` checks everything and builds nothing
/// heavy; `build` makes what is referred to. The references must outlive it.
class WorldBuilder {
 public:
  WorldBuilder(SceneDescription& scene, Textures& textures, Materials& materials, Diagnostics& diagnostics);

  /// Problems go to the diagnostics.
  void read(bool quick);
  /// After `read` without errors. `withMedia`: false leaves media out (the integrator cannot see them).
  /// Throws SceneError for files that turn out to be broken.
  std::unique_ptr<Scene> build(bool withMedia);

  /// The built medium of that number; null for vacuum or one that nothing uses.
  const Medium* medium(std::int32_t index) const {
    return index == kNone ? nullptr : media_[static_cast<std::size_t>(index)];
  }
  bool usesMedia() const { return usesMedia_; }
  /// Warns of media that no camera ray gets to see. After `build` with media. `unreached`: whose densities
  /// lie outside of all their boundaries.
  void warnOfUnseenMedia(const CameraMedium& camera, const std::vector<const Medium*>& unreached,
                         Diagnostics& diagnostics) const;
  /// Warns at `at` of curves, where light paths of the integrator of `context` scatter at them.
  void warnOfCurves(const SourceLocation& at, const std::string& context) const;
  std::vector<std::string> report() const { return report_; }

 private:
  struct ShapeRead {
    std::optional<ShapePlan> plan;
    Materials::Use material;
  };
  /// A shape with an animated CTM: an object of its own, placed by that.
  struct MovingShape {
    std::uint32_t object;
    TransformPair ctm;
  };
  void handOver(const Diagnostics& messages, bool isUsed, std::string_view what);
  void readShapes();
  /// Gives the strands of a curve to an earlier one that stands alike, so that a file may have a directive
  /// for each of a million hairs.
  void joinStrands(std::size_t shape);
  ShapeRead readShape(ShapeDescription& shape, Diagnostics& diagnostics);
  void markUsedObjects();
  void markUsedMedia();
  bool isUsed(const ShapeDescription& shape) const {
    return shape.object == kNone || objectUsed_[static_cast<std::size_t>(shape.object)];
  }
  void warnOfMediaThatStay();
  /// Curves have no inside.
  void dropMediaOfCurves();
  bool isOpaque(const ShapeDescription& shape) const;
  bool movesWith(const ShapeDescription& shape, const MediumUse& use) const;
  void limitPlacements();
  void buildMedia(SceneBuilder& builder);
  /// Nothing for a shape whose file turns out to be broken.
  std::optional<Primitive> buildPrimitive(std::size_t shape, SceneBuilder& builder);
  void addAreaLights(const ShapeDescription& shape, Primitive& primitive, SceneBuilder& builder);
  void placeShapes(SceneBuilder& builder);
  void placeObjects(SceneBuilder& builder);
  static MovingShape addMoving(SceneBuilder& builder, const TransformPair& ctm, Primitive primitive);
  void place(SceneBuilder& builder, const MovingShape& shape, const TransformPair& outer);
  void placeInstance(SceneBuilder& builder, const InstanceDescription& instance, const TransformPair& outer);
  void describe(const Textures& textures);
  const Medium* mediumOf(const MediumUse& use) const { return withMedia_ ? medium(use.index) : nullptr; }

  SceneDescription& scene_;
  Textures& textures_;
  Materials& materials_;
  Diagnostics& diagnostics_;
  std::vector<ShapeRead> shapes_;
  /// CTM, media, material and whether there is one, object, orientation; type and depth of the curve.
  using StrandKey = std::tuple<const TransformPair*, const MediumPair*, std::int32_t, bool, std::int32_t,
                               bool, CurveType, int>;
  std::map<StrandKey, std::size_t> firstStrands_;
  std::size_t joinedStrands_ = 0;
  std::vector<std::optional<LightPlan>> lights_;
  std::vector<std::optional<DiffuseAreaLight::Params>> areaLights_;
  std::vector<std::optional<MediumPlan>> mediumPlans_;
  std::vector<const Medium*> media_;
  std::vector<bool> objectUsed_, mediumUsed_;
  std::vector<std::uint32_t> objectNumber_;
  std::vector<std::vector<MovingShape>> movingShapes_;  ///< of each object
  bool usesMedia_ = false, withMedia_ = true;
  std::vector<std::string> report_;
};

}  // namespace pbrtmedia
