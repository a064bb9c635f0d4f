// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_reader.h"

#include <algorithm>
#include <charconv>

#include "scene/messages.h"

namespace pbrtmedia {
namespace {

std::string number(double x) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(x)).ptr;
  return {buffer, end};
}

/// Why it is an error, where the same of another parameter is a warning.
constexpr const char* kNothingGuessed = "; PBRT-v3 has no such parameter, and nothing is taken in its place";

template <class T>
std::optional<T> copied(const T* value) {
  return value ? std::optional<T>(*value) : std::nullopt;
}

}  // namespace

std::string Range::toString() const {
  const bool hasMin = min != -std::numeric_limits<double>::infinity();
  const bool hasMax = max != std::numeric_limits<double>::infinity();
  if (hasMin && hasMax) {
    return std::string("in ") + (openMin ? '(' : '[') + number(min) + ", " + number(max) +
           (openMax ? ')' : ']');
  }
  if (hasMin) return (openMin ? "> " : ">= ") + number(min);
  if (hasMax) return (openMax ? "< " : "<= ") + number(max);
  return "any number";
}

ParamReader::ParamReader(Entity& entity, Diagnostics& diagnostics, std::string context)
    : entity_(entity), diagnostics_(diagnostics), context_(std::move(context)) {}

const Param* ParamReader::find(ParamKind kind, std::string_view name) {
  const auto isThis = [&](const auto& a) { return a.first == kind && a.second == name; };
  const bool isNew = std::none_of(asked_.begin(), asked_.end(), isThis);
  if (isNew) asked_.emplace_back(kind, name);
  const Param* const p = std::as_const(entity_.params).find(kind, name);
  if (isNew && p && p->size() == 0 && isOurs(name)) {
    diagnostics_.error(p->valuesAt, context_ + ": parameter " + quotedName(name) + ": found no value");
  }
  if (p) p->used = true;
  return p;
}

bool ParamReader::isAsked(std::string_view name) const {
  return std::any_of(asked_.begin(), asked_.end(), [&](const auto& a) { return a.second == name; });
}

bool ParamReader::isOurs(std::string_view name) const {
  return pbrtNames_ && std::find(pbrtNames_->begin(), pbrtNames_->end(), name) == pbrtNames_->end();
}

template <class T>
const T* ParamReader::scalar(ParamKind kind, std::string_view name) {
  const Param* const p = find(kind, name);
  if (!p) return nullptr;
  const auto& values = std::get<std::vector<T>>(p->values);
  if (values.size() == 1) return values.data();
  if (isOurs(name) && values.empty()) return nullptr;  // `find` has said so
  const std::string found = context_ + ": parameter " + quotedName(name) + ": found " +
                            std::to_string(values.size()) + " values, expected 1";
  if (isOurs(name)) {
    diagnostics_.error(p->valuesAt, found);
  } else {
    diagnostics_.tolerated(p->valuesAt, found + "; it is ignored, as in PBRT-v3");
  }
  return nullptr;
}

template <class T>
std::optional<T> ParamReader::number(ParamKind kind, std::string_view name, Range range) {
  const T* const value = scalar<T>(kind, name);
  if (!value) return std::nullopt;
  if (range.contains(*value)) return *value;
  const std::string found = std::is_same_v<T, int> ? std::to_string(*value) : pbrtmedia::number(*value);
  error(kind, name, "found " + found + ", expected " + range.toString());
  return std::nullopt;
}

std::optional<float> ParamReader::optionalFloat(std::string_view name, Range range) {
  return number<float>(ParamKind::Float, name, range);
}
std::optional<int> ParamReader::optionalInt(std::string_view name, Range range) {
  return number<int>(ParamKind::Integer, name, range);
}
std::optional<bool> ParamReader::optionalBool(std::string_view name) {
  const auto* const v = scalar<std::uint8_t>(ParamKind::Bool, name);
  return v ? std::optional<bool>(*v != 0) : std::nullopt;
}

std::optional<std::string> ParamReader::optionalString(std::string_view name) {
  return copied(scalar<std::string>(ParamKind::String, name));
}
std::optional<std::string> ParamReader::findTextureName(std::string_view name) {
  return copied(scalar<std::string>(ParamKind::Texture, name));
}

float ParamReader::findFloat(std::string_view name, float fallback, Range range) {
  return optionalFloat(name, range).value_or(fallback);
}
int ParamReader::findInt(std::string_view name, int fallback, Range range) {
  return optionalInt(name, range).value_or(fallback);
}
bool ParamReader::findBool(std::string_view name, bool fallback) {
  return optionalBool(name).value_or(fallback);
}
std::string ParamReader::findString(std::string_view name, std::string fallback) {
  return optionalString(name).value_or(std::move(fallback));
}
Point3f ParamReader::findPoint3(std::string_view name, Point3f fallback) {
  return copied(scalar<Point3f>(ParamKind::Point3, name)).value_or(fallback);
}
Vector3f ParamReader::findVector3(std::string_view name, Vector3f fallback) {
  return copied(scalar<Vector3f>(ParamKind::Vector3, name)).value_or(fallback);
}
Rgb ParamReader::findSpectrum(std::string_view name, Rgb fallback, Range range) {
  const Rgb* const c = scalar<Rgb>(ParamKind::Spectrum, name);
  if (!c) return fallback;
  if (range.contains(c->r) && range.contains(c->g) && range.contains(c->b)) return *c;
  error(ParamKind::Spectrum, name,
        "found RGB (" + pbrtmedia::number(c->r) + ", " + pbrtmedia::number(c->g) + ", " +
            pbrtmedia::number(c->b) + "), expected each " + range.toString());
  return fallback;
}

