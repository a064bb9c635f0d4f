// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "construct/tolerance.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

// The one way to read a word that stands for an enumerator. `words`: in the order of the enumerators of E.

/// Of PBRT-v3's parameters: an unknown word gives the fallback, with a warning (--strict: an error).
template <class E, std::size_t N>
E findEnum(ParamReader& in, std::string_view name, const std::array<std::string_view, N>& words, E fallback) {
  return static_cast<E>(in.findChoice(name, words, static_cast<std::size_t>(fallback)));
}

/// Of parameters that only this renderer has: an unknown word is an error.
template <class E, std::size_t N>
E findOwnEnum(ParamReader& in, std::string_view name, const std::array<std::string_view, N>& words,
              E fallback) {
  return static_cast<E>(findOwnChoice(in, name, words, static_cast<std::size_t>(fallback)));
}

}  // namespace pbrtmedia
