// SPDX-License-Identifier: BSD-2-Clause
#include "scene/name_scope.h"

#include <algorithm>

namespace pbrtmedia {
namespace {

std::string keyOf(NameScope::Kind kind, std::string_view name) {
  std::string key(1, static_cast<char>(kind));
  return key.append(name);
}

}  // namespace

NameScope::Ptr NameScope::with(const Ptr& scope, Kind kind, std::string_view name, std::uint32_t index) {
  const auto grown = std::make_shared<NameScope>();
  grown->entries_.emplace(keyOf(kind, name), index);
  grown->outer_ = scope;
  // Take in layers that are not larger than this one, so that sizes at least double going outwards.
  while (grown->outer_ && grown->outer_->entries_.size() <= grown->entries_.size()) {
    const Ptr layer = grown->outer_;
    grown->entries_.insert(layer->entries_.begin(), layer->entries_.end());  // inner bindings stay
    grown->outer_ = layer->outer_;
  }
  return grown;
}

std::optional<std::uint32_t> NameScope::find(const Ptr& scope, Kind kind, std::string_view name) {
  const std::string key = keyOf(kind, name);
  for (const NameScope* layer = scope.get(); layer; layer = layer->outer_.get()) {
    if (const auto it = layer->entries_.find(key); it != layer->entries_.end()) return it->second;
  }
  return std::nullopt;
}

std::vector<std::string> NameScope::names(const Ptr& scope, Kind kind) {
  std::vector<std::string> found;
  for (const NameScope* layer = scope.get(); layer; layer = layer->outer_.get()) {
    for (const auto& entry : layer->entries_) {
      if (entry.first[0] == static_cast<char>(kind)) found.push_back(entry.first.substr(1));
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace pbrtmedia
