// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "scene/entity.h"

namespace pbrtmedia {

/// One plugin of a kind: its name in scene files and the function that reads its parameters.
template <class Read>
struct Plugin {
  std::string_view name;
  Read read;
};

/// The entry named by the entity's type. An unknown name is reported with the nearest ones and gives null.
/// `kind` starts the message: "Camera", "texture class", …  `consequence`: what PBRT-v3 does then ("the shape
/// is left out"), which makes it a tolerated problem; "" where nothing could be rendered: an error.
template <class Read>
const Plugin<Read>* findPlugin(std::span<const Plugin<Read>> table, const Entity& entity,
                               std::string_view kind, std::string_view consequence,
                               Diagnostics& diagnostics) {
  std::vector<std::string_view> names;
  for (const Plugin<Read>& plugin : table) {
    if (plugin.name == entity.type) return &plugin;
    names.push_back(plugin.name);
  }
  const SourceLocation& at = entity.typeLocation.file != nullptr ? entity.typeLocation : entity.location;
  std::string message(kind);
  message += ": unknown type \"" + entity.type + "\"" + suggestion(entity.type, names);
  if (consequence.empty()) {
    diagnostics.error(at, std::move(message));
  } else {
    message += "; ";
    message += consequence;
    diagnostics.tolerated(at, std::move(message));
  }
  return nullptr;
}

/// Runs `make`, turning the exceptions of constructors into a SceneError at the entity.
template <class Make>
auto builtAt(const SourceLocation& location, std::string_view context, const Make& make) {
  try {
    return make();
  } catch (const SceneError& e) {
    // A constructor does not know where its values stand; a file reader does.
    if (e.location().file != nullptr) throw;
    throw SceneError(location, std::string(context) + ": " + e.what());
  } catch (const std::invalid_argument& e) {
    throw SceneError(location, std::string(context) + ": " + e.what());
  }
}

}  // namespace pbrtmedia
