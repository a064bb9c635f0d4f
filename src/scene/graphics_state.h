// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "scene/description.h"
#include "scene/directives.h"

namespace pbrtmedia {

/// What AttributeBegin saves (reference 5.2).
struct GraphicsState {
  SharedTransform ctm = std::make_shared<const TransformPair>();
  bool startActive = true, endActive = true;  ///< ActiveTransform
  std::int32_t material = kNone;
  std::int32_t areaLight = kNone;
  bool reverseOrientation = false;
  NameScope::Ptr scope;
  SharedMedia media = std::make_shared<const MediumPair>();
  std::size_t mediaSeen = 0;  ///< how many media existed when the names in `media` were looked up
};

/// An AttributeBegin or ObjectBegin that waits for its End.
struct OpenAttributes {
  Directive opener;
  SourceLocation at;
  GraphicsState saved;
};

/// What every Begin saves of the transformation. PBRT-v3 keeps it on a stack of its own and pairs Begin and
/// End by position alone (reference 5.2): one End may give back the attributes of one Begin and the
/// transformation of another.
struct OpenTransform {
  Directive opener;
  SourceLocation at;
  SharedTransform ctm;
  bool startActive, endActive;
};

}  // namespace pbrtmedia
