// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "scene/lexer.h"

namespace pbrtmedia {

/// A name from the scene in a message.
inline std::string quotedName(std::string_view name) { return '"' + shown(name) + '"'; }

/// `suggestion` for names that are owned.
inline std::string suggest(std::string_view found, const std::vector<std::string>& known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return suggestion(found, views);
}

/// The keys of a map by name, sorted.
template <class Map>
std::vector<std::string> keysOf(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& entry : map) keys.push_back(entry.first);
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace pbrtmedia
