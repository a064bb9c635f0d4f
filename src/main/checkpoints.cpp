// SPDX-License-Identifier: BSD-2-Clause
#include "main/checkpoints.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "main/progress.h"
#include "render/state_stream.h"
#include "tools/build_info.h"

namespace pbrtmedia {
namespace {

namespace fs = std::filesystem;

/// Writing may take this share of the time; where it takes more, checkpoints stand farther apart than asked.
constexpr double kMostShare = 0.02;
/// Passes are kept shorter than the interval by this factor, so that a checkpoint is late by a part of it
/// only.
constexpr double kPassesPerInterval = 4;
/// Differences that a message names.
constexpr std::size_t kMostNamed = 8;

std::string hashed(std::uint64_t hash) {
  std::ostringstream text;
  text << '#' << std::hex << hash;
  return text.str();
}

std::string textOf(const Bounds2i& b) {
  std::ostringstream text;
  text << b.min.x << ' ' << b.max.x << ' ' << b.min.y << ' ' << b.max.y;
  return text.str();
}

/// All that decides the bits of an image but the number of samples and the program. Threads, tiles, limits of
/// time and names of files decide nothing.
std::vector<ImageCause> causesOf(const SceneIdentity& identity, const Construction& scene,
                                 const Options& options) {
  const Film& film = *scene.film;
  std::vector<ImageCause> causes = {{"the text of the scene", hashed(identity.text)}};
  for (const auto& [name, value] : identity.variables) causes.push_back({'$' + name, value});
  causes.push_back({"--mediumparams", identity.mediumParams});
  for (const SceneIdentity::File& file : identity.files)
    causes.push_back({"the content of \"" + file.name + '"', hashed(file.content)});
  causes.push_back({"--seed", std::to_string(options.seed)});
  std::string samples = "all";
  if (options.samples)
    samples = std::to_string(options.samples->first).append(":").append(std::to_string(options.samples->end));
  causes.push_back({"--samples", samples});
  causes.push_back({"--quick", options.quick ? "yes" : "no"});
  const Point2i size = film.settings().resolution;
  causes.push_back({"the resolution", std::to_string(size.x) + " x " + std::to_string(size.y)});
  causes.push_back({"--cropwindow", "pixels " + textOf(film.pixelBounds())});
  if (scene.pixelBounds) causes.push_back({"\"pixelbounds\"", "pixels " + textOf(*scene.pixelBounds)});
  std::string layers;
  for (const std::string& name : film.layers().channelNames()) layers += (layers.empty() ? "" : ",") + name;
  causes.push_back({"the layers", layers});
  if (!identity.derivative.empty()) causes.push_back({"--derivative", identity.derivative});
  return causes;
}

/// "--seed (1, here 2)"
std::string difference(const std::string& name, const std::string& then, const std::string& now) {
  constexpr std::size_t kMostShown = 200;
  if (then.starts_with('#') || now.starts_with('#') || then.size() + now.size() > kMostShown) return name;
  const auto shown = [](const std::string& value) { return value.empty() ? std::string("none") : value; };
  return name + " (" + shown(then) + ", here " + shown(now) + ')';
}

std::string differencesOf(const std::vector<ImageCause>& then, const std::vector<ImageCause>& now) {
  std::vector<std::string> all;
  std::map<std::string, std::string> others;
  for (const auto& [name, value] : then) others[name] = value;
  for (const auto& [name, value] : now) {
    const auto other = others.find(name);
    if (other == others.end()) {
      all.push_back(name + " (only here)");
    } else {
      if (other->second != value) all.push_back(difference(name, other->second, value));
      others.erase(other);
    }
  }
  for (const auto& [name, value] : others) all.push_back(name + " (only there)");
  std::string text;
  for (std::size_t i = 0; i < all.size() && i < kMostNamed; ++i) text += (i > 0 ? ", " : "") + all[i];
  if (all.size() > kMostNamed) text += " and " + std::to_string(all.size() - kMostNamed) + " more";
  return text;
}

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool areSame(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  // Absolute first: of a relative name without a file it would stay relative.
  const auto canonical = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  return canonical(a) == canonical(b);
}

std::string quoted(const fs::path& path) { return '"' + path.string() + '"'; }

[[noreturn]] void refuse(const std::string& message) { throw SceneError({}, message); }

}  // namespace

Checkpoints::Checkpoints(const Options& options, bool writes)
    : options_(options), writes_(writes && options.checkpoint) {
  const auto &resume = options.resume, &checkpoint = options.checkpoint;
  const bool isOneFile = resume && checkpoint && areSame(*resume, *checkpoint);
  if (checkpoint && isFile(*checkpoint) && !isOneFile) {
    refuse("--checkpoint " + quoted(*checkpoint) +
           ": there is such a file, and a render may be in it; go on with it by --resume " +
           quoted(*checkpoint) + ", or remove it");
  }
  if (writes_) removeLeftParts(*checkpoint);
  if (!resume) return;
  std::error_code ignored;
  if (isOneFile && !fs::exists(*resume, ignored)) {
    if (!options.quiet)
      std::cerr << "pbrt: note: there is no " << quoted(*resume) << " yet: starting at the beginning\n";
    return;
  }
  from_ = Checkpoint::read(*resume);
  worldsDone_ = from_->head().worldsDone;
}

std::size_t Checkpoints::firstWorld(std::size_t worlds) const {
  if (!from_) return 0;
  const std::uint64_t world = from_->head().world;
  if (world >= worlds) {
    refuse("--resume " + quoted(*options_.resume) + ": it is of world " + std::to_string(world + 1) +
           " of a scene, and here there are " + std::to_string(worlds));
  }
  return static_cast<std::size_t>(world);
}

void Checkpoints::enter(std::size_t world, const SceneIdentity& identity, const Construction& scene) {
  head_ = {};
  start_.reset();
  rendering_.reset();
  lastSaved_.reset();
  isPartial_ = false;
  problem_.clear();
  lastWrite_ = lastCost_ = 0;
  if (!from_ && !options_.checkpoint) return;
  head_.causes = causesOf(identity, scene, options_);
  head_.samplesPerPixel = static_cast<std::uint64_t>(scene.sampler->samplesPerPixel());
  head_.world = world;
  head_.worldsDone = worldsDone_;
  if (from_) restore(scene);
  from_.reset();
}

void Checkpoints::restore(const Construction& scene) {
  const CheckpointHead& then = from_->head();
  const std::string option = "--resume " + quoted(*options_.resume);
  const std::string differences = differencesOf(then.causes, head_.causes);
  if (!differences.empty()) refuse(option + ": it is of another render; what differs: " + differences);
  if (then.samplesPerPixel != head_.samplesPerPixel) {
    const std::string counts =
        std::to_string(then.samplesPerPixel) + ", here " + std::to_string(head_.samplesPerPixel);
    if (!scene.sampler->isExtensible()) {
      refuse(option + ": it is of another number of samples per pixel (" + counts + "), and sampler \"" +
             std::string(scene.sampler->typeName()) +
             "\" spreads all samples of a pixel together; render more with another --seed and average by "
             "imgtool merge");
    }
    if (then.world > 0) {
      refuse(option + ": it is of another number of samples per pixel (" + counts +
             "), and of the last of several worlds; those before it would keep the number they have");
    }
    if (then.samplesDone != then.samplesPerPixel || head_.samplesPerPixel < then.samplesDone) {
      refuse(option + ": it is of another number of samples per pixel (" + counts + "), of which " +
             std::to_string(then.samplesDone) + " are taken; only a finished render can get more of them");
    }
  }
  try {
    ByteReader in(from_->state());
    start_ = readState(in, *scene.scene);
    if (in.left() > 0) throw std::length_error("bytes left over");
  } catch (const std::length_error&) {
    refuse(option + ": the file is corrupt");
  }
  const RenderResult& result = start_->result;
  if (result.completedSamplesPerPixel < 0 ||
      static_cast<std::uint64_t>(result.completedSamplesPerPixel) != then.samplesDone ||
      then.samplesDone > head_.samplesPerPixel)
    refuse(option + ": the file is corrupt");
  if (!scene.film->hasHalves()) {
    start_->film.odd.clear();
    start_->film.oddSplats.clear();
  }
  if (scene.film->hasHalves() && start_->film.odd.empty()) {
    refuse(option +
           ": it was rendered without --error and without a --convergence of its own, and does not "
           "have the halves of the samples that these need");
  }
  if (!restoreState(*start_, *scene.scene, *scene.film))
    refuse(option + ": its film or its learned bounds are of another size");
  start_->film = {};  // which may be large
  start_->bounds = {};
  head_.parts = then.parts;
  if (!head_.parts.empty() && head_.parts.back().version != buildText() && !options_.quiet) {
    std::cerr << "pbrt: warning: " << option << ": it was written by " << head_.parts.back().version
              << "; this is " << buildText()
              << ", and the image may differ in its last digits from one that a single program made\n";
  }
}

void Checkpoints::attach(const Construction& scene, RenderOptions& loop) {
  rendering_.emplace();
  const std::int64_t first = start_ ? start_->result.completedSamplesPerPixel : loop.firstSample;
  head_.parts.push_back({first, first, {}, threadCount(), buildText()});
  if (start_) loop.start = &*start_;
  if (!writes_) return;
  loop.mostSecondsPerPass =
      std::min(loop.mostSecondsPerPass, options_.checkpointInterval / kPassesPerInterval);
  loop.afterPass = [this, &scene, then = std::move(loop.afterPass)](const PassEnd& pass) {
    const bool writes = isDue();
    if (writes) pass.bringFilm();
    if (writes && !write(scene, pass.result)) {
      std::cerr << "\npbrt: warning: " << problem_ << "; the render goes on without a checkpoint\n";
    }
    return !then || then(pass);
  };
  loop.beforePartialPass = [this, &scene, then = std::move(loop.beforePartialPass)](const PassEnd& pass) {
    isPartial_ = true;
    pass.bringFilm();
    write(scene, pass.result);
    if (then) then(pass);
  };
}

bool Checkpoints::isDue() const {
  return rendering_->seconds() - lastWrite_ >= std::max(options_.checkpointInterval, lastCost_ / kMostShare);
}

void Checkpoints::notePart(const RenderResult& result) {
  RenderPart& part = head_.parts.back();
  part.end = result.completedSamplesPerPixel;
  part.time = {result.seconds, result.cpuSeconds};
  if (start_) part.time += {-start_->result.seconds, -start_->result.cpuSeconds};
}

bool Checkpoints::write(const Construction& scene, const RenderResult& result) {
  notePart(result);
  head_.samplesDone = static_cast<std::uint64_t>(result.completedSamplesPerPixel);
  const Stopwatch writing;
  problem_.clear();
  try {
    const std::uint64_t bytes = Checkpoint::write(*options_.checkpoint, head_, [&](ByteWriter& out) {
      writeState(out, *scene.scene, *scene.film, result);
    });
    lastSaved_ = result.completedSamplesPerPixel;
    if (options_.verbose) {
      std::cerr << "  checkpoint of " << head_.samplesDone << " samples per pixel, "
                << formatCount(static_cast<double>(bytes)) << "B in " << formatDuration(writing.seconds())
                << '\n';
    }
  } catch (const std::runtime_error& e) {
    problem_ = std::string("--checkpoint: ") + e.what();
  }
  lastCost_ = writing.seconds();
  lastWrite_ = rendering_->seconds();
  return problem_.empty();
}

bool Checkpoints::finish(const Construction& scene, const RenderResult& result) {
  notePart(result);
  if (!writes_) return true;
  // The film has samples of a pass that was left inside; what stands before it is written already.
  if (!isPartial_ && lastSaved_ != result.completedSamplesPerPixel) write(scene, result);
  if (!problem_.empty()) {
    std::cerr << "pbrt: error: " << problem_ << '\n';
    return false;
  }
  if (result.interrupted && !options_.quiet) {
    std::cerr << "checkpoint " << options_.checkpoint->string() << " has " << head_.samplesDone << " of "
              << head_.samplesPerPixel << " samples per pixel; go on with --resume "
              << options_.checkpoint->string() << '\n';
  }
  return true;
}

void Checkpoints::leave(std::string statistics) { worldsDone_.push_back(std::move(statistics)); }

}  // namespace pbrtmedia
