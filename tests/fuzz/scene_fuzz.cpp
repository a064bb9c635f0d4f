// SPDX-License-Identifier: BSD-2-Clause
// Any bytes as a scene, strict and not; then messages, unused-parameter reports and the printer, whose
// output must print to itself. No file is read or written.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "scene/param_reader.h"
#include "scene/parser.h"
#include "scene/print.h"

namespace {

using namespace pbrtmedia;

void read(Entity& entity, Diagnostics& diagnostics) {
  ParamReader in(entity, diagnostics, "entity");
  (void)in.findFloat("radius", 1, Range::positive());
  (void)in.findInt("nx", 1, Range::atLeast(1));
  (void)in.findSpectrum("L", Rgb(1));
  (void)in.takeFloats("density");
  (void)in.takePoint3s("P");
  in.reportUnused();
}

void parse(std::string_view text, bool strict) {
  Diagnostics diagnostics;
  diagnostics.strict = strict;
  ParseOptions options;
  options.readFiles = false;
  auto scenes = parseText(text, "fuzz", "", diagnostics, options);
  for (SceneDescription& scene : scenes) {
    read(scene.film, diagnostics);
    for (MediumDescription& medium : scene.media) read(medium, diagnostics);
    for (ShapeDescription& shape : scene.shapes) read(shape, diagnostics);
  }
  (void)diagnostics.format();
}

void print(std::string_view text) {
  // The printer reads spectrum files; a text that could name one is left out.
  if (text.find("spectrum") != text.npos) return;
  Diagnostics diagnostics;
  std::ostringstream once, twice;
  printText(text, "fuzz", "", once, diagnostics);
  if (diagnostics.hasErrors()) return;
  printText(once.str(), "again", "", twice, diagnostics);
  if (diagnostics.hasErrors() || once.str() != twice.str()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  parse(text, false);
  parse(text, true);
  print(text);
  return 0;
}
