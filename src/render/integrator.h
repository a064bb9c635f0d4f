// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/layers.h"
#include "film/side_images.h"

namespace pbrtmedia {

class Camera;
class Film;
class Sampler;
class Scene;
class Integrator;
struct RenderOptions;
struct RenderResult;

/// An image of a scene and its share of a sum.
struct ImageTerm {
  const Integrator& integrator;
  const Camera& camera;
  double factor;
};

/// Light transport: makes the image of a scene. Immutable after construction. Most integrators estimate
/// radiance along rays (SamplingIntegrator); others walk chains or trace photons in a loop of their own over
/// PassLoop.
class Integrator {
 public:
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual std::string_view typeName() const = 0;
  /// What is rendered. Whoever renders finds there the media whose bounds are learned (Scene::learners).
  const Scene& scene() const { return scene_; }

  /// What it can tell of the image besides colour; whoever is asked for more is to refuse. None, unless an
  /// integrator says so.
  virtual LayerMask layers() const { return {}; }

  /// Takes the samples of an image and accumulates them on the film, in passes. Every sample is a pure
  /// function of (seed, pixel, sample index), or of (seed, number of the chain), and of the passes before
  /// where bounds are learned: image, counters and records are the same for any number of threads, tile size
  /// and grouping into passes. Stopped early (time, flag, callback) it leaves the film with exactly the
  /// samples that were taken; a path that is left on its way (leaveIfAbandoned) is none.
  virtual RenderResult render(const Camera& camera, const Sampler& sampler, Film& film,
                              const RenderOptions& options) const = 0;
  /// Whether it puts something into SampleContext::splats: of a light path for each camera sample, what it
  /// brings to the image wherever it hits. A pixel is the mean of what camera rays bring plus the mean over
  /// as many splats as there are samples to a pixel of the whole image.
  virtual bool makesSplats() const { return false; }
  /// Images that it makes besides that of the film (RenderOptions::sides).
  virtual std::vector<SideImage> sideImages() const { return {}; }
  /// Why the samples of an image cannot be taken in ranges apart from each other (RenderOptions::firstSample
  /// above 0), to stand after "cannot be rendered in parts: "; empty: they can.
  virtual std::string whyInOnePiece() const { return {}; }

  // Sums of images of scenes that are almost the same, whose noise is to cancel, by integrators that render
  // in one piece. They take one of these ways, or none.

  /// Whether its samples are chosen by what they bring, so that those of several scenes can only be chosen in
  /// common (renderSum).
  virtual bool rendersSums() const { return false; }
  /// As `render`, the sum of factor times the image that the integrator of each term, of the same type,
  /// makes. `startsAgain`: this is a whole of its own, one of some so many of which the mean is wanted, not
  /// one that goes on from RenderOptions::start; nothing: it does. The film gets negative splats.
  virtual RenderResult renderSum(std::span<const ImageTerm> terms, std::optional<std::int64_t> startsAgain,
                                 const Sampler& sampler, Film& film, const RenderOptions& options) const;
  /// What RenderResult::carried is before the first pass, of so many pixels. Where there is something, passes
  /// (each of one sample of a pixel) follow from it and their number alone, so that one scene can take it
  /// from another.
  virtual std::vector<double> carriedAtStart(std::uint64_t pixels) const {
    (void)pixels;
    return {};
  }

 protected:
  explicit Integrator(const Scene& scene) : scene_(scene) {}

 private:
  const Scene& scene_;
};

}  // namespace pbrtmedia
