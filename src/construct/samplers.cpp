// SPDX-License-Identifier: BSD-2-Clause
#include "construct/samplers.h"

#include <array>
#include <cmath>
#include <optional>

#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "samplers/halton.h"
#include "samplers/max_min_dist.h"
#include "samplers/random.h"
#include "samplers/sobol.h"
#include "samplers/stratified.h"
#include "samplers/zero_two.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

using ReadSampler = std::unique_ptr<Sampler> (*)(ParamReader&, const ConstructOptions&);

/// --spp, else 1 for --quick, else "pixelsamples".
std::int64_t readPixelSamples(ParamReader& in, const ConstructOptions& options, std::int64_t fallback,
                              bool quickIsOne = true) {
  const std::int64_t asked = findIntWithin(in, "pixelsamples", static_cast<int>(fallback), Range::atLeast(1));
  if (options.samplesPerPixel) return *options.samplesPerPixel;
  return options.quick && quickIsOne ? 1 : asked;
}

int readDimensions(ParamReader& in) { return findIntWithin(in, "dimensions", 4, Range::closed(0, 1 << 16)); }

std::unique_ptr<Sampler> readHalton(ParamReader& in, const ConstructOptions& options) {
  HaltonSampler::Params p;
  p.pixelSamples = readPixelSamples(in, options, p.pixelSamples);
  p.samplePixelCentre = in.findBool("samplepixelcenter", p.samplePixelCentre);
  p.seed = options.seed;
  return std::make_unique<HaltonSampler>(p);
}

std::unique_ptr<Sampler> readRandom(ParamReader& in, const ConstructOptions& options) {
  RandomSampler::Params p;
  p.pixelSamples = readPixelSamples(in, options, p.pixelSamples, /*quickIsOne=*/false);
  p.seed = options.seed;
  return std::make_unique<RandomSampler>(p);
}

std::unique_ptr<Sampler> readSobol(ParamReader& in, const ConstructOptions& options) {
  SobolSampler::Params p;
  p.pixelSamples = readPixelSamples(in, options, p.pixelSamples);
  p.seed = options.seed;
  return std::make_unique<SobolSampler>(p);
}

std::unique_ptr<Sampler> readZeroTwo(ParamReader& in, const ConstructOptions& options) {
  ZeroTwoSampler::Params p;
  p.pixelSamples = readPixelSamples(in, options, p.pixelSamples);
  p.dimensions = readDimensions(in);
  p.seed = options.seed;
  return std::make_unique<ZeroTwoSampler>(p);
}

std::unique_ptr<Sampler> readMaxMinDist(ParamReader& in, const ConstructOptions& options) {
  MaxMinDistSampler::Params p;
  p.pixelSamples = readPixelSamples(in, options, p.pixelSamples);
  p.dimensions = readDimensions(in);
  p.seed = options.seed;
  return std::make_unique<MaxMinDistSampler>(p);
}

std::unique_ptr<Sampler> readStratified(ParamReader& in, const ConstructOptions& options) {
  StratifiedSampler::Params p;
  const Range range = Range::closed(1, 1 << 15);
  p.xSamples = findIntWithin(in, "xsamples", p.xSamples, range);
  p.ySamples = findIntWithin(in, "ysamples", p.ySamples, range);
  p.jitter = in.findBool("jitter", p.jitter);
  p.dimensions = readDimensions(in);
  p.seed = options.seed;
  if (options.quick) p.xSamples = p.ySamples = 1;
  if (options.samplesPerPixel) {  // the factors nearest to a square
    auto x = static_cast<std::int64_t>(std::sqrt(static_cast<double>(*options.samplesPerPixel)));
    while (*options.samplesPerPixel % x != 0) --x;
    const std::int64_t y = *options.samplesPerPixel / x;
    if (y > range.max) {
      in.error("--spp " + std::to_string(*options.samplesPerPixel) + " needs a grid of " + std::to_string(x) +
               " x " + std::to_string(y) + " strata, expected at most " + std::to_string(1 << 15) +
               " per axis");
    } else {
      p.xSamples = static_cast<int>(x);
      p.ySamples = static_cast<int>(y);
    }
  }
  return std::make_unique<StratifiedSampler>(p);
}

constexpr std::array<Plugin<ReadSampler>, 7> kSamplers = {{{"halton", readHalton},
                                                           {"sobol", readSobol},
                                                           {"02sequence", readZeroTwo},
                                                           {"lowdiscrepancy", readZeroTwo},
                                                           {"maxmindist", readMaxMinDist},
                                                           {"stratified", readStratified},
                                                           {"random", readRandom}}};

void warnIfRounded(const ParamReader& in, const ConstructOptions& options, std::int64_t taken,
                   Diagnostics& diagnostics) {
  const Param* given = in.entity().params.find(ParamKind::Integer, "pixelsamples");
  std::optional<std::int64_t> asked = options.samplesPerPixel;
  if (!asked && !options.quick && given != nullptr) {
    const auto& counts = std::get<std::vector<int>>(given->values);
    if (counts.size() == 1) asked = counts.front();
  }
  if (!asked || *asked < 1 || *asked == taken) return;
  diagnostics.warning(in.locationOf(ParamKind::Integer, "pixelsamples"),
                      in.context() + ": " + std::to_string(*asked) + " samples per pixel are rounded up to " +
                          std::to_string(taken) + ", a power of two");
}

}  // namespace

std::unique_ptr<Sampler> readSampler(SceneDescription& scene, const ConstructOptions& options,
                                     Diagnostics& diagnostics) {
  Entity& entity = scene.sampler;
  if (!entity.given) entity.type = "halton";
  const auto* plugin = findPlugin<ReadSampler>(kSamplers, entity, "Sampler", "", diagnostics);
  if (plugin == nullptr) return nullptr;
  ParamReader in(entity, diagnostics, "Sampler \"" + entity.type + "\"");
  const std::size_t before = diagnostics.errorCount();
  std::unique_ptr<Sampler> sampler;
  try {
    sampler = builtAt(entity.location, in.context(), [&] { return plugin->read(in, options); });
  } catch (const SceneError& e) {
    if (diagnostics.errorCount() == before) diagnostics.add(e);
  }
  if (sampler != nullptr && diagnostics.errorCount() == before) {
    warnIfRounded(in, options, sampler->samplesPerPixel(), diagnostics);
  }
  in.reportUnused();
  return sampler;
}

}  // namespace pbrtmedia
