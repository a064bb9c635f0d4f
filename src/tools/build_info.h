// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <string_view>

namespace pbrtmedia {

/// Which program this is, in one line: "pbrt-media 0.1.0, commit 1a2b3c4d5e6f with local changes, GCC 12.2.0,
/// Release, AVX2". The last word is the instruction set that vector code uses on this machine. What --version
/// prints, and what images and statistics keep under "version".
std::string buildText();

/// "commit 1a2b3c4d5e6f", " with local changes" behind it where files that git tracks differ from the commit,
/// or "commit unknown" with the reason. Found out whenever the program is built; see cmake/commit.cmake.
std::string_view commitText();

}  // namespace pbrtmedia
