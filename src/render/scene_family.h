// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>

namespace pbrtmedia {

class Camera;
class Film;
class Integrator;
class Sampler;

/// Scenes that differ by the value of one parameter, and are there only while they are needed.
class SceneFamily {
 public:
  /// A scene that is ready to be rendered.
  struct Member {
    const Camera& camera;
    const Sampler& sampler;
    const Integrator& integrator;
    Film& film;
  };
  virtual ~SceneFamily() = default;
  SceneFamily(const SceneFamily&) = delete;
  SceneFamily& operator=(const SceneFamily&) = delete;

  /// Drops all scenes but those at these values.
  virtual void keep(std::span<const double> values) = 0;
  /// The scene at a value, made where it is not there; stays until it is not kept. Throws SceneError for a
  /// value that makes no scene or one whose film is another, Interrupted.
  virtual Member at(double value) = 0;

 protected:
  SceneFamily() = default;
};

}  // namespace pbrtmedia
