// SPDX-License-Identifier: BSD-2-Clause
// The part of DescriptionBuilder that keeps the transformation in force.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/description_builder.h"

namespace pbrtmedia {
namespace {

constexpr Matrix4 kNowhere{{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}};

bool isFinite(const Matrix4& m) {
  return std::all_of(m.m.begin(), m.m.end(), [](const auto& row) {
    return std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
  });
}

/// PBRT-v3 writes matrices column by column.
Matrix4 columnMajor(const std::array<double, 16>& n) {
  Matrix4 m;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) m.m[row][column] = n[4 * column + row];
  }
  return m;
}

}  // namespace

void DescriptionBuilder::transformTimes(const Statement& s) {
  const double start = s.numbers[0];
  double end = s.numbers[1];
  if (!std::isfinite(start) || !std::isfinite(end))
    throw SceneError(s.at, "TransformTimes: found a time that is not finite");
  if (end < start) {
    diagnostics_.tolerated(
        s.at,
        "TransformTimes: the end lies before the start; as in PBRT-v3 everything jumps from "
        "its start to its end behind the start time");
    end = start;
  }
  scene_.transformStartTime = start;
  scene_.transformEndTime = end;
}

void DescriptionBuilder::applyTransform(const Statement& s) {
  const auto& n = s.numbers;
  const auto given = n.begin() + s.info->numbers;
  if (!std::all_of(n.begin(), given, [](double x) { return std::isfinite(x); }))
    return transformBy(s, Transform(kNowhere));
  switch (s.info->id) {
    case Directive::Identity: {
      TransformPair next = *state_.ctm;
      if (state_.startActive) next.start = {};
      if (state_.endActive) next.end = {};
      return setCtm(s, next);
    }
    case Directive::Translate:
      return transformBy(s, Transform::translate({n[0], n[1], n[2]}));
    case Directive::Scale:
      return transformBy(s, Transform::scale(n[0], n[1], n[2]));
    case Directive::Rotate: {
      const double largest = std::max({std::abs(n[1]), std::abs(n[2]), std::abs(n[3])});
      if (largest > 0) return transformBy(s, Transform::rotate(n[0], Vec3d(n[1], n[2], n[3]) / largest));
      return diagnostics_.tolerated(s.at,
                                    "Rotate: the axis has length 0; nothing is turned, while PBRT-v3 shows "
                                    "nothing of what follows; leave it out, or give an axis");
    }
    case Directive::LookAt:
      return lookAt(s);
    case Directive::ConcatTransform:
      return transformBy(s, Transform(columnMajor(n)));
    case Directive::Transform: {
      const Transform t(columnMajor(n));
      TransformPair next = *state_.ctm;
      if (state_.startActive) next.start = t;
      if (state_.endActive) next.end = t;
      return setCtm(s, next);
    }
    case Directive::CoordinateSystem:
      coordinateSystems_[s.strings[0].text] = state_.ctm;
      return;
    case Directive::CoordSysTransform:
      return coordSysTransform(s);
    default:
      return activeTransform(s);
  }
}

void DescriptionBuilder::transformBy(const Statement& s, const Transform& t) {
  TransformPair next = *state_.ctm;
  if (state_.startActive) next.start = next.start * t;
  if (state_.endActive) next.end = next.end * t;
  setCtm(s, next);
}

void DescriptionBuilder::lookAt(const Statement& s) {
  const auto& n = s.numbers;
  const Vec3d eye{n[0], n[1], n[2]}, look{n[3], n[4], n[5]}, up{n[6], n[7], n[8]};
  if (const auto view = Transform::lookAt(eye, look, up)) return transformBy(s, *view);
  if (eye == look || up == Vec3d{}) {
    return diagnostics_.tolerated(
        s.at, std::string("LookAt: ") +
                  (eye == look ? "eye and target coincide" : "the up vector has length 0") +
                  "; it is ignored, while PBRT-v3 shows nothing of what follows");
  }
  diagnostics_.tolerated(s.at, "LookAt: the up vector is parallel to the view; it is ignored, as in PBRT-v3");
}

/// A CTM without inverse is kept, as in PBRT-v3, and what stands under it is not seen. One that is not finite
/// becomes one that maps everything to nowhere.
void DescriptionBuilder::setCtm(const Statement& s, TransformPair next) {
  const char* problem = nullptr;
  for (Transform* t : {&next.start, &next.end}) {
    const bool finite = isFinite(t->matrix()) && isFinite(t->inverseMatrix());
    if (!finite) *t = Transform(kNowhere);
    if (problem == nullptr && t->isSingular()) problem = "the matrix has no inverse";
    if (!finite) problem = "the transformation exceeds the range of numbers";
  }
  const auto given = s.numbers.begin() + s.info->numbers;
  if (!std::all_of(s.numbers.begin(), given, [](double x) { return std::isfinite(x); }))
    problem = "found a number that is not finite";
  const bool wasOutOfSight = isOutOfSight();
  state_.ctm = std::make_shared<const TransformPair>(next);
  if (problem == nullptr || wasOutOfSight) return;
  diagnostics_.tolerated(s.at,
                         std::string(s.info->name) + ": " + problem +
                             "; what stands under it is not seen, as in PBRT-v3 (meshes that it presses "
                             "flat are)");
}

bool DescriptionBuilder::isOutOfSight() const {
  return state_.ctm->start.isSingular() || state_.ctm->end.isSingular();
}

void DescriptionBuilder::coordSysTransform(const Statement& s) {
  const auto it = coordinateSystems_.find(s.strings[0].text);
  if (it != coordinateSystems_.end()) {
    state_.ctm = it->second;
    return;
  }
  diagnostics_.tolerated(s.strings[0].at,
                         "unknown coordinate system " + quotedName(s.strings[0].text) +
                             ": the transformation in force stays, as in PBRT-v3" +
                             suggestFrom(s.strings[0].text, [&] { return keysOf(coordinateSystems_); }));
}

void DescriptionBuilder::activeTransform(const Statement& s) {
  const bool all = s.word == "All";
  if (!all && s.word != "StartTime" && s.word != "EndTime") {
    const std::array<std::string_view, 3> known{"All", "StartTime", "EndTime"};
    throw SceneError(s.wordAt,
                     "ActiveTransform: unknown selection " + shown(s.word) + suggestion(s.word, known));
  }
  state_.startActive = all || s.word == "StartTime";
  state_.endActive = all || s.word == "EndTime";
}

}  // namespace pbrtmedia
