// SPDX-License-Identifier: BSD-2-Clause
// Any numbers as a curve: it is rejected, or every hit of rays through it is finite and within its bounds.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "base/rng.h"
#include "base/warp.h"
#include "shapes/curves.h"

namespace {

using namespace pbrtmedia;

/// Takes the input apart, zeros behind its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  template <class T>
  T take() {
    T value{};
    const std::size_t n = std::min(left_, sizeof value);
    std::memcpy(&value, data_, n);
    data_ += n;
    left_ -= n;
    return value;
  }
  bool isEmpty() const { return left_ == 0; }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

void trace(const Curves& curves) {
  const Bounds3f bounds = curves.bounds();
  Rng rng(1);
  for (int i = 0; i < 64; ++i) {
    const auto primitive =
        static_cast<std::uint32_t>(rng.uniform() * static_cast<float>(curves.primitiveCount()));
    const Bounds3f box = curves.primitiveBounds(primitive);
    Ray ray;
    ray.d = sampleUniformSphere({rng.uniform(), rng.uniform()});
    ray.o = box.centre() - box.diagonal().x * ray.d;
    const auto root = curves.intersect(primitive, ray, 0, HUGE_VAL, {});
    if (!root) continue;
    const RayHit hit{static_cast<float>(root->t), {PrimitiveId::kNone, 0, primitive}, root->uv};
    const SurfaceInteraction si = curves.interaction(hit, ray);
    if (!std::isfinite(root->t) || !isFinite(root->uv) || !isFinite(si.p) || !isFinite(si.n)) std::abort();
    const float start[] = {hit.t};
    const auto again = curves.intersect(primitive, ray, root->t, HUGE_VAL, start);
    if (again && static_cast<float>(again->t) == hit.t) std::abort();
  }
  if (!isFinite(bounds.min) || !isFinite(bounds.max)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  const auto choice = in.take<std::uint8_t>();
  Curves::Params params;
  params.type = static_cast<CurveType>(choice % 3);
  params.splitDepth = choice / 3 % 5;
  const auto basis = static_cast<CurveBasis>(choice / 16 % 2);
  const int degree = choice / 32 % 2 + 2;
  const auto width0 = in.take<float>(), width1 = in.take<float>();
  std::vector<Point3f> points;
  std::vector<Normal3f> normals;
  while (!in.isEmpty() && points.size() < 64) {
    points.push_back(in.take<Point3f>());
    if (params.type == CurveType::Ribbon) normals.push_back(in.take<Normal3f>());
  }
  normals.resize(std::min(normals.size(), curveSegmentCount(points.size(), degree, basis) + 1));
  try {
    params.addStrand(points, degree, basis, width0, width1, normals);
    for (const Curves::Segment& s : params.segments) {
      for (const Point3f& p : s.p) {
        if (!(maxComponent(abs(p)) < 1e15f)) return 0;  // Accelerator refuses what is larger than 1.8e18
      }
    }
    if (std::max(width0, width1) > 1e15f || params.segments.empty()) return 0;
    trace(Curves(std::move(params), {}));
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
