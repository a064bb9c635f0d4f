// SPDX-License-Identifier: BSD-2-Clause
#include "main/kept_bounds.h"

#include <system_error>

namespace pbrtmedia {

KeptBounds::KeptBounds(const std::optional<std::filesystem::path>& file) : file_(file) {
  std::error_code ignored;
  if (file_ && std::filesystem::exists(*file_, ignored)) cache_ = BoundsCache::read(*file_);
}

std::string KeptBounds::restore(const std::string& sceneName, const Scene& scene) const {
  if (!file_) return {};
  const std::vector<Medium*> learners = scene.learners();
  std::string warnings;
  if (learners.empty()) warnings += "pbrt: warning: --bounds-cache: no medium has progressive bounds\n";
  if (!cache_) return warnings;
  for (Medium* medium : learners) {
    const std::string reason = cache_->restore(sceneName, *medium);
    if (reason.empty()) continue;
    warnings += "pbrt: warning: medium \"";
    warnings += medium->name();
    warnings += "\" starts with unknown bounds: ";
    warnings += reason;
    warnings += '\n';
  }
  return warnings;
}

void KeptBounds::save(const std::string& sceneName, const Scene& scene) {
  const std::vector<Medium*> learners = scene.learners();
  if (!file_ || learners.empty()) return;
  if (!cache_) cache_.emplace();
  for (Medium* medium : learners) cache_->keep(sceneName, *medium);
  cache_->write(*file_);
}

}  // namespace pbrtmedia
