// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/distribution.h"
#include "base/transform.h"
#include "lights/light.h"
#include "lights/light_map.h"

namespace pbrtmedia {

/// `LightSource "infinite"`: radiance from all around, constant or from a latitude-longitude map whose pole
/// (top row) is light-space +z and whose left edge is +x: u = atan2(y, x)/2π, v = acos(z)/π.
///
/// A map is sampled cell by cell, a cell being the solid angle one texel covers; its probability is the
/// integral of the interpolated radiance over the cell (channel mean, times the cell's solid angle), so it is
/// positive wherever the radiance is. Inside a cell directions are uniform over solid angle, so the density
/// is constant there, also at the poles. Without a map nothing is tabulated and the sphere is sampled
/// uniformly.
class InfiniteLight final : public Light {
 public:
  struct Params {
    Rgb radiance{1.0f};  ///< "L" times "scale", W/(m² sr)
    /// "mapname", read without gamma decoding; multiplies the radiance
    std::optional<Image> map = std::nullopt;
    int samples = 1;  ///< "samples"
  };
  /// Throws std::invalid_argument when the transform has no inverse or the map is unusable (see LightMap).
  /// A transform that scales unevenly is followed exactly: directions are mapped and normalised.
  InfiniteLight(const Transform& worldFromLight, const Params& params);

  std::string_view typeName() const override { return "infinite"; }
  bool isDelta() const override { return false; }
  bool isInfinite() const override { return true; }
  bool isUniformInfinite() const override { return !map_; }
  void preprocess(const Bounds3f& sceneBounds) override;
  LightSample sample(Point3f reference, Point2f u) const override;
  float pdf(Point3f reference, Vector3f wi, const SurfaceInteraction* hit) const override;
  Rgb background(Vector3f direction) const override;
  /// π R² times the mean radiance, with the radius R of the scene's bounding sphere, known after
  /// `preprocess`.
  Rgb power() const override;

 private:
  /// Solid-angle density, in light space, of the cell that holds (u, v).
  float solidAnglePdf(Point2f uv) const;
  std::size_t rowOf(float v) const;
  /// d(solid angle in light space) / d(solid angle in world space) at a unit world direction.
  float jacobian(Vector3f world) const;

  Affine3f worldFromLight_, lightFromWorld_;
  float inverseDeterminant_ = 1;  ///< |det| of lightFromWorld_
  bool keepsSolidAngles_ = true;  ///< the transform is a rotation, a mirror or an even scale of one
  Rgb radiance_;
  double sceneRadius_ = 0;
  std::optional<LightMap> map_;
  Distribution2D cells_;
  std::vector<double> sinSquaredHalf_;  ///< sin²(θ/2) at the height + 1 row borders
};

}  // namespace pbrtmedia
