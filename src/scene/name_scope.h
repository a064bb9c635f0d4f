// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace pbrtmedia {

/// The textures and named materials visible at one place of a scene: an immutable snapshot. A definition
/// makes a new snapshot, so whoever holds an older one keeps the older meaning of a name
/// (reference 5.2, 5.4).
///
/// Layers of doubling size: `n` definitions cost O(n log n) in total, a look-up O(log n) layers.
class NameScope {
 public:
  enum class Kind : std::uint8_t { FloatTextures, SpectrumTextures, Materials };
  using Ptr = std::shared_ptr<const NameScope>;  ///< null is the empty scope

  /// `scope` with `name` bound to `index`; hides an earlier binding of the same kind and name.
  static Ptr with(const Ptr& scope, Kind kind, std::string_view name, std::uint32_t index);
  /// Index into SceneDescription::textures or ::materials.
  static std::optional<std::uint32_t> find(const Ptr& scope, Kind kind, std::string_view name);
  /// All visible names of a kind, sorted: for messages.
  static std::vector<std::string> names(const Ptr& scope, Kind kind);

 private:
  std::unordered_map<std::string, std::uint32_t> entries_;  ///< key: kind as one byte, then the name
  Ptr outer_;
};

}  // namespace pbrtmedia
