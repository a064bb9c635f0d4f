// SPDX-License-Identifier: BSD-2-Clause
// What cmake/StandardHeaders.cmake has compiled once for all rooms: the headers of the standard library that
// most of them include, and nothing of our own. For GCC alone: under Clang, and for clang-tidy, this is
// empty, and so each file is seen to include what it uses.
#ifndef __clang__
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <ostream>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>
#endif
