// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/transform.h"
#include "scene/entity.h"
#include "scene/name_scope.h"
#include "scene/variables.h"

namespace pbrtmedia {

/// The current transformation at the two ends of TransformTimes; shared by all that stand under it.
struct TransformPair {
  Transform start, end;
  bool isAnimated() const { return !(start == end); }
};
using SharedTransform = std::shared_ptr<const TransformPair>;  ///< never null in a description

inline constexpr std::int32_t kNone = -1;  ///< index of what is not there

/// A medium named by MediumInterface, looked up where it is used.
struct MediumUse {
  std::string name;            ///< "" is vacuum
  SourceLocation location;     ///< the quoted name; no file: no MediumInterface was given
  std::int32_t index = kNone;  ///< into media; kNone: vacuum (an undefined name was reported)
};
struct MediumPair {
  MediumUse inside, outside;
};
using SharedMedia = std::shared_ptr<const MediumPair>;  ///< never null in a description

struct CameraDescription : Entity {
  SharedTransform worldFromCamera;  ///< inverse of the CTM at Camera; identity when not given
};

struct MediumDescription : Entity {
  std::string name;
  SharedTransform ctm;          ///< medium to world; only `start` counts
  NameScope::Ptr scope;         ///< for the textures it refers to
  std::int32_t object = kNone;  ///< into objects: defined in it, and moves with it; kNone: in none
};

enum class TextureFlavour : std::uint8_t { Float, Spectrum };

struct TextureDescription : Entity {
  std::string name;
  TextureFlavour flavour = TextureFlavour::Float;
  SharedTransform ctm;   ///< only `start` counts
  NameScope::Ptr scope;  ///< for the textures it refers to
};

struct MaterialDescription : Entity {
  std::string name;      ///< "" for a Material directive
  NameScope::Ptr scope;  ///< for its textures and (mix) materials; a Shape that overrides uses its own scope
  bool isNone() const { return given && (type.empty() || type == "none"); }
};

struct LightDescription : Entity {
  SharedTransform ctm;  ///< only `start` counts
  SharedMedia media;    ///< `outside` is the light's medium
};

struct ShapeDescription : Entity {
  SharedTransform ctm;
  SharedMedia media;
  NameScope::Ptr scope;            ///< for textures (alpha, overrides of the material)
  std::int32_t material = kNone;   ///< into materials; kNone: the default matte
  std::int32_t areaLight = kNone;  ///< into areaLights; kNone: no emission
  std::int32_t object = kNone;     ///< into objects; kNone: stands in the world itself
  bool reverseOrientation = false;
};

/// world = (CTM of the instance) · (CTM of the shape), also for an instance inside another object.
struct InstanceDescription {
  std::uint32_t object = 0;     ///< the object placed
  std::int32_t parent = kNone;  ///< the object definition it stands in; kNone: the world itself
  SharedTransform ctm;
  SourceLocation location;
};

struct ObjectDescription {
  std::string name;
  SourceLocation location;
  std::vector<std::uint32_t> shapes;     ///< into SceneDescription::shapes
  std::vector<std::uint32_t> instances;  ///< into SceneDescription::instances; nested, never circular
  std::uint32_t depth = 1;               ///< 1: shapes only; 1 + that of the deepest nested object
  std::uint64_t placedShapes = 0;        ///< shapes of one placement with all nesting; saturates
};

/// Everything between two WorldEnd directives: plain values with their places in the text, in file order.
/// A name that is used but not defined has been reported; plugin names, parameters and textures have not
/// been looked at.
struct SceneDescription {
  Entity film, filter, sampler, accelerator, integrator;
  CameraDescription camera;
  MediumUse cameraMedium;  ///< the outside medium in force at WorldEnd (reference 17.5)
  double transformStartTime = 0, transformEndTime = 1;

  std::vector<MediumDescription> media;
  std::vector<TextureDescription> textures;
  std::vector<MaterialDescription> materials;
  std::vector<LightDescription> lights;
  std::vector<Entity> areaLights;
  std::vector<ShapeDescription> shapes;  ///< those of the world and of the objects
  std::vector<ObjectDescription> objects;
  std::vector<InstanceDescription> instances;  ///< those of the world and of the objects

  SourceLocation worldBegin, worldEnd;
  /// Identity of the scene: of all text read for it (files and their includes, not the values of variables)
  /// and of its place among the worlds.
  std::uint64_t textHash = 0;
  std::vector<Variables::Used> variables;  ///< that the text asks for
  /// Files of that text and of spectra, without links on their way. Null: nothing is known of them.
  std::shared_ptr<const std::set<std::filesystem::path>> files;
};

}  // namespace pbrtmedia
