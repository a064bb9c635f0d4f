// SPDX-License-Identifier: BSD-2-Clause
#include "media/emission/cell_emission.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {

Bounds3d CellEmission::boxOf(const Vec3<std::int64_t>& cell) const {
  const Vec3d size = lattice_.cellSize, low = Vec3d(cell);
  const auto scaled = [&](Vec3d v) { return Vec3d(v.x * size.x, v.y * size.y, v.z * size.z); };
  return {max(lattice_.box.min, scaled(low)), min(lattice_.box.max, scaled(low + Vec3d(1, 1, 1)))};
}

std::unique_ptr<const EmissionVolume> CellEmission::over(
    const SuperVoxels& cells, const std::function<Weight(const SuperVoxel&)>& weightOf,
    const Transform& worldFromLocal, Rgb emission, Rgb radiance) {
  std::unique_ptr<CellEmission> made(new CellEmission);
  made->lattice_ = cells.lattice();
  made->worldFromLocal_ = worldFromLocal;
  made->localFromWorld_ = AffineMap(worldFromLocal.inverseMatrix());
  const auto& n = made->lattice_.shape.count;
  made->weights_.resize(static_cast<std::size_t>(made->lattice_.shape.stored()));
  std::uint64_t number = 0;
  float brightest = 0;
  double power = 0;
  const double volumeScale = std::abs(worldFromLocal.matrix().determinant3());
  for (std::int64_t k = 0; k < n.z; ++k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      for (std::int64_t i = 0; i < n.x; ++i) {
        const SuperVoxel cell = cells.at(i, j, k);
        const Bounds3d box = made->boxOf({i, j, k});
        const Vec3d size = box.diagonal();
        const double volume = box.isEmpty() ? 0 : size.x * size.y * size.z * volumeScale;
        const Weight weight = cell.upper > 0 && volume > 0 ? weightOf(cell) : Weight{};
        const std::uint64_t here = number++;
        if (!(weight.emission > 0)) continue;
        made->weights_[static_cast<std::size_t>(made->lattice_.shape.index(i, j, k))] = weight.emission;
        made->emitters_.push_back(here);
        made->sum_ += static_cast<double>(weight.emission) * volume;
        made->cumulative_.push_back(made->sum_);
        power += static_cast<double>(weight.power) * volume;
        brightest = std::max(brightest, weight.radiance);
        for (int corner = 0; corner < 8; ++corner) {
          made->bounds_.expand(Point3f(worldFromLocal.point(box.corner(corner))));
        }
      }
    }
  }
  if (!(made->sum_ > 0) || !std::isfinite(made->sum_)) return nullptr;
  for (double& c : made->cumulative_) c /= made->sum_;
  for (std::size_t a = 0; a < 3; ++a) {
    made->bounds_.min[a] = std::nextafter(made->bounds_.min[a], -kInfinity);
    made->bounds_.max[a] = std::nextafter(made->bounds_.max[a], kInfinity);
  }
  // Whatever is inside, no more leaves a box than if its surface were the brightest there is: pi times the
  // radiance and the surface, over the 4 pi that `total` leaves out.
  const Vec3d box = Vec3d(made->bounds_.diagonal());
  const auto mostPerRadiance = static_cast<float>(0.5 * (box.x * box.y + box.y * box.z + box.z * box.x));
  made->total_ = emission * static_cast<float>(power);
  for (std::size_t c = 0; c < 3; ++c) {
    made->total_[c] = std::min(made->total_[c], radiance[c] * brightest * mostPerRadiance);
  }
  return made;
}

Point3f CellEmission::sample(const std::array<double, 3>& u) const {
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
  return Point3f(worldFromLocal_.point(local));
}

double CellEmission::density(Point3f p) const {
  const Vec3d local = localFromWorld_.point(Vec3d(p));
  const auto& n = lattice_.shape.count;
  const auto cellAlong = [&](std::size_t a, std::int64_t count) -> std::int64_t {
    if (!(local[a] >= lattice_.box.min[a] && local[a] <= lattice_.box.max[a])) return -1;
    return std::clamp(static_cast<std::int64_t>(std::floor(local[a] / lattice_.cellSize[a])), std::int64_t{0},
                      count - 1);
  };
  const std::int64_t i = cellAlong(0, n.x), j = cellAlong(1, n.y), k = cellAlong(2, n.z);
  if (i < 0 || j < 0 || k < 0) return 0;
  return static_cast<double>(weights_[static_cast<std::size_t>(lattice_.shape.index(i, j, k))]) / sum_;
}

double CellEmission::directionDensity(const Segment& segment) const {
  const Vec3d o = localFromWorld_.point(Vec3d(segment.o)), d = localFromWorld_.vector(Vec3d(segment.d));
  const auto span = clipToBox(lattice_.box, o, d, segment.tMin, segment.tMax);
  if (!span || !(span->tMin < span->tMax)) return 0;
  LocalLine line;
  for (std::size_t a = 0; a < 3; ++a) {
    line.o[a] = (o[a] + span->tMin * d[a]) / lattice_.cellSize[a];
    line.d[a] = d[a] / lattice_.cellSize[a];
    line.inverse[a] = 1 / line.d[a];
  }
  double sum = 0, entered = 0;
  walkLattice(lattice_.shape, line, 0.0, span->tMax - span->tMin, [&](double exit, std::size_t cell) {
    const double weight = static_cast<double>(weights_[cell]);
    if (weight > 0) sum += weight * squaresOver(span->tMin + entered, span->tMin + exit);
    entered = exit;
    return true;
  });
  return sum / sum_;
}

}  // namespace pbrtmedia
