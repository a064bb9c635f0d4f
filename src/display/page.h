// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

namespace pbrtmedia {

/// The page that PageServer serves (page.html): markup, style and script in one text. "@NONCE@" stands where
/// the nonce of the Content-Security-Policy goes.
extern const std::string_view kPage;

}  // namespace pbrtmedia
