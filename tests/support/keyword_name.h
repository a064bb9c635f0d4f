// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace pbrtmedia::test {

/// What a test over all keywords is called with one of them: "RayMarching" for "ray-marching".
inline std::string keywordName(const testing::TestParamInfo<std::string_view>& parameter) {
  std::string name;
  bool capital = true;
  for (const char c : parameter.param) {
    if (c != '-') name += capital ? static_cast<char>(c - 'a' + 'A') : c;
    capital = c == '-';
  }
  return name;
}

}  // namespace pbrtmedia::test
