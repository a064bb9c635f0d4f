// SPDX-License-Identifier: BSD-2-Clause
#include "media/texture_density.h"

#include <cmath>
#include <utility>

namespace pbrtmedia {
namespace {

/// Read first: threads do not queue for a flag that is up already.
void raise(std::atomic<bool>& flag) {
  if (!flag.load(std::memory_order_relaxed)) flag.store(true, std::memory_order_relaxed);
}

}  // namespace

TextureDensity::TextureDensity(const FloatTexture& texture, std::string name,
                               const Transform& worldFromMedium)
    : texture_(&texture), name_(std::move(name)), worldFromMedium_(worldFromMedium) {}

float TextureDensity::at(Vec3d p) const {
  SurfaceInteraction si;
  si.p = Point3f(worldFromMedium_.point(p));
  const float value = texture_->evaluate(si);
  if (value >= 0 && std::isfinite(value)) return value;
  raise(std::isfinite(value) ? sawNegative_ : sawNotFinite_);
  return 0;
}

std::string TextureDensity::describe() const {
  return name_.empty() ? "constant texture" : "texture \"" + name_ + '"';
}

std::string TextureDensity::complaint() const {
  const bool negative = sawNegative_.load(std::memory_order_relaxed);
  if (!negative && !sawNotFinite_.load(std::memory_order_relaxed)) return "";
  std::string text = describe();
  text += sawNotFinite_.load(std::memory_order_relaxed)
              ? negative ? " has negative and non-finite values" : " has non-finite values"
              : " has negative values";
  return text + " in the medium; they count as density 0";
}

}  // namespace pbrtmedia
