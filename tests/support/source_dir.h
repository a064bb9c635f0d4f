// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>

namespace pbrtmedia::test {

/// The root of the checkout that the tests were built from.
std::filesystem::path sourceDir();

}  // namespace pbrtmedia::test