template <class T>
std::span<const T> ParamReader::view(ParamKind kind, std::string_view name) {
  const Param* const p = find(kind, name);
  if (!p) return {};
  return std::get<std::vector<T>>(p->values);
}
template <class T>
std::vector<T> ParamReader::take(ParamKind kind, std::string_view name) {
  if (!find(kind, name)) return {};
  return std::exchange(std::get<std::vector<T>>(entity_.params.find(kind, name)->values), {});
}

std::span<const int> ParamReader::ints(std::string_view name) { return view<int>(ParamKind::Integer, name); }
std::span<const float> ParamReader::floats(std::string_view name) {
  return view<float>(ParamKind::Float, name);
}
std::span<const std::string> ParamReader::strings(std::string_view name) {
  return view<std::string>(ParamKind::String, name);
}
std::vector<int> ParamReader::takeInts(std::string_view name) { return take<int>(ParamKind::Integer, name); }
std::vector<float> ParamReader::takeFloats(std::string_view name) {
  return take<float>(ParamKind::Float, name);
}
std::vector<Point2f> ParamReader::takePoint2s(std::string_view name) {
  return take<Point2f>(ParamKind::Point2, name);
}
std::vector<Point3f> ParamReader::takePoint3s(std::string_view name) {
  return take<Point3f>(ParamKind::Point3, name);
}
std::vector<Vector3f> ParamReader::takeVector3s(std::string_view name) {
  return take<Vector3f>(ParamKind::Vector3, name);
}
std::vector<Normal3f> ParamReader::takeNormals(std::string_view name) {
  return take<Normal3f>(ParamKind::Normal, name);
}

std::size_t ParamReader::findChoice(std::string_view name, std::span<const std::string_view> choices,
                                    std::size_t fallback) {
  const std::string* const word = scalar<std::string>(ParamKind::String, name);
  if (!word) return fallback;
  const auto it = std::find(choices.begin(), choices.end(), *word);
  if (it != choices.end()) return static_cast<std::size_t>(it - choices.begin());
  diagnostics_.tolerated(locationOf(ParamKind::String, name),
                         context_ + ": unknown " + std::string(name) + ' ' + quotedName(*word) +
                             suggestion(*word, choices) + "; \"" + std::string(choices[fallback]) +
                             "\" is taken, as in PBRT-v3");
  return fallback;
}

std::optional<std::filesystem::path> ParamReader::findInputFile(std::string_view name,
                                                                std::string_view consequence) {
  const std::string* const file = scalar<std::string>(ParamKind::String, name);
  if (!file || file->empty()) return std::nullopt;
  static const InputFolders kWorkingFolder;
  const InputFolders& folders = entity_.folders ? *entity_.folders : kWorkingFolder;
  const auto found = folders.locate(*file);
  if (!found) {
    std::string message = "there is no file \"" + folders.underBase(*file).string() + '"';
    if (consequence.empty()) {
      error(ParamKind::String, name, message);
    } else {
      message.append("; ").append(consequence);
      diagnostics_.tolerated(locationOf(ParamKind::String, name),
                             context_ + ": parameter " + quotedName(name) + ": " + message);
    }
    return std::nullopt;
  }
  if (found->besideIncluder) {
    diagnostics_.warning(locationOf(ParamKind::String, name),
                         context_ + ": parameter " + quotedName(name) + ": using \"" + found->path.string() +
                             "\"; PBRT-v3 looks for \"" + folders.underBase(*file).string() + '"');
  }
  return found->path;
}

SourceLocation ParamReader::locationOf(ParamKind kind, std::string_view name) const {
  const Param* const p = std::as_const(entity_.params).find(kind, name);
  return p ? p->valuesAt : entity_.location;
}

void ParamReader::error(ParamKind kind, std::string_view name, const std::string& message) {
  diagnostics_.error(locationOf(kind, name), context_ + ": parameter " + quotedName(name) + ": " + message);
}

void ParamReader::error(const std::string& message) {
  diagnostics_.error(entity_.location, context_ + ": " + message);
}

void ParamReader::reportOursMisread() {
  if (diagnostics_.strict) return;  // then all of them are errors already
  for (const ParamList::Misread& m : entity_.params.misread()) {
    if (!isOurs(m.name) || !isAsked(m.name)) continue;
    diagnostics_.error(m.at,
                       context_ + ": parameter " + quotedName(m.name) + ": " + m.found + kNothingGuessed);
  }
}

void ParamReader::reportUnused() {
  reportOursMisread();
  std::vector<std::string_view> names;
  for (const auto& asked : asked_) {
    if (std::find(names.begin(), names.end(), asked.second) == names.end()) names.push_back(asked.second);
  }
  for (const Param& p : entity_.params.all()) {
    if (p.used) continue;
    if (diagnostics_.isFull()) {
      diagnostics_.tolerated(p.declaredAt, {});
      continue;
    }
    std::string kinds;
    for (const auto& asked : asked_) {
      if (asked.second == p.name) kinds += (kinds.empty() ? "" : " or ") + std::string(keyword(asked.first));
    }
    std::string message = context_ + ": ";
    if (!kinds.empty()) {
      message += "parameter " + quotedName(p.name) + ": found type " + std::string(keyword(p.kind)) +
                 ", expected " + kinds;
      if (isOurs(p.name)) {
        diagnostics_.error(p.declaredAt, message + kNothingGuessed);
        continue;
      }
      message += "; it is ignored, as in PBRT-v3";
    } else {
      message += "unknown parameter " + quotedName(p.name);
      message += names.empty() ? "; no parameters are known here" : suggestion(p.name, names);
    }
    diagnostics_.tolerated(p.declaredAt, std::move(message));
  }
}

}  // namespace pbrtmedia
