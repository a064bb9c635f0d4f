// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/description.h"
#include "scene/param_list.h"

namespace pbrtmedia {

/// What decides the expected image beside the program: renders whose identities are equal may be averaged.
struct SceneIdentity {
  struct File {
    std::string name;       ///< as the scene spells it
    std::uint64_t content;  ///< hash of its bytes, packed as they are
    bool operator==(const File&) const = default;
  };
  std::uint64_t text = 0;      ///< all text read, with its includes and the spectra read from files
  std::string mediumParams{};  ///< of the command line, as typed
  std::vector<File> files{};   ///< volumes, meshes, images, ..., by name
  std::string derivative{};    ///< of which the image is; "": it is that of the scene

  /// Of all the above.
  std::uint64_t hash() const;
};

/// The identity of a description that construct() has not taken apart yet. Reads every file that a parameter
/// of a medium, texture, material, light or shape names, or one of `mediumParams` (`mediumText` parsed):
/// about as fast as the disk delivers. A file that is not there is left out, as construct() will complain.
SceneIdentity identify(const SceneDescription& scene, const std::string& mediumText,
                       const ParamList& mediumParams);

}  // namespace pbrtmedia
