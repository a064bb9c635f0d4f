// SPDX-License-Identifier: BSD-2-Clause
#include "render/sample_taker.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "base/hash.h"

namespace pbrtmedia {
namespace {

/// "ptrn" in ASCII: the same for patterns across the samples of a pixel.
constexpr std::uint64_t kPatternTag = 0x7074726e;
/// "path" in ASCII: keeps the Rng of samples apart from other uses of the same seed.
constexpr std::uint64_t kRngTag = 0x70617468;

DropCause causeOf(const RenderCounters& before, const RenderCounters& after) {
  for (std::size_t i = 0; i < before.dropped.size(); ++i) {
    if (after.dropped[i] != before.dropped[i]) return static_cast<DropCause>(i);
  }
  return DropCause::NotANumber;
}

/// Processor time of this thread, where somebody wants to know it: what others take from it meanwhile is none
/// of the sample's.
double secondsOf(const LayerSample& layers) {
  if (!layers.wants(Layer::Seconds)) return 0;
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Rgb renderSample(const Camera& camera, Sampler& sampler, const SamplingIntegrator& integrator, Point2i pixel,
                 std::int64_t sample, std::int64_t samplesPerPixel, std::uint64_t seed,
                 RenderCounters& counters, const SampleOutput& output) {
  sampler.start(pixel, sample);
  const CameraSample cameraSample = sampler.cameraSample(pixel);
  if (output.film) *output.film = cameraSample.film;
  ++counters.cameraSamples;
  Camera::WeightedRay weighted = camera.generateRay(cameraSample.film, cameraSample.lens, cameraSample.time);
  if (weighted.weight == 0) return {};
  weighted.ray.scaleDifferentials(1 /
                                  std::sqrt(static_cast<float>(std::max<std::int64_t>(samplesPerPixel, 1))));
  Rng rng(hashCombine(seed, static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y),
                      static_cast<std::uint64_t>(sample), kRngTag));
  const PixelSample pixelSample{hashCombine(seed, static_cast<std::uint32_t>(pixel.x),
                                            static_cast<std::uint32_t>(pixel.y), kPatternTag),
                                static_cast<std::uint64_t>(sample),
                                static_cast<std::uint64_t>(std::max<std::int64_t>(samplesPerPixel, 0)), 0};
  const std::unique_ptr<TileMemory> own = output.memory ? nullptr : integrator.tileMemory(camera, seed);
  SampleContext context{sampler,     rng,     counters, output.mismatches, output.splats, output.layers,
                        pixelSample, nullptr, &camera};
  context.pixel = pixel;
  context.memory = output.memory ? output.memory : own.get();
  SideSplats sides(output.sides, cameraSample.film, weighted.weight);
  if (!output.sides.empty()) context.sides = &sides;
  const Rgb radiance = weighted.weight * integrator.radiance(weighted.ray, context);
  output.layers.scaleRadiance(weighted.weight);
  return radiance;
}

SampleTaker::SampleTaker(const Camera& camera, const Sampler& sampler, const SamplingIntegrator& integrator,
                         const Film& film, const RenderOptions& options, std::int64_t samplesPerPixel)
    : camera_(camera),
      sampler_(sampler.clone()),
      integrator_(integrator),
      film_(film),
      options_(options),
      samplesPerPixel_(samplesPerPixel),
      memory_(integrator.tileMemory(camera, options.seed)) {}

void SampleTaker::take(Point2i pixel, std::int64_t index, int slot, SamplePass& pass, UnitReport& report,
                       SplatBuffer* splats, std::span<SplatBuffer> sides) {
  MismatchLog log{
      pixel, index, options_.maxRecords - std::min(options_.maxRecords, report.mismatches.size()), {}};
  Point2f film;
  report.counters.violation.reset();
  const std::uint64_t lookupsBefore = report.counters.densityLookups;
  const LayerSample layers = pass.layersAt(pixel, slot);
  const double secondsBefore = secondsOf(layers);
  const std::size_t splatsBefore = splats ? splats->size() : 0;
  Rgb radiance = renderSample(camera_, *sampler_, integrator_, pixel, index, samplesPerPixel_, options_.seed,
                              report.counters,
                              {.mismatches = &log,
                               .film = &film,
                               .splats = splats,
                               .layers = layers,
                               .sides = sides,
                               .memory = memory_.get()});
  if (layers.isWanted()) {
    layers.set(Layer::Samples, 1.0f);
    layers.set(Layer::Seconds, static_cast<float>(secondsOf(layers) - secondsBefore));
    layers.set(Layer::Lookups, static_cast<float>(report.counters.densityLookups - lookupsBefore));
  }
  report.mismatches.insert(report.mismatches.end(), log.entries.begin(), log.entries.end());
  if (report.counters.violation && report.violations.size() < options_.maxRecords) {
    ViolationRecord record{pixel, index, *report.counters.violation, {}};
    record.medium = std::exchange(record.violation.medium, {});
    report.violations.push_back(std::move(record));
  }
  const float luminance = radiance.luminance();
  if (!admit(radiance, pixel, index, report)) {
    layers.drop();
  } else if (const float admitted = radiance.luminance(); layers.isWanted() && admitted != luminance) {
    layers.scaleRadiance(admitted / luminance);
  }
  if (splats) splats->removeIf(splatsBefore, [&](Rgb& value) { return !admit(value, pixel, index, report); });
  SamplePass::Sample& out = pass.at(pixel, slot);
  out.offset = {film.x - static_cast<float>(pixel.x), film.y - static_cast<float>(pixel.y)};
  out.radiance = radiance;
  out.valid = true;
  ++report.samples;
  if (index % 2 != 0) ++report.oddSamples;
}

bool SampleTaker::admit(Rgb& radiance, Point2i pixel, std::int64_t index, UnitReport& report) const {
  const RenderCounters before = report.counters;
  if (film_.admit(radiance, report.counters)) return true;
  if (report.dropped.size() < options_.maxRecords) {
    report.dropped.push_back({pixel, index, causeOf(before, report.counters)});
  }
  radiance = {};
  return false;
}

}  // namespace pbrtmedia
