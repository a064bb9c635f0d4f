// SPDX-License-Identifier: BSD-2-Clause
#include "materials/rare_lobe.h"

namespace pbrtmedia {

BsdfFlags RareLobe::flags() const {
  return std::visit([](const auto& m) { return m.kFlags; }, model_);
}
Rgb RareLobe::f(Vector3f wo, Vector3f wi) const {
  return std::visit([&](const auto& m) { return m.f(wo, wi); }, model_);
}
float RareLobe::pdf(Vector3f wo, Vector3f wi) const {
  return std::visit([&](const auto& m) { return m.pdf(wo, wi); }, model_);
}
LobeSample RareLobe::sample(Vector3f wo, Point2f u) const {
  return std::visit([&](const auto& m) { return m.sample(wo, u); }, model_);
}

}  // namespace pbrtmedia
