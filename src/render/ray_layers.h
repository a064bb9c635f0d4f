// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/vec.h"
#include "film/layers.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Gathers what light transport along one camera ray tells besides the radiance (docs/layers.md), where the
/// path may be followed for each channel alone: everything is a sum over what is told. Throughputs are those
/// of the path from the camera on.
class RayLayers {
 public:
  /// Where the camera ray was first scattered.
  enum class Scatterer { Surface, Medium };

  /// What an integrator that does all of the below can tell: without media, and with them.
  static LayerMask ofSurfaces();
  static LayerMask ofMedia();
  /// And one that only says what radiance there is: the parts of it.
  static LayerMask ofRadiance(bool rendersMedia);

  explicit RayLayers(const LayerSample& out) : out_(out) {}

  bool wantsAlbedo() const { return out_.wants(Layer::Albedo); }
  /// Radiance that was scattered so often on its way; `first`: by what last, before the camera.
  void addRadiance(Rgb value, int scatterings, Scatterer first);
  /// The camera ray meets a surface that scatters. `n`: shading normal on the camera's side, `p` in world
  /// space; `albedo` may be left black where it is not wanted.
  void addSurface(Rgb throughput, float distance, Vector3f n, Point3f p, Rgb albedo);
  /// A medium scatters it, which `throughput` contains already.
  void addScattering(Rgb throughput, double distance);
  /// It leaves the scene.
  void addEscape(Rgb throughput);
  /// Hands over all that was told. Once.
  void finish() const;

 private:
  LayerSample out_;
  Rgb emission_, direct_, indirect_, surface_, medium_;
  Rgb passed_, escaped_, albedo_;
  float distance_ = 0, surfaceWeight_ = 0;
  Vector3f n_;
  Point3f p_;
  double mediumDistance_ = 0, mediumWeight_ = 0;
};

}  // namespace pbrtmedia
