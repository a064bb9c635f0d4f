// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "fields/lattice_walk.h"
#include "fields/learned_bounds.h"

namespace pbrtmedia {

/// A field whose bounds are learned (LearnedBounds): its density is the field's cut to the bounds in force.
/// Not piecewise cubic, whatever the field is.
template <class Field>
class ProgressiveField {
 public:
  static constexpr std::string_view kTypeName = Field::kTypeName;
  static constexpr bool kProvenBounds = false;

  ProgressiveField(Field field, const SuperVoxels& cells, const LearnedBounds::Params& params)
      : field_(std::move(field)), learned_(std::make_unique<LearnedBounds>(cells, params)) {}

  float density(Vec3d p) const { return learned_->bounded(p, field_.density(p)); }
  void densities(const LocalLine& line, std::span<const double> s, std::span<float> out) const {
    if constexpr (requires { field_.densities(line, s, out); }) {
      field_.densities(line, s, out);
    } else {
      for (std::size_t i = 0; i < s.size(); ++i) out[i] = field_.density(line.o + s[i] * line.d);
    }
    for (std::size_t i = 0; i < s.size(); ++i) out[i] = learned_->bounded(line.o + s[i] * line.d, out[i]);
  }
  auto densityAt(Point3f world) const { return field_.densityAt(world); }

  decltype(auto) localFromWorld() const { return field_.localFromWorld(); }
  decltype(auto) worldFromLocal() const { return field_.worldFromLocal(); }
  auto localBox() const { return field_.localBox(); }
  LearnedBounds& learned() { return *learned_; }
  const LearnedBounds& learned() const { return *learned_; }
  std::string describe() const { return field_.describe() + ", bounds learned"; }
  std::size_t bytes() const { return field_.bytes() + learned_->inForce().cellCount() * 2 * sizeof(float); }

 private:
  Field field_;
  std::unique_ptr<LearnedBounds> learned_;
};

}  // namespace pbrtmedia
