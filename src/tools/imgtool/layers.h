// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "film/layers.h"
#include "tools/imgtool/same_scene.h"

namespace pbrtmedia {

/// The layers that a render says it has (metadata "layers"). Throws std::runtime_error for one that is
/// unknown, or whose channels are not there.
LayerSet layersOf(const NamedImage& render);

/// Sets the layers of a merge of renders with other seeds, of so many samples each: totals are added, the
/// variance of the mean is that of a weighted mean, and what only some samples have (depths, positions,
/// normals) is the mean of those renders that have any; 0 says that none has. Others stay as they are.
void mergeLayers(const std::vector<NamedImage>& inputs, const std::vector<double>& samples, Image& out);

/// One layer as an image of its own, with channels R, G and B or Y: by its name ("normal"), by what its
/// channels begin with ("N"), or by the name of a channel ("N.X"); "colour" is what is no layer. What
/// this made before stays as it is. Throws
/// std::runtime_error, listing what there is, for others.
Image layerAlone(const std::string& file, const Image& image, const std::string& name);
/// Whether what --layer may call so is data and no colour (isColour), however an image of it alone calls its
/// channels.
bool isDataLayer(const std::string& name);
/// The channels of it, by their names in the file, in the order of the image layerAlone makes.
std::vector<std::string> channelsOfLayer(const std::string& file, const Image& image,
                                         const std::string& name);

}  // namespace pbrtmedia
