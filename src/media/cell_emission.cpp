// SPDX-License-Identifier: BSD-2-Clause
#include "media/cell_emission.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {

Bounds3d CellEmission::boxOf(const Vec3<std::int64_t>& cell) const {
  const Vec3d size = lattice_.cellSize, low = Vec3d(cell);
  const auto scaled = [&](Vec3d v) { return Vec3d(v.x * size.x, v.y * size.y, v.z * size.z); };
  return {max(lattice_.box.min, scaled(low)), min(lattice_.box.max, scaled(low + Vec3d(1, 1, 1)))};
}

std::size_t CellEmission::indexOf(const Vec3<std::int64_t>& cell) const {
  const auto& n = lattice_.shape.count;
  return static_cast<std::size_t>((cell.z * n.y + cell.y) * n.x + cell.x);
}

std::unique_ptr<const EmissionVolume> CellEmission::over(
    const SuperVoxels& cells, const std::function<float(const SuperVoxel&)>& strengthOf,
    const Transform& worldFromLocal, Rgb emission) {
  std::unique_ptr<CellEmission> made(new CellEmission);
  made->lattice_ = cells.lattice();
  made->worldFromLocal_ = worldFromLocal;
  made->localFromWorld_ = AffineMap(worldFromLocal.inverseMatrix());
  made->emission_ = emission;
  const auto& n = made->lattice_.shape.count;
  made->strengths_.reserve(cells.cellCount());
  const double volumeScale = std::abs(worldFromLocal.matrix().determinant3());
  for (std::int64_t k = 0; k < n.z; ++k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      for (std::int64_t i = 0; i < n.x; ++i) {
        const SuperVoxel cell = cells.at(i, j, k);
        const Bounds3d box = made->boxOf({i, j, k});
        const Vec3d size = box.diagonal();
        const double volume = box.isEmpty() ? 0 : size.x * size.y * size.z * volumeScale;
        const float strength = cell.upper > 0 && volume > 0 ? strengthOf(cell) : 0.0f;
        made->strengths_.push_back(strength);
        if (!(strength > 0)) continue;
        made->emitters_.push_back(made->strengths_.size() - 1);
        made->total_ += static_cast<double>(strength) * volume;
        made->cumulative_.push_back(made->total_);
        for (int corner = 0; corner < 8; ++corner) {
          made->bounds_.expand(Point3f(worldFromLocal.point(box.corner(corner))));
        }
      }
    }
  }
  if (!(made->total_ > 0) || !std::isfinite(made->total_)) return nullptr;
  for (double& c : made->cumulative_) c /= made->total_;
  for (std::size_t a = 0; a < 3; ++a) {
    made->bounds_.min[a] = std::nextafter(made->bounds_.min[a], -kInfinity);
    made->bounds_.max[a] = std::nextafter(made->bounds_.max[a], kInfinity);
  }
  return made;
}

EmissionVolume::Sample CellEmission::sample(const std::array<double, 3>& u) const {
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u[0]);
  const auto chosen = static_cast<std::size_t>(found - cumulative_.begin());
  const double before = chosen > 0 ? cumulative_[chosen - 1] : 0, share = cumulative_[chosen] - before;
  // What is left of the number that chose the cell chooses the place along x.
  const double x = share > 0 ? std::clamp((u[0] - before) / share, 0.0, 1.0) : 0.5;
  const auto number = static_cast<std::int64_t>(emitters_[chosen]);
  const auto& n = lattice_.shape.count;
  const Bounds3d box = boxOf({number % n.x, number / n.x % n.y, number / (n.x * n.y)});
  const Vec3d size = box.diagonal();
  const Vec3d local = box.min + Vec3d(x * size.x, u[1] * size.y, u[2] * size.z);
  return {Point3f(worldFromLocal_.point(local)), static_cast<double>(strengths_[emitters_[chosen]]) / total_};
}

double CellEmission::pdf(Point3f p) const {
  const Vec3d local = localFromWorld_.point(Vec3d(p));
  if (!lattice_.box.contains(local)) return 0;
  Vec3<std::int64_t> cell;
  for (std::size_t a = 0; a < 3; ++a) {
    cell[a] = std::clamp(static_cast<std::int64_t>(local[a] / lattice_.cellSize[a]), std::int64_t{0},
                         lattice_.shape.count[a] - 1);
  }
  return static_cast<double>(strengths_[indexOf(cell)]) / total_;
}

}  // namespace pbrtmedia
