// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace pbrtmedia {

/// The image with these of its channels alone, and then, where `room` names more, others that are 0.
Image withChannels(const Image& image, const std::vector<std::string>& names,
                   const std::vector<std::string>& room = {});

/// Throws std::invalid_argument where pixels have no colour.
void requireColor(const Image& image);

/// Whether a channel is a colour or a coverage, to the eye: R, G, B, Y, A, or R, G, B, A of a layer
/// ("albedo.R"). Half floats suffice for these. Others are data, such as distances and counts; so is a
/// variance, which may be far below what a half float can hold.
bool isColour(std::string_view channel);

}  // namespace pbrtmedia
