// SPDX-License-Identifier: BSD-2-Clause
#include "main/derivative.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "image/codecs.h"
#include "media/medium.h"
#include "render/difference_integrator.h"
#include "scene/param_text.h"
#include "scene/parser.h"

namespace pbrtmedia {
namespace {

[[noreturn]] void refuse(const std::string& variable, const std::string& why) {
  throw SceneError({}, "--derivative " + variable + ": " + why);
}

template <class Number>
std::string shortest(Number value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// What derivatives cannot have, whatever their values.
void checkScene(const Construction& scene, const std::string& variable) {
  if (!scene.film->layers().isEmpty())
    refuse(variable, "layers (" + scene.film->layers().text() + ") are of one image; leave them out");
  const std::optional<ImageFormat> format = formatByExtension(scene.outfile);
  if (format && isSrgbEncoded(*format)) {
    refuse(variable,
           "the image has negative values, which \"" + scene.outfile.string() +
               "\" would lose; write an .exr or .pfm file, and show it by imgtool convert --signed");
  }
}

/// What of the command line is of one scene alone.
void checkOptions(const Options& options) {
  const std::string& variable = options.derivative->variable;
  if (options.png)
    refuse(variable, "a PNG has no negative values; show the image by imgtool convert --signed");
  for (const auto& scene : options.scenes) {
    if (scene == "-") refuse(variable, "standard input can be read once only; name a file");
  }
}

bool haveSameFilm(const Film& a, const Film& b) {
  const Film::Settings &s = a.settings(), &t = b.settings();
  return a.pixelBounds() == b.pixelBounds() && a.sampleBounds() == b.sampleBounds() &&
         s.resolution == t.resolution && s.scale == t.scale && s.maxSampleLuminance == t.maxSampleLuminance;
}

}  // namespace

DerivativeScenes::DerivativeScenes(Construction& scene, const DerivativeOptions& options, Build build)
    : scene_(scene), value_(options.difference.value), variable_(options.variable), build_(std::move(build)) {
  checkScene(scene, variable_);
  integrator_ = std::move(scene.integrator);
  film_ = std::make_unique<Film>(*scene.film);
  scene.film->keepNegatives();
  try {
    auto derivative = std::make_unique<DifferenceIntegrator>(
        *integrator_, *this, DifferenceSchedule(options.difference), options.samplesPerPass);
    samplesPerPass_ = derivative->samplesPerPass(scene.sampler->samplesPerPixel());
    scene.integrator = std::move(derivative);
  } catch (const SceneError& e) {
    refuse(variable_, e.what());
  }
}

DerivativeScenes::~DerivativeScenes() = default;

void DerivativeScenes::keep(std::span<const double> values) {
  std::erase_if(others_, [&](const auto& other) {
    return std::find(values.begin(), values.end(), other.first) == values.end();
  });
}

SceneFamily::Member DerivativeScenes::at(double value) {
  if (value == value_) return {*scene_.camera, *scene_.sampler, *integrator_, *film_};
  auto found = others_.find(value);
  if (found == others_.end()) {
    Construction other = build_(value);
    check(other, value);
    ++built_;
    found = others_.emplace(value, std::move(other)).first;
  }
  const Construction& other = found->second;
  return {*other.camera, *other.sampler, *other.integrator, *other.film};
}

void DerivativeScenes::check(const Construction& other, double value) const {
  if (haveSameFilm(*film_, *other.film) && scene_.pixelBounds == other.pixelBounds &&
      scene_.sampler->samplesPerPixel() == other.sampler->samplesPerPixel() &&
      other.integrator->typeName() == integrator_->typeName())
    return;
  refuse(variable_, "at " + variable_ + " = " + shortest(static_cast<float>(value)) +
                        " the film, the number of samples or the integrator is another than at " +
                        shortest(static_cast<float>(value_)) +
                        "; derivatives are by what light meets in the scene");
}

std::string exactText(double value) { return shortest(value); }

Options atItsValue(const Options& options) {
  if (!options.derivative) return options;
  checkOptions(options);
  const std::string& variable = options.derivative->variable;
  Diagnostics unseen;  // said again when the scene is read to be rendered
  unseen.strict = options.strict;
  Variables given = options.variables, variables;
  parseParams(options.mediumParams, "--mediumparams", given, unseen);
  parseFiles(options.scenes, unseen, {.variables = given, .variablesAfter = &variables});
  if (unseen.hasErrors()) return options;
  const std::vector<std::string_view> names = variables.names();
  if (std::find(names.begin(), names.end(), variable) == names.end())
    refuse(variable, "the scene has no such variable" + suggestion(variable, names));
  if (!variables.isUsed(variable)) refuse(variable, "nothing in the scene uses $" + variable);
  const std::optional<double> value = variables.number(variable);
  if (!value) refuse(variable, "the value of $" + variable + " is not one number");
  Options exact = options;
  const auto single = static_cast<double>(static_cast<float>(*value));
  exact.derivative->difference.value = single;
  exact.variables.set(variable, exactText(single));
  return exact;
}

std::string describeStandstill(const Image& derivative, const DerivativeOptions& options) {
  const std::vector<float>& data = derivative.data();
  if (std::any_of(data.begin(), data.end(), [](float value) { return value != 0; })) return {};
  return "pbrt: warning: the derivative is 0 everywhere: nothing that is seen changes with $" +
         options.variable + " by a step of " + shortest(options.difference.step) +
         ", or where it stands it is a whole number, which has no derivative\n";
}

std::string describe(const DerivativeOptions& options, int samplesPerPass) {
  using Difference = DifferenceSchedule::Difference;
  using Debias = DifferenceSchedule::Debias;
  const DifferenceSchedule::Params& p = options.difference;
  std::string text = "d/d" + options.variable + " at " + options.variable + " = " +
                     shortest(static_cast<float>(p.value)) +
                     (p.difference == Difference::Forward ? ", forward" : ", central") +
                     " differences of step " + shortest(p.step) + ", debias ";
  if (p.debias == Debias::None) return text + "none";
  text += p.debias == Debias::Single ? "single" : "progressive, decay " + shortest(p.decay);
  return text + ", " + std::to_string(samplesPerPass) +
         (samplesPerPass == 1 ? " sample a pass" : " samples a pass");
}

}  // namespace pbrtmedia
