// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pbrtmedia {

/// The textures and named materials visible at one place of a scene: an immutable snapshot. A definition
/// makes a new snapshot, so whoever holds an older one keeps the older meaning of a name
/// (reference 5.2, 5.4).
///
/// A persistent treap (Seidel & Aragon 1996, doi:10.1007/BF01940876) with the hash of a name as its priority:
/// a definition copies the O(log n) nodes of one path, whatever block it stands in; a look-up takes O(log n).
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
  struct Key {
    std::string text;  ///< the kind as one byte, then the name
    std::uint64_t priority;
  };
  static Ptr node(const NameScope& entry, Ptr left, Ptr right);
  static Ptr insert(const Ptr& tree, const NameScope& entry);

  std::shared_ptr<const Key> key_;
  std::uint32_t index_ = 0;
  Ptr left_, right_;
};

}  // namespace pbrtmedia
