// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
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
  std::uint64_t text = 0;  ///< all text read, with its includes and the spectra read from files
  std::vector<Variables::Used> variables{};
  std::string mediumParams{};  ///< of the command line, by values (textOf)
  std::vector<File> files{};   ///< volumes, meshes, images, ..., by name
  std::string derivative{};    ///< of which the image is; "": it is that of the scene

  /// Of all the above.
  std::uint64_t hash() const;
};

/// A file that a parameter names.
struct NamedFile {
  std::string name;  ///< as the parameter spells it
  std::filesystem::path path;
  SourceLocation at;  ///< of the name
};

/// The files, there are, that parameters of the camera, a medium, texture, material, light or shape name, or
/// one of `mediumParams`; each once. A description that construct() has not taken apart yet.
std::vector<NamedFile> namedFiles(const SceneDescription& scene, const ParamList& mediumParams);

/// The identity of such a description. Reads all its namedFiles(), about as fast as the disk delivers. A file
/// that is not there is left out, as construct() will complain.
SceneIdentity identify(const SceneDescription& scene, const ParamList& mediumParams);

}  // namespace pbrtmedia
