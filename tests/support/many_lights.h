// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "base/rng.h"
#include "lights/diffuse_area.h"
#include "lights/distant.h"
#include "lights/infinite.h"
#include "lights/point.h"
#include "lights/spot.h"
#include "shapes/triangle_mesh.h"

namespace pbrtmedia::test {

inline constexpr Bounds3f kBoxOfLights{{-10, -10, -10}, {10, 10, 10}};

/// Lights of all kinds at random places in a box, of powers that differ by three orders of magnitude.
class ManyLights {
 public:
  /// `places`: lights at finite places; `far`: distant lights. `hasSky`: and a uniform infinite one.
  explicit ManyLights(std::size_t places, std::size_t far = 0, bool hasSky = false) {
    Rng rng(11);
    const auto within = [&](float r) { return r * (2 * rng.uniform() - 1); };
    const auto strength = [&] { return Rgb(std::pow(10.0f, 3 * rng.uniform())); };
    const auto anywhere = [&] { return Point3f{within(10), within(10), within(10)}; };
    for (std::size_t i = 0; i < places; ++i) {
      const Point3f from = anywhere();
      if (i % 3 == 0) {
        add(std::make_unique<PointLight>(Transform(),
                                         PointLight::Params{.intensity = strength(), .from = from}));
      } else if (i % 3 == 1) {
        add(std::make_unique<SpotLight>(
            Transform(), SpotLight::Params{.intensity = strength(), .from = from, .to = anywhere()}));
      } else {
        TriangleMesh::Params mesh;
        for (int k = 0; k < 3; ++k) mesh.P.push_back(from + Vector3f{within(1), within(1), within(1)});
        mesh.indices = {0, 1, 2};
        shapes_.push_back(std::make_unique<TriangleMesh>(std::move(mesh), ShapePlacement{}));
        add(std::make_unique<DiffuseAreaLight>(
            *shapes_.back(), 0, DiffuseAreaLight::Params{.radiance = strength(), .twoSided = i % 2 == 0}));
      }
    }
    for (std::size_t i = 0; i < far; ++i)
      add(std::make_unique<DistantLight>(Transform(),
                                         DistantLight::Params{.radiance = strength(), .to = anywhere()}));
    if (hasSky) add(std::make_unique<InfiniteLight>(Transform(), InfiniteLight::Params{}));
  }
  const Light& operator[](std::size_t i) const { return *lights_[i]; }
  std::size_t size() const { return lights_.size(); }
  std::vector<const Illuminant*> all() const {
    std::vector<const Illuminant*> all;
    for (const auto& light : lights_) all.push_back(light.get());
    return all;
  }
  std::vector<const Light*> lights() const {
    std::vector<const Light*> all;
    for (const auto& light : lights_) all.push_back(light.get());
    return all;
  }

 private:
  void add(std::unique_ptr<Light> light) {
    light->preprocess(kBoxOfLights);
    lights_.push_back(std::move(light));
  }
  std::vector<std::unique_ptr<Shape>> shapes_;
  std::vector<std::unique_ptr<Light>> lights_;
};

}  // namespace pbrtmedia::test
