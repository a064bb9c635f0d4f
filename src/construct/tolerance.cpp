// SPDX-License-Identifier: BSD-2-Clause
#include "construct/tolerance.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace pbrtmedia {
namespace {

template <class T>
std::string textOf(T value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

template <class T>
T moved(ParamReader& in, ParamKind kind, std::string_view name, T value, Range range) {
  if (range.contains(static_cast<double>(value))) return value;
  const auto taken = static_cast<T>(std::clamp(static_cast<double>(value), range.min, range.max));
  tolerate(in, kind, name,
           "found " + textOf(value) + ", expected " + range.toString() + "; taken as " + textOf(taken));
  return taken;
}

}  // namespace

std::string shownNumber(float value) { return textOf(value); }

void tolerate(ParamReader& in, ParamKind kind, std::string_view name, const std::string& message) {
  in.diagnostics().tolerated(in.locationOf(kind, name),
                             in.context() + ": parameter \"" + std::string(name) + "\": " + message);
}

void tolerate(ParamReader& in, const std::string& message) {
  in.diagnostics().tolerated(in.entity().location, in.context() + ": " + message);
}

int findIntWithin(ParamReader& in, std::string_view name, int fallback, Range range) {
  return optionalIntWithin(in, name, range).value_or(fallback);
}

float findFloatWithin(ParamReader& in, std::string_view name, float fallback, Range range) {
  const std::optional<float> found = in.optionalFloat(name);
  return found ? moved(in, ParamKind::Float, name, *found, range) : fallback;
}

std::optional<int> optionalIntWithin(ParamReader& in, std::string_view name, Range range) {
  const std::optional<int> found = in.optionalInt(name);
  if (!found) return std::nullopt;
  return moved(in, ParamKind::Integer, name, *found, range);
}

std::size_t findOwnChoice(ParamReader& in, std::string_view name, std::span<const std::string_view> choices,
                          std::size_t fallback) {
  const std::optional<std::string> word = in.optionalString(name);
  if (!word) return fallback;
  const auto it = std::find(choices.begin(), choices.end(), *word);
  if (it != choices.end()) return static_cast<std::size_t>(it - choices.begin());
  in.error(ParamKind::String, name,
           "unknown " + std::string(name) + " \"" + *word + "\"" + suggestion(*word, choices));
  return fallback;
}

std::optional<std::filesystem::path> requireFile(ParamReader& in, std::string_view name) {
  std::optional<std::filesystem::path> file = in.findInputFile(name);
  if (file) return file;
  const Param* const given = in.find(ParamKind::String, name);
  if (given == nullptr) {
    in.error("parameter \"string " + std::string(name) + "\" is missing");
  } else if (std::get<std::vector<std::string>>(given->values) == std::vector<std::string>{""}) {
    in.error(ParamKind::String, name, "the name is empty, expected a file");
  }
  return std::nullopt;
}

std::string problemOf(const SceneError& e) {
  const SourceLocation& at = e.location();
  std::string what = e.what();
  if (at.file == nullptr || (at.line == 0 && what.find(*at.file) != std::string::npos)) return what;
  return at.toString() + ": " + what;
}

Rgb nonNegative(ParamReader& in, std::string_view name, Rgb colour) {
  if (!(colour.min() < 0)) return colour;
  const Param* const given = in.find(ParamKind::Spectrum, name);
  std::ostringstream text;
  text << "has the RGB value (" << colour.r << ", " << colour.g << ", " << colour.b
       << "); its negative channels count as 0";
  if (given != nullptr && given->isConverted) {
    text << ", as the spectrum is more saturated than RGB can tell";
    in.diagnostics().warning(in.locationOf(ParamKind::Spectrum, name),
                             in.context() + ": parameter \"" + std::string(name) + "\": " + text.str());
  } else {
    // PBRT-v3's media do not emit.
    if (name != "Le") text << "; PBRT-v3 takes them as they are, so that light grows on its way";
    tolerate(in, ParamKind::Spectrum, name, text.str());
  }
  return colour.nonNegative();
}

std::string negativesMessage(std::size_t count, std::string_view first, float value) {
  std::ostringstream text;
  text << "holds " << count << (count == 1 ? " negative value" : " negative values, the first") << " at "
       << first << ": " << value << "; " << (count == 1 ? "it counts" : "they count") << " as 0";
  return text.str();
}

void clampNegatives(std::span<float> values, int nx, int ny, std::string_view what, const SourceLocation& at,
                    std::string_view context, Diagnostics& diagnostics) {
  std::size_t count = 0, first = 0;
  float found = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] < 0) || std::isinf(values[i])) continue;
    if (count++ == 0) {
      first = i;
      found = values[i];
    }
    values[i] = 0;
  }
  if (count == 0) return;
  const auto sx = static_cast<std::size_t>(nx), sy = static_cast<std::size_t>(ny);
  const std::string voxel = "voxel (" + std::to_string(first % sx) + ", " + std::to_string(first / sx % sy) +
                            ", " + std::to_string(first / sx / sy) + ")";
  diagnostics.tolerated(
      at, std::string(context) + ": " + std::string(what) + ' ' + negativesMessage(count, voxel, found));
}

}  // namespace pbrtmedia
