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

/// An AttributeBegin, TransformBegin or ObjectBegin that waits for its End.
struct OpenBlock {
  Directive opener;
  SourceLocation at;
  GraphicsState saved;
  std::int32_t object;  ///< the object definition around it
};

}  // namespace pbrtmedia
