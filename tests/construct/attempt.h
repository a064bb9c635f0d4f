// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "construct/construct.h"
#include "scene/parser.h"

namespace pbrtmedia::test {

struct AttemptSettings {
  bool strict = false;
  ConstructOptions build{};
  std::filesystem::path folder = ".";
};

/// A text that was parsed and, if that went well, constructed; with all that was said.
struct Attempt {
  Diagnostics diagnostics;
  std::vector<SceneDescription> worlds;
  std::optional<Construction> made;

  std::string messages() const { return diagnostics.format(); }
  bool isSilent() const { return made.has_value() && diagnostics.all().empty(); }
  /// The first message of the severity that holds `fragment`.
  const Diagnostic* find(Severity severity, const std::string& fragment) const {
    for (const Diagnostic& d : diagnostics.all()) {
      if (d.severity == severity && d.message.find(fragment) != std::string::npos) return &d;
    }
    return nullptr;
  }
  bool failsWith(const std::string& fragment) const {
    return !made && find(Severity::Error, fragment) != nullptr;
  }
  bool warns(const std::string& fragment) const {
    return made && find(Severity::Warning, fragment) != nullptr;
  }
};

/// Makes every attempt strict while it lives.
class StrictAttempts {
 public:
  StrictAttempts() { ++count(); }
  ~StrictAttempts() { --count(); }
  StrictAttempts(const StrictAttempts&) = delete;
  StrictAttempts& operator=(const StrictAttempts&) = delete;
  static bool areOn() { return count() > 0; }

 private:
  static int& count() {
    static int living = 0;
    return living;
  }
};

inline Attempt attempt(const std::string& text, const AttemptSettings& settings = {}) {
  Attempt a;
  a.diagnostics.strict = settings.strict || StrictAttempts::areOn();
  a.worlds = parseText(text, "t.pbrt", settings.folder, a.diagnostics);
  if (a.diagnostics.hasErrors() || a.worlds.size() != 1) return a;
  a.made = construct(a.worlds.front(), settings.build, a.diagnostics);
  return a;
}

/// Options that make every construction small; a scene may say more after them.
inline const std::string kSmall =
    "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string filename\" \"t.exr\" "
    "Sampler \"random\" \"integer pixelsamples\" 2 Integrator \"volpath\" ";
inline const std::string kLight = "LightSource \"point\" \"point from\" [ 0 0 9 ] ";

/// A world of the given text, which begins in line 2, column 1.
inline Attempt attemptWorld(const std::string& world, const AttemptSettings& settings = {},
                            const std::string& options = "") {
  return attempt(kSmall + options + " WorldBegin " + kLight + "\n" + world + "\nWorldEnd\n", settings);
}

inline std::string placeOf(const Diagnostic* d) { return d == nullptr ? "" : d->location.toString(); }

}  // namespace pbrtmedia::test
