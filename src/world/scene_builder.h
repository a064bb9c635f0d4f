// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "world/scene.h"

namespace pbrtmedia {

/// Collects what a scene consists of, then makes the scene.
///
///   SceneBuilder builder;
///   Material* red = builder.own(makeMatte(...));
///   builder.addPrimitive({.shape = builder.own(makeSphere(...)), .material = red});
///   builder.addLight(makePointLight(...));
///   std::unique_ptr<Scene> scene = builder.finish();
class SceneBuilder {
 public:
  SceneBuilder();
  ~SceneBuilder();

  /// Keeps `object` (shape, material, texture, medium, area light, or any buffer) alive as long as the scene.
  template <class T>
  T* own(std::unique_ptr<T> object) {
    T* const raw = object.get();
    keep(Owned(const_cast<void*>(static_cast<const void*>(object.release())),
               [](void* p) { delete static_cast<T*>(p); }));
    return raw;
  }

  /// Owns a medium that the scene tells of (Scene::media).
  Medium* addMedium(std::unique_ptr<Medium> medium);

  /// Places a shape directly. Its area lights illuminate and get consecutive numbers in Scene::lights().
  void addPrimitive(Primitive primitive);
  /// Records an object for instances; its area lights are visible but do not illuminate. May be empty.
  std::uint32_t addObject(std::vector<Primitive> primitives);
  /// Places an object. An empty one places nothing.
  /// `mediaFromObject`: the space in which its media were defined, as seen from the object's.
  void addInstance(std::uint32_t object, const AnimatedTransform& worldFromObject,
                   const Transform& mediaFromObject = Transform());
  /// Lights that are on no surface.
  void addLight(std::unique_ptr<Light> light);

  /// Builds the ray-tracing structures and prepares the lights with the scene's bounds. Once only.
  std::unique_ptr<Scene> finish();

 private:
  using Owned = std::unique_ptr<void, void (*)(void*)>;
  void keep(Owned object);
  std::unique_ptr<Scene::Parts> parts_;
};

}  // namespace pbrtmedia
