// SPDX-License-Identifier: BSD-2-Clause
#include "render/state_stream.h"

#include <array>
#include <concepts>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "base/byte_stream.h"
#include "media/medium.h"
#include "world/scene.h"

namespace pbrtmedia {
namespace {

// What each part of a state consists of is written down once, for both directions. Structured bindings take
// all members or do not compile: a new member is a decision here.

template <class T, class Plain>
concept Is = std::same_as<std::remove_const_t<T>, Plain>;

template <class Archive, Is<RenderCounters> T>
void transfer(Archive& archive, T& counters) {
  auto& [cameraSamples, rays, shadowRays, densityLookups, nullCollisions, mediumScatterings,
         surfaceScatterings, boundViolations, worstBoundRatio, cappedEstimates, stuckPaths, mediumMismatches,
         boundaryRepairs, dropped, violation] = counters;
  archive(cameraSamples, rays, shadowRays, densityLookups, nullCollisions, mediumScatterings,
          surfaceScatterings, boundViolations, worstBoundRatio, cappedEstimates, stuckPaths, mediumMismatches,
          boundaryRepairs, dropped);
  static_cast<void>(violation);  // an example for the sample under way
}

template <class Archive, class T>
requires Is<T, Point2i>
void transfer(Archive& archive, T& pixel) { archive(pixel.x, pixel.y); }

template <class Archive, class T>
requires Is<T, Point3f>
void transfer(Archive& archive, T& p) { archive(p.x, p.y, p.z); }

template <class Archive, Is<DroppedSample> T>
void transfer(Archive& archive, T& record) {
  auto& [pixel, sample, cause] = record;
  archive(pixel, sample, cause);
}

template <class Archive, Is<MediumMismatch> T>
void transfer(Archive& archive, T& record) {
  auto& [pixel, sample, p, believed, named, boundary] = record;
  archive(pixel, sample, p, believed, named, boundary);
}

template <class Archive, Is<ViolationRecord> T>
void transfer(Archive& archive, T& record) {
  auto& [pixel, sample, violation, medium] = record;
  auto& [unset, o, d, t, density, bound] = violation;
  static_cast<void>(unset);
  archive(pixel, sample, o, d, t, density, bound, medium);
}

template <class Archive, Is<LearningProgress> T>
void transfer(Archive& archive, T& progress) {
  auto& [passes, cells, raised, visited, cut, shortfall, maximum] = progress;
  archive(passes, cells, raised, visited, cut, shortfall, maximum);
}

template <class Archive, Is<LearningRecord> T>
void transfer(Archive& archive, T& record) {
  auto& [medium, restored, warmUpPasses, warmUpBlockEdge, warmUpIsLimited, warmUpLookups, warmUp, passes,
         shortfallOfSamples, shortfall] = record;
  archive(medium, restored, warmUpPasses, warmUpBlockEdge, warmUpIsLimited, warmUpLookups, warmUp, passes,
          shortfallOfSamples, shortfall);
}

template <class Archive, Is<RenderResult> T>
void transfer(Archive& archive, T& result) {
  auto& [samplesTaken, samplesTotal, completedSamplesPerPixel, counters, seconds, cpuSeconds, passes,
         interrupted, stoppedBy, samplesAbandoned, pixelsTotal, pixelsSampled, dropped, mismatches,
         violations, learning, carried] = result;
  archive(samplesTaken, samplesTotal, completedSamplesPerPixel, counters, seconds, cpuSeconds,
          samplesAbandoned, pixelsTotal, pixelsSampled, dropped, mismatches, violations, learning, carried);
  static_cast<void>(passes);       // of one part
  static_cast<void>(interrupted);  // what goes on is not
  static_cast<void>(stoppedBy);
}

template <class Archive, Is<Film::State> T>
void transfer(Archive& archive, T& film) {
  auto& [sums, odd, layers, splats, oddSplats, splatSquares, paths, oddPaths] = film;
  archive(sums, odd, layers, splats, oddSplats, splatSquares, paths.count, paths.area, oddPaths);
}

template <class Archive, Is<LearnedBounds::State> T>
void transfer(Archive& archive, T& bounds) {
  auto& [upper, lower, most, least, progress, isRestored] = bounds;
  archive(upper, lower, most, least, progress, isRestored);
}

/// Plain records of doubles, which are moved all at once.
template <class T>
constexpr bool kIsOfDoubles = std::same_as<T, Film::Sums> || std::same_as<T, SplatSum>;

/// Boundaries are known by their number among the scene's primitives, from 1; 0: none.
std::vector<const Primitive*> numbered(const Scene& scene) {
  std::vector<const Primitive*> all;
  for (const auto& group : scene.primitiveGroups()) all.insert(all.end(), group.begin(), group.end());
  return all;
}

class Writing {
 public:
  Writing(ByteWriter& out, const Scene& scene) : out_(out), scene_(scene) {}
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (std::integral<T> || std::is_enum_v<T>) {
      out_.add(static_cast<std::uint64_t>(value));
    } else if constexpr (std::floating_point<T>) {
      out_.add(value);
    } else {
      transfer(*this, value);
    }
  }
  void put(const std::string& text) { out_.add(text); }
  template <class T, std::size_t n>
  void put(const std::array<T, n>& values) {
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    if constexpr (std::floating_point<T>) {
      out_.addArray(std::span<const T>(values));
    } else if constexpr (kIsOfDoubles<T>) {
      static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0);
      out_.addArray(std::span(reinterpret_cast<const double*>(values.data()),
                              values.size() * (sizeof(T) / sizeof(double))));
    } else {
      out_.add(static_cast<std::uint64_t>(values.size()));
      for (const T& value : values) put(value);
    }
  }
  void put(const Primitive* const& boundary) {
    std::uint64_t number = 0;
    if (boundary) {
      const std::vector<const Primitive*> all = numbered(scene_);
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i] == boundary) number = i + 1;
      }
    }
    out_.add(number);
  }

  ByteWriter& out_;
  const Scene& scene_;
};

