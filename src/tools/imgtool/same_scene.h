// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/imgtool/common.h"

namespace pbrtmedia {

/// A render to merge. `name` is shown in errors.
struct NamedImage {
  std::string name;
  Image image;
};

/// Throws std::runtime_error.
[[noreturn]] void failMerge(const std::string& name, const std::string& message);
/// Throws std::runtime_error where it is missing.
std::string requiredMetadata(const NamedImage& input, const std::string& key);
/// Samples per pixel of a render. Throws std::runtime_error for senseless ones.
double samplesOf(const NamedImage& input);

/// Throws std::runtime_error, saying in what they differ, when two are not renders of one scene, or not of
/// the same pixels and channels.
void requireSameScene(const NamedImage& first, const NamedImage& other);
/// Throws std::runtime_error for a render that began with unknown bounds. Such parts lack the same
/// extinction, and so does their average, however many there are: one long render would have grown out of it.
void requireKnownBounds(const NamedImage& input);
/// Of what was merged: the scene, all commands and versions, sums of samples and seconds.
std::map<std::string, std::string> mergedMetadata(const std::vector<NamedImage>& inputs);

}  // namespace pbrtmedia
