// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

namespace pbrtmedia {

/// Whether a request with this Host header ("127.0.0.1:14200") means this server: it names an address or
/// "localhost", or, where the server was told to serve others too, this machine or `servedHost`. A page of
/// the web whose own name was made to lead here (DNS rebinding) has another name in its requests, and shall
/// read nothing.
bool isOwnHost(std::string_view header, std::string_view servedHost);

}  // namespace pbrtmedia
