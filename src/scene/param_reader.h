// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/entity.h"

namespace pbrtmedia {

/// An interval a number must lie in.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool openMin = false, openMax = false;

  static constexpr Range positive() { return above(0); }
  static constexpr Range nonNegative() { return atLeast(0); }
  static constexpr Range above(double lo) {
    return {lo, std::numeric_limits<double>::infinity(), true, false};
  }
  static constexpr Range atLeast(double lo) {
    return {lo, std::numeric_limits<double>::infinity(), false, false};
  }
  static constexpr Range closed(double lo, double hi) { return {lo, hi, false, false}; }
  static constexpr Range open(double lo, double hi) { return {lo, hi, true, true}; }

  constexpr bool contains(double x) const {
    return (openMin ? x > min : x >= min) && (openMax ? x < max : x <= max);
  }
  std::string toString() const;  ///< "> 0", ">= 1", "in [0, 1]", "in (-1, 1)"
};

/// Reads the parameters of one entity by name and kind. Every question is remembered, so that what nobody
/// asked for can be reported with the names that would have been right. Problems go to the diagnostics with
/// the place of the value, and the fallback is returned: never an exception, so that all problems of a scene
/// are shown together. One reader may be handed to several consumers (a shape and its material).
/// Entity and diagnostics must outlive it.
class ParamReader {
 public:
  /// `context` starts the messages: `medium "smoke"`, `Shape "sphere"`.
  ParamReader(Entity& entity, Diagnostics& diagnostics, std::string context);

  const Entity& entity() const { return entity_; }
  const std::string& context() const { return context_; }
  Diagnostics& diagnostics() const { return diagnostics_; }

  /// The parameters that PBRT-v3 has here; without this call, all. What does not fit any other (its type, how
  /// many values, a word for a number) is an error, never a fallback: nothing of ours is guessed.
  void setPbrtNames(std::vector<std::string_view> names) { pbrtNames_ = std::move(names); }

  // Scalars: exactly one element, else a warning (--strict: an error) and the fallback, as in PBRT-v3.
  // A number outside `range` is always an error.
  float findFloat(std::string_view name, float fallback, Range range = {});
  int findInt(std::string_view name, int fallback, Range range = {});
  bool findBool(std::string_view name, bool fallback);
  std::string findString(std::string_view name, std::string fallback);
  Point3f findPoint3(std::string_view name, Point3f fallback);
  Vector3f findVector3(std::string_view name, Vector3f fallback);
  /// `range` holds for each channel.
  Rgb findSpectrum(std::string_view name, Rgb fallback, Range range = {});

  // The same where absence means something.
  std::optional<float> optionalFloat(std::string_view name, Range range = {});
  std::optional<int> optionalInt(std::string_view name, Range range = {});
  std::optional<bool> optionalBool(std::string_view name);
  std::optional<std::string> optionalString(std::string_view name);
  /// The name in a `"texture name" "…"` entry.
  std::optional<std::string> findTextureName(std::string_view name);

  // Arrays: empty when absent. The spans live as long as the entity and until the array is taken.
  std::span<const int> ints(std::string_view name);
  std::span<const float> floats(std::string_view name);
  std::span<const std::string> strings(std::string_view name);
  // The same moved out without a copy; the entry stays, empty.
  std::vector<int> takeInts(std::string_view name);
  std::vector<float> takeFloats(std::string_view name);
  std::vector<Point2f> takePoint2s(std::string_view name);
  std::vector<Point3f> takePoint3s(std::string_view name);
  std::vector<Vector3f> takeVector3s(std::string_view name);
  std::vector<Normal3f> takeNormals(std::string_view name);

  /// The entry itself, for size and places; marks it used.
  const Param* find(ParamKind kind, std::string_view name);
  bool has(ParamKind kind, std::string_view name) { return find(kind, name) != nullptr; }

  /// Index into `choices` of a string parameter of PBRT-v3's. An unknown word is a warning (--strict: an
  /// error) listing the choices and gives the fallback.
  std::size_t findChoice(std::string_view name, std::span<const std::string_view> choices,
                         std::size_t fallback);
  /// An existing input file named by a string parameter. Nothing when absent, empty or missing; a missing one
  /// is an error, or tolerated where PBRT-v3 renders without it: then `consequence` says how. Found only
  /// beside the including file: a warning.
  std::optional<std::filesystem::path> findInputFile(std::string_view name,
                                                     std::string_view consequence = {});

  /// Where the parameter stands (its first value), or the directive when it is absent.
  SourceLocation locationOf(ParamKind kind, std::string_view name) const;
  /// An error at the parameter: `context: parameter "name": message`.
  void error(ParamKind kind, std::string_view name, const std::string& message);
  /// An error at the directive: `context: message`.
  void error(const std::string& message);

  /// A warning (--strict: an error) for each entry nobody asked for, with the kind that was asked for under
  /// that name, or the nearest names. Of parameters of our own that were asked for: an error for each that
  /// cannot be taken as it is written.
  void reportUnused();

 private:
  bool isAsked(std::string_view name) const;
  bool isOurs(std::string_view name) const;
  void reportOursMisread();
  template <class T>
  const T* scalar(ParamKind kind, std::string_view name);
  template <class T>
  std::optional<T> number(ParamKind kind, std::string_view name, Range range);
  template <class T>
  std::span<const T> view(ParamKind kind, std::string_view name);
  template <class T>
  std::vector<T> take(ParamKind kind, std::string_view name);

  Entity& entity_;
  Diagnostics& diagnostics_;
  std::string context_;
  std::vector<std::pair<ParamKind, std::string>> asked_;
  std::optional<std::vector<std::string_view>> pbrtNames_;
};

}  // namespace pbrtmedia
