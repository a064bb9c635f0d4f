// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/light_tree.h"

#include <glog/logging.h>

#include <array>
#include <numbers>
#include <numeric>

#include "base/bounds.h"

namespace pbrtmedia {
namespace {

constexpr double kPiD = std::numbers::pi;

/// Directions within `spread` of `axis`.
struct Cone {
  Vec3d axis{0, 0, 1};
  double spread = -1;  ///< below 0: none
  double fade = 0;

  double measure() const;
};

/// Both of them, and what is between.
Cone enclosing(const Cone& a, const Cone& b) {
  if (a.spread < 0) return b;
  if (b.spread < 0) return a;
  const Cone& wide = a.spread >= b.spread ? a : b;
  const Cone& slim = a.spread >= b.spread ? b : a;
  const double fade = std::max(a.fade, b.fade);
  const double between = std::acos(std::clamp(dot(wide.axis, slim.axis), -1.0, 1.0));
  if (std::min(between + slim.spread, kPiD) <= wide.spread) return {wide.axis, wide.spread, fade};
  const double spread = (wide.spread + between + slim.spread) / 2;
  if (spread >= kPiD) return {wide.axis, kPiD, fade};
  // The axis of the wide cone, turned toward the other.
  const double turn = spread - wide.spread;
  const Vec3d across = slim.axis - dot(slim.axis, wide.axis) * wide.axis;
  const double size = length(across);
  if (!(size > 1e-9)) return {wide.axis, kPiD, fade};
  return {normalize(std::cos(turn) * wide.axis + (std::sin(turn) / size) * across), spread, fade};
}

/// Solid angle that the cone shines into, weighted by the cosine of the fading part: M_Omega of Conty Estevez
/// & Kulla 2018, section 4.4.
double Cone::measure() const {
  if (spread < 0) return 0;
  const double reach = std::min(spread + fade, kPiD), sine = std::sin(spread), cosine = std::cos(spread);
  return 2 * kPiD * (1 - cosine) +
         kPiD / 2 * (2 * reach * sine - std::cos(spread - 2 * reach) - 2 * spread * sine + cosine);
}

/// Of a set of lights.
struct Sum {
  Bounds3f bounds;
  Cone cone;
  double intensity = 0;

  void add(const Sum& o) {
    bounds.expand(o.bounds);
    cone = enclosing(cone, o.cone);
    intensity += o.intensity;
  }
  /// What it costs to have them in one node. Of points on a line or plane no side vanishes.
  double cost(double leastExtent) const {
    if (bounds.isEmpty()) return 0;
    const Vec3d d = Vec3d(bounds.diagonal());
    const double x = std::max(d.x, leastExtent), y = std::max(d.y, leastExtent),
                 z = std::max(d.z, leastExtent);
    return intensity * cone.measure() * (x * y + y * z + z * x);
  }
};

Sum sumOf(const LightTree::Source& s) {
  const Vec3d axis(s.extent.axis);
  return {
      s.extent.bounds,
      {axis, std::clamp(static_cast<double>(s.extent.spread), 0.0, kPiD), static_cast<double>(s.extent.fade)},
      s.intensity};
}

}  // namespace

/// Splits ranges of `order_` until they are single lights.
class LightTree::Builder {
 public:
  Builder(std::span<const Source> sources, LightTree& tree) : tree_(tree), order_(sources.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    for (const Source& s : sources) {
      sums_.push_back(sumOf(s));
      centres_.push_back(Vec3d(s.extent.bounds.centre()));
    }
  }

