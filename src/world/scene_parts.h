// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "world/alpha_filter.h"
#include "world/medium_light.h"
#include "world/scene.h"

namespace pbrtmedia {

/// What SceneBuilder collects and Scene owns. Members are destroyed from the last to the first, so that users
/// go before what they borrow.
struct Scene::Parts {
  using Owned = std::unique_ptr<void, void (*)(void*)>;

  struct PlacedPrimitive {
    Primitive primitive;
    std::uint32_t firstLight = SceneHit::kNoLight;
    bool outsideIsAmbient = false;  ///< the medium outside is not one that its object encloses
  };
  /// Primitives under one accelerator, by geometry number.
  struct Group {
    std::deque<PlacedPrimitive> primitives;
    std::deque<AlphaFilter> filters;
    Accelerator accelerator;

    std::uint32_t add(Primitive primitive);
    void findAmbientMedia();
    std::vector<MediumEmitter> mediumEmitters(bool inObject) const;
  };
  /// What a geometry or instance number of the top level means; one of the two is set.
  struct Entry {
    const PlacedPrimitive* primitive = nullptr;
    const Placement* placement = nullptr;
  };

  void addMediumLights();

  std::vector<Owned> owned;
  std::vector<Medium*> media;  ///< among the owned
  std::vector<std::unique_ptr<Light>> freeLights;
  std::vector<Light*> lights;
  std::vector<PrimitiveId> lightTargets;
  MediumLights mediumLights;
  std::deque<Group> objects;
  std::deque<Placement> placements;
  std::vector<Entry> entries;
  Group top;
};

}  // namespace pbrtmedia
