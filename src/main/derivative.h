// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "construct/construct.h"
#include "construct/scene_identity.h"
#include "main/options.h"
#include "render/scene_family.h"

namespace pbrtmedia {

/// The scenes of `--derivative`: that of a world at the value of the variable, and others at values near it.
class DerivativeScenes final : public SceneFamily {
 public:
  /// Builds the scene at a value. Throws SceneError, Interrupted.
  using Build = std::function<Construction(double value)>;

  /// Makes the integrator of `scene`, the one at `value`, the one that renders the derivative, and its film
  /// one of both signs. Throws SceneError for scenes of which there are no derivatives. `scene` must stay.
  DerivativeScenes(Construction& scene, const DerivativeOptions& options, Build build);
  ~DerivativeScenes() override;

  void keep(std::span<const double> values) override;
  Member at(double value) override;

  /// Besides that at the value itself.
  std::size_t built() const { return built_; }
  /// What passes have.
  int samplesPerPass() const { return samplesPerPass_; }

 private:
  /// Throws SceneError when it cannot be subtracted from the scene at the value.
  void check(const Construction& other, double value) const;

  const Construction& scene_;
  double value_;
  std::string variable_;
  Build build_;
  std::unique_ptr<Integrator> integrator_;  ///< of the scene at the value
  std::unique_ptr<Film> film_;              ///< the same
  std::map<double, Construction> others_;
  std::size_t built_ = 0;
  int samplesPerPass_ = 1;
};

/// The options with the variable at the value that it has in the scene, in single precision. Reads the scene
/// files where there is a derivative; what is wrong with them is left to who reads them next. Throws
/// SceneError when the scene has no such variable, does not use it, or it is no number, and for options that
/// do not go with it.
Options atItsValue(const Options& options);

/// A number as a scene can read it, to the last bit.
std::string exactText(double value);

/// A warning where the image does not change at all: mostly a parameter that is a whole number; "": it does.
std::string describeStandstill(const Image& derivative, const DerivativeOptions& options);

/// "d/dx at x = 0.5, forward differences of step 0.01, debias single, 4 samples a pass"
std::string describe(const DerivativeOptions& options, int samplesPerPass);

}  // namespace pbrtmedia
