// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pbrtmedia {

/// Frames of a sequence: first, first + step, … up to last.
struct FrameRange {
  int first = 0, last = 0, step = 1;
};

/// "12", "1-24" or "1:24", and "1-24:2", "1:24:2" or "1-24x2" for every second one; numbers >= 0,
/// first <= last, step >= 1. Nothing for any other text.
std::optional<FrameRange> parseFrameRange(const std::string& text);

/// Whether the name holds a place for a frame number: %d, %4d, %04d (C, Nuke), $F, $F4 (Houdini), or a row of
/// # as long as the number is wide (Blender, Nuke).
bool hasFramePlace(const std::string& name);
/// The name with every such place filled in. "%%" is a percent sign; without a place the name stays.
std::string frameName(const std::string& name, int frame);
/// The numbers of all frames that are there for such a name, rising. Only the folder of the first place is
/// listed.
std::vector<int> framesThatExist(const std::string& name);

}  // namespace pbrtmedia
