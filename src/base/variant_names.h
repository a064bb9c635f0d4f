// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pbrtmedia {

/// The variant of the alternatives of `Variant`, then `More`.
template <class Variant, class... More>
struct AppendVariant;
template <class... T, class... More>
struct AppendVariant<std::variant<T...>, More...> {
  using type = std::variant<T..., More...>;
};
template <class Variant, class... More>
using AppendedVariant = typename AppendVariant<Variant, More...>::type;

/// The keywords of a variant whose alternatives each have `kName`, in order.
template <class Variant>
std::vector<std::string_view> alternativeNames() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::vector<std::string_view>{std::variant_alternative_t<I, Variant>::kName...};
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
}

/// The default-constructed alternative called `name`.
template <class Variant>
std::optional<Variant> findAlternative(std::string_view name) {
  std::optional<Variant> found;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((std::variant_alternative_t<I, Variant>::kName == name ? void(found.emplace(std::in_place_index<I>))
                                                            : void()),
     ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
  return found;
}

template <class Variant>
std::string_view alternativeName(const Variant& value) {
  return std::visit([](const auto& held) { return std::string_view(held.kName); }, value);
}

}  // namespace pbrtmedia