class Reading {
 public:
  Reading(ByteReader& in, const Scene& scene) : in_(in), scene_(scene) {}
  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }

 private:
  template <class T>
  void take(T& value) {
    if constexpr (std::same_as<T, bool>) {
      value = whole(1) == 1;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(whole(static_cast<std::uint64_t>(T::kCount) - 1));
    } else if constexpr (std::integral<T>) {
      value = static_cast<T>(in_.number<std::uint64_t>());
    } else if constexpr (std::floating_point<T>) {
      value = in_.number<T>();
    } else {
      transfer(*this, value);
    }
  }
  void take(std::string& text) { text = in_.text(); }
  template <class T, std::size_t n>
  void take(std::array<T, n>& values) {
    for (T& value : values) take(value);
  }
  template <class T>
  void take(std::vector<T>& values) {
    if constexpr (std::floating_point<T>) {
      values = in_.array<T>();
    } else if constexpr (kIsOfDoubles<T>) {
      constexpr std::size_t kEach = sizeof(T) / sizeof(double);
      const std::vector<double> numbers = in_.array<double>();
      if (numbers.size() % kEach != 0) throw std::length_error("parts of sums");
      values.resize(numbers.size() / kEach);
      if (!values.empty())
        std::memcpy(static_cast<void*>(values.data()), numbers.data(), numbers.size() * sizeof(double));
    } else {
      for (std::size_t left = in_.count(1); left > 0; --left) take(values.emplace_back());
    }
  }
  void take(const Primitive*& boundary) {
    const auto number = in_.number<std::uint64_t>();
    if (number == 0) return;
    const std::vector<const Primitive*> all = numbered(scene_);
    if (number > all.size()) throw std::length_error("more boundaries than primitives");
    boundary = all[static_cast<std::size_t>(number) - 1];
  }
  std::uint64_t whole(std::uint64_t most) {
    const auto number = in_.number<std::uint64_t>();
    if (number > most) throw std::length_error("a number that is too large");
    return number;
  }

  ByteReader& in_;
  const Scene& scene_;
};

}  // namespace

void writeState(ByteWriter& out, const Scene& scene, const Film& film, const RenderResult& result) {
  Writing write(out, scene);
  write(result, film.state());
  const std::vector<Medium*> learners = scene.learners();
  out.add(static_cast<std::uint64_t>(learners.size()));
  for (Medium* learner : learners) write(learner->learnedBounds()->state());  // one at a time in memory
}

void writeResult(ByteWriter& out, const Scene& scene, const RenderResult& result) {
  Writing(out, scene)(result);
}

RenderResult readResult(ByteReader& in, const Scene& scene) {
  RenderResult result;
  Reading(in, scene)(result);
  return result;
}

void writeFilm(ByteWriter& out, const Scene& scene, const Film::State& film) { Writing(out, scene)(film); }

Film::State readFilm(ByteReader& in, const Scene& scene) {
  Film::State film;
  Reading(in, scene)(film);
  return film;
}

RenderState readState(ByteReader& in, const Scene& scene) {
  RenderState state;
  Reading(in, scene)(state.result, state.film, state.bounds);
  return state;
}

}  // namespace pbrtmedia
