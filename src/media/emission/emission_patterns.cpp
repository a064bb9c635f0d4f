// SPDX-License-Identifier: BSD-2-Clause
#include "media/emission/emission_patterns.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "media/emission/blackbody_curve.h"

namespace pbrtmedia {
namespace {

/// The number itself, for each channel.
struct ScaleCurve {
  Rgb at(float value) const { return Rgb(value); }
  float upper(float value) const { return value; }
  std::string describe() const { return "a grid of factors"; }
  std::size_t bytes() const { return 0; }
};

struct TemperatureCurve {
  TemperatureCurve(const TemperatureMap& temperatures, float largestValue)
      : map(temperatures), curve(kelvin(largestValue)), hottest(std::max(kelvin(largestValue), kelvin(0))) {}
  float kelvin(float value) const { return (value - map.offset) * map.scale; }
  Rgb at(float value) const { return curve.at(kelvin(value)); }
  float upper(float value) const { return curve.upper(kelvin(value)); }
  std::string describe() const {
    return "black bodies of up to " + std::to_string(static_cast<long long>(hottest)) + " K";
  }
  std::size_t bytes() const { return curve.bytes(); }

  TemperatureMap map;
  BlackbodyCurve curve;
  float hottest;
};

/// A curve of the numbers of a field, by the curve's rising bound.
template <class Field, class Curve>
class FieldPattern final : public EmissionPattern {
 public:
  FieldPattern(Field field, SuperVoxels bounds, Curve curve)
      : field_(std::move(field)), bounds_(std::move(bounds)), curve_(std::move(curve)) {}

  Rgb at(Vec3d p) const override {
    const Vec3d local = field_.localFromWorld().point(p);
    return curve_.at(field_.localBox().contains(local) ? field_.density(local) : 0);
  }

  float upperOver(const std::array<Vec3d, 8>& corners) const override {
    Bounds3d box;
    for (const Vec3d& c : corners) box.expand(field_.localFromWorld().point(c));
    const SuperVoxelLattice& lattice = bounds_.lattice();
    Vec3<std::int64_t> first, last;
    for (std::size_t a = 0; a < 3; ++a) {
      // A little wider, for rounding.
      const double room = kRoom * (1 + std::abs(box.min[a]) + std::abs(box.max[a]));
      const double low = std::floor((box.min[a] - room) / lattice.cellSize[a]),
                   high = std::floor((box.max[a] + room) / lattice.cellSize[a]);
      const auto count = static_cast<double>(lattice.shape.count[a]);
      if (high < 0 || low >= count) return curve_.upper(0);
      first[a] = static_cast<std::int64_t>(std::max(low, 0.0));
      last[a] = static_cast<std::int64_t>(std::min(high, count - 1));
    }
    float most = 0;
    for (std::int64_t k = first.z; k <= last.z; ++k) {
      for (std::int64_t j = first.y; j <= last.y; ++j) {
        for (std::int64_t i = first.x; i <= last.x; ++i) most = std::max(most, bounds_.at(i, j, k).upper);
      }
    }
    return curve_.upper(most);
  }

  bool isBlack() const override { return !(curve_.upper(bounds_.maximum()) > 0); }
  std::string describe() const override { return curve_.describe(); }
  std::size_t bytes() const override { return field_.bytes() + bounds_.bytes() + curve_.bytes(); }

 private:
  static constexpr double kRoom = 1e-9;
  Field field_;
  SuperVoxels bounds_;
  Curve curve_;
};

class ProductPattern final : public EmissionPattern {
 public:
  ProductPattern(std::shared_ptr<const EmissionPattern> a, std::shared_ptr<const EmissionPattern> b)
      : a_(std::move(a)), b_(std::move(b)) {}
  Rgb at(Vec3d p) const override {
    const Rgb a = a_->at(p);
    return a.isBlack() ? a : a * b_->at(p);
  }
  float upperOver(const std::array<Vec3d, 8>& corners) const override {
    return a_->upperOver(corners) * b_->upperOver(corners);
  }
  bool isBlack() const override { return a_->isBlack() || b_->isBlack(); }
  std::string describe() const override { return a_->describe() + " times " + b_->describe(); }
  std::size_t bytes() const override { return a_->bytes() + b_->bytes(); }

 private:
  std::shared_ptr<const EmissionPattern> a_, b_;
};

template <class Field>
std::shared_ptr<const EmissionPattern> scalePattern(Field field) {
  SuperVoxels bounds = field.superVoxels(field.lattice({}));
  return std::make_shared<FieldPattern<Field, ScaleCurve>>(std::move(field), std::move(bounds), ScaleCurve());
}

template <class Field>
std::shared_ptr<const EmissionPattern> blackbodyPattern(Field field, const TemperatureMap& map) {
  SuperVoxels bounds = field.superVoxels(field.lattice({}));
  const float most = bounds.maximum();
  return std::make_shared<FieldPattern<Field, TemperatureCurve>>(std::move(field), std::move(bounds),
                                                                 TemperatureCurve(map, most));
}

}  // namespace

std::shared_ptr<const EmissionPattern> makeScalePattern(const GridField::Params& grid,
                                                        const Transform& worldFromMedium) {
  return scalePattern(GridField(grid, worldFromMedium));
}
std::shared_ptr<const EmissionPattern> makeScalePattern(const NanoVdbField::Params& grid,
                                                        const Transform& worldFromMedium) {
  return scalePattern(NanoVdbField(grid, worldFromMedium));
}
std::shared_ptr<const EmissionPattern> makeBlackbodyPattern(const GridField::Params& grid,
                                                            const TemperatureMap& map,
                                                            const Transform& worldFromMedium) {
  return blackbodyPattern(GridField(grid, worldFromMedium), map);
}
std::shared_ptr<const EmissionPattern> makeBlackbodyPattern(const NanoVdbField::Params& grid,
                                                            const TemperatureMap& map,
                                                            const Transform& worldFromMedium) {
  return blackbodyPattern(NanoVdbField(grid, worldFromMedium), map);
}
std::shared_ptr<const EmissionPattern> makeProductPattern(std::shared_ptr<const EmissionPattern> a,
                                                          std::shared_ptr<const EmissionPattern> b) {
  return std::make_shared<ProductPattern>(std::move(a), std::move(b));
}

}  // namespace pbrtmedia