  void build() {
    // By hand, as a chain of lights may be deep.
    struct Task {
      std::size_t begin, end;
      std::uint32_t parent;
      bool isSecond;
    };
    std::vector<Task> tasks{{0, order_.size(), 0, false}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      const auto number = static_cast<std::uint32_t>(tree_.nodes_.size());
      if (task.isSecond) tree_.nodes_[task.parent].right = number;
      Sum all;
      for (std::size_t i = task.begin; i < task.end; ++i) all.add(sums_[order_[i]]);
      tree_.nodes_.push_back(nodeOf(all, task.parent));
      if (task.end - task.begin == 1) {
        tree_.nodes_[number].source = order_[task.begin];
        tree_.leaves_[order_[task.begin]] = number;
        continue;
      }
      const std::size_t middle = split(task.begin, task.end, all);
      tasks.push_back({middle, task.end, number, true});
      tasks.push_back({task.begin, middle, number, false});
    }
  }

 private:
  static constexpr std::size_t kBins = 12;

  static Node nodeOf(const Sum& s, std::uint32_t parent) {
    Node node{};
    node.centre = s.bounds.centre();
    node.radius = static_cast<float>(length(Vec3d(s.bounds.diagonal())) / 2);
    node.axis = Vector3f(s.cone.axis);
    node.cosSpread = static_cast<float>(std::cos(s.cone.spread));
    node.sinSpread = static_cast<float>(std::sin(s.cone.spread));
    node.cosFade = static_cast<float>(std::cos(s.cone.fade));
    node.intensity = static_cast<float>(s.intensity);
    node.parent = parent;
    return node;
  }

  /// Brings the lights of one side before those of the other; where the second begins.
  std::size_t split(std::size_t begin, std::size_t end, const Sum& all) {
    Bounds3d centres;
    for (std::size_t i = begin; i < end; ++i) centres.expand(centres_[order_[i]]);
    const Vec3d extent = centres.diagonal();
    const double longest = std::max({extent.x, extent.y, extent.z});
    const std::size_t half = begin + (end - begin) / 2;
    if (!(longest > 0)) return half;  // all in one place
    const double least = 1e-3 * length(Vec3d(all.bounds.diagonal()));
    double best = std::numeric_limits<double>::infinity();
    std::size_t bestAxis = 3, bestBin = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(extent[axis] > 0)) continue;
      std::array<Sum, kBins> bins;
      for (std::size_t i = begin; i < end; ++i) bins[binOf(order_[i], axis, centres)].add(sums_[order_[i]]);
      std::array<double, kBins> above{};
      Sum sum;
      for (std::size_t b = kBins - 1; b > 0; --b) {
        sum.add(bins[b]);
        above[b] = sum.cost(least);
      }
      sum = {};
      for (std::size_t b = 1; b < kBins; ++b) {
        sum.add(bins[b - 1]);
        if (sum.bounds.isEmpty() || !(above[b] > 0)) continue;
        // Long thin parts are worse than their surface says.
        const double cost = longest / extent[axis] * (sum.cost(least) + above[b]);
        if (cost < best) best = cost, bestAxis = axis, bestBin = b;
      }
    }
    if (bestAxis == 3) return half;
    const auto middle =
        std::stable_partition(order_.begin() + static_cast<std::ptrdiff_t>(begin),
                              order_.begin() + static_cast<std::ptrdiff_t>(end),
                              [&](std::uint32_t i) { return binOf(i, bestAxis, centres) < bestBin; });
    const auto place = static_cast<std::size_t>(middle - order_.begin());
    return place == begin || place == end ? half : place;
  }

  std::size_t binOf(std::uint32_t light, std::size_t axis, const Bounds3d& centres) const {
    const double x = (centres_[light][axis] - centres.min[axis]) / (centres.max[axis] - centres.min[axis]);
    return std::min(static_cast<std::size_t>(x * kBins), kBins - 1);
  }

  LightTree& tree_;
  std::vector<std::uint32_t> order_;
  std::vector<Sum> sums_;
  std::vector<Vec3d> centres_;
};

LightTree::LightTree(std::span<const Source> sources) : leaves_(sources.size()) {
  if (sources.empty()) return;
  for (const Source& s : sources) CHECK(!s.extent.bounds.isEmpty()) << "a light of a tree has a place";
  nodes_.reserve(2 * sources.size() - 1);
  Builder(sources, *this).build();
}

}  // namespace pbrtmedia
