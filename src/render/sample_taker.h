// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "base/statistics.h"
#include "cameras/camera.h"
#include "film/film.h"
#include "film/sample_pass.h"
#include "film/side_images.h"
#include "film/splat_buffer.h"
#include "render/pass_report.h"
#include "render/render_options.h"
#include "render/sampling_integrator.h"
#include "world/medium_mismatch.h"

namespace pbrtmedia {

/// What one sample may tell besides its radiance; null or empty where nobody asks.
struct SampleOutput {
  MismatchLog* mismatches = nullptr;
  Point2f* film = nullptr;
  SplatBuffer* splats = nullptr;
  LayerSample layers{};
  std::span<SplatBuffer> sides{};  ///< by Integrator::sideImages
  TileMemory* memory = nullptr;    ///< of the integrator; null: the sample gets one for itself
};

/// One sample, as every render takes it: a pure function of seed, pixel and sample index. Radiance before the
/// film admits it.
Rgb renderSample(const Camera& camera, Sampler& sampler, const SamplingIntegrator& integrator, Point2i pixel,
                 std::int64_t sample, std::int64_t samplesPerPixel, std::uint64_t seed,
                 RenderCounters& counters, const SampleOutput& output = {});

/// Takes samples on one thread and puts them where they belong: radiance and layers into the pass, what
/// happened into the report of a unit of work, splats into a buffer.
class SampleTaker {
 public:
  /// All but the sampler, which is cloned, must outlive the object.
  SampleTaker(const Camera& camera, const Sampler& sampler, const SamplingIntegrator& integrator,
              const Film& film, const RenderOptions& options, std::int64_t samplesPerPixel);

  /// `slot`: of the pass. `splats`: null where the integrator makes none; `sides`: a buffer for each of
  /// Integrator::sideImages, or none.
  void take(Point2i pixel, std::int64_t index, int slot, SamplePass& pass, UnitReport& report,
            SplatBuffer* splats, std::span<SplatBuffer> sides = {});

  /// Density look-ups for what its samples share.
  std::uint64_t sharedLookups() const { return memory_ ? memory_->lookups() : 0; }

 private:
  /// Whether the film takes it; a value that it does not take is black and noted, with its cause.
  bool admit(Rgb& radiance, Point2i pixel, std::int64_t index, UnitReport& report) const;

  const Camera& camera_;
  std::unique_ptr<Sampler> sampler_;
  const SamplingIntegrator& integrator_;
  const Film& film_;
  const RenderOptions& options_;
  std::int64_t samplesPerPixel_;
  std::unique_ptr<TileMemory> memory_;
};

}  // namespace pbrtmedia
