// SPDX-License-Identifier: BSD-2-Clause
#include "scene/name_scope.h"

#include <utility>

#include "base/hash.h"

namespace pbrtmedia {
namespace {

std::string keyOf(NameScope::Kind kind, std::string_view name) {
  std::string key(1, static_cast<char>(kind));
  return key.append(name);
}

}  // namespace

NameScope::Ptr NameScope::node(const NameScope& entry, Ptr left, Ptr right) {
  const auto made = std::make_shared<NameScope>();
  made->key_ = entry.key_;
  made->index_ = entry.index_;
  made->left_ = std::move(left);
  made->right_ = std::move(right);
  return made;
}

NameScope::Ptr NameScope::insert(const Ptr& tree, const NameScope& entry) {
  if (!tree) return node(entry, nullptr, nullptr);
  const int order = entry.key_->text.compare(tree->key_->text);
  if (order == 0) return node(entry, tree->left_, tree->right_);
  const Ptr child = insert(order < 0 ? tree->left_ : tree->right_, entry);
  // The child goes on top when its priority is higher: a rotation.
  const bool rotate = child->key_->priority > tree->key_->priority;
  if (order < 0) {
    return rotate ? node(*child, child->left_, node(*tree, child->right_, tree->right_))
                  : node(*tree, child, tree->right_);
  }
  return rotate ? node(*child, node(*tree, tree->left_, child->left_), child->right_)
                : node(*tree, tree->left_, child);
}

NameScope::Ptr NameScope::with(const Ptr& scope, Kind kind, std::string_view name, std::uint32_t index) {
  std::string key = keyOf(kind, name);
  const std::uint64_t priority = hashBytes(key);
  NameScope entry;
  entry.key_ = std::make_shared<const Key>(Key{std::move(key), priority});
  entry.index_ = index;
  return insert(scope, entry);
}

std::optional<std::uint32_t> NameScope::find(const Ptr& scope, Kind kind, std::string_view name) {
  const std::string key = keyOf(kind, name);
  const NameScope* at = scope.get();
  while (at) {
    const int order = key.compare(at->key_->text);
    if (order == 0) return at->index_;
    at = (order < 0 ? at->left_ : at->right_).get();
  }
  return std::nullopt;
}

std::vector<std::string> NameScope::names(const Ptr& scope, Kind kind) {
  std::vector<std::string> found;
  std::vector<const NameScope*> path;  // nodes whose left side is done or under way
  for (const NameScope* at = scope.get(); at || !path.empty();) {
    if (at) {
      path.push_back(at);
      at = at->left_.get();
      continue;
    }
    at = path.back();
    path.pop_back();
    const std::string& key = at->key_->text;
    if (key[0] == static_cast<char>(kind)) found.push_back(key.substr(1));
    at = at->right_.get();
  }
  return found;
}

}  // namespace pbrtmedia
