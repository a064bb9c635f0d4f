// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "scene/parser.h"

namespace pbrtmedia {

/// A parsed text with what was said about it.
struct Parsed {
  Diagnostics diagnostics;
  std::vector<SceneDescription> scenes;
  std::string messages() const { return diagnostics.format(); }
  SceneDescription& scene() { return scenes.at(0); }
};

inline Parsed parse(std::string_view text, bool strict = false) {
  Parsed p;
  p.diagnostics.strict = strict;
  p.scenes = parseText(text, "t.pbrt", "", p.diagnostics);
  return p;
}

/// The text between WorldBegin and WorldEnd, in line 2 and following.
inline Parsed parseWorld(std::string_view text, bool strict = false) {
  return parse("WorldBegin\n" + std::string(text) + "\nWorldEnd\n", strict);
}

}  // namespace pbrtmedia
