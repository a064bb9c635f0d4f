// SPDX-License-Identifier: BSD-2-Clause
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/frame_names.h"
#include "tools/run_tool.h"
#include "vdb2pbrt/conversion.h"
#include "vdb2pbrt/crash_guard.h"
#include "vdb2pbrt/describe_volume.h"
#include "vdb2pbrt/progress_line.h"
#include "vdb2pbrt/sequence.h"

namespace pbrtmedia {
namespace {

struct Arguments {
  SequenceOptions files;
  bool info = false, half = false, quiet = false;
  std::vector<double> sigmaA, sigmaS, le;
  ConversionOptions conversion;
};

void addVolumeOptions(CLI::App& app, ConversionOptions& c) {
  app.add_option(
         "-g,--grid", c.grids.densities,
         "a density by name, number or unique beginning; may be repeated (the only density, or \"density\")")
      ->allow_extra_args(false);
  app.add_flag("--all", c.grids.allDensities,
               "every float grid whose name does not tell that it is a temperature, flames or the like");
  app.add_option("--medium", c.medium, "name of the medium, when there is one density (the grid's name)");
  const std::map<std::string, NegativeRule> rules{
      {"clamp", NegativeRule::Clamp}, {"error", NegativeRule::Error}, {"keep", NegativeRule::Keep}};
  app.add_option("--negative", c.negative,
                 "voxels below 0: clamp to 0 and count them, error, or keep (clamp)")
      ->transform(oneOf(rules))
      ->type_name("RULE");
  const std::map<std::string, NanRule> nans{{"error", NanRule::Error}, {"zero", NanRule::Zero}};
  app.add_option("--nan", c.nan, "voxels that are NaN or infinite: error, or zero, which counts them (error)")
      ->transform(oneOf(nans))
      ->type_name("RULE");
  const std::map<std::string, LevelSetRule> levelSets{{"error", LevelSetRule::Error},
                                                      {"fog", LevelSetRule::Fog}};
  app.add_option(
         "--level-set", c.levelSet,
         "grids that tell distances: error, or fog, which makes fog volumes of them, 1 inside (error)")
      ->transform(oneOf(levelSets))
      ->type_name("RULE");
}

void addLookOptions(CLI::App& app, Arguments& a) {
  ConversionOptions& c = a.conversion;
  app.add_option("--sigma-a", a.sigmaA,
                 "R G B: absorption at density 1, per world length (0 0 0; 1 1 1 where something glows)")
      ->check(number(NumberRange::atLeast(0)))
      ->expected(3);
  app.add_option("--sigma-s", a.sigmaS, "R G B: scattering at density 1, per world length (1 1 1)")
      ->check(number(NumberRange::atLeast(0)))
      ->expected(3);
  app.add_option("--scale", c.scale, "multiplies both (1; with --scene what suits the volume)")
      ->check(number(NumberRange::atLeast(0)));
  app.add_option("--temperature", c.grids.temperature,
                 "a grid of temperatures: the media glow as black bodies")
      ->type_name("GRID");
  app.add_option("--temperaturescale", c.temperatureScale,
                 "kelvin for each unit of it (1; 2200 for the hottest where none is above 100)")
      ->check(number(NumberRange::atLeast(0)));
  app.add_option("--temperatureoffset", c.temperatureOffset, "taken from its values first (0)")
      ->check(number(NumberRange::any()));
  app.add_option("--Legrid", c.grids.factor,
                 "a grid of factors on what glows, as heat or flames: alone, or beside --temperature")
      ->type_name("GRID");
  app.add_option("--Le", a.le, "R G B: emitted radiance where no temperature gives it (1 0.36 0.08)")
      ->check(number(NumberRange::atLeast(0)))
      ->expected(3);
  app.add_option("--Lescale", c.leScale, "multiplies what glows (what makes the hot parts bright)")
      ->check(number(NumberRange::atLeast(0)));
  app.add_option("--scene", a.files.scene, "write a scene, too: camera, light and ground around the volume")
      ->type_name("FILE.pbrt");
  const std::map<std::string, UpAxis> axes{{"y", UpAxis::Y}, {"z", UpAxis::Z}};
  app.add_option("--up", c.up, "which way is up in the scene: y, or z (y; z for files of Blender)")
      ->transform(oneOf(axes))
      ->type_name("AXIS");
}

void addOptions(CLI::App& app, Arguments& a) {
  app.footer(
      "Writes OUTPUT, a .pbrt include with a medium and a box around it, and the .nvdb file of the same "
      "name\n"
      "that the medium reads. Exit status 0, or 1 after any error; files are replaced only when complete.");
  app.add_option("input", a.files.input,
                 "a .vdb file; %04d, $F4 or #### in its name stands for the frame (--info: also .nvdb)")
      ->required();
  app.add_option("-o,--outfile", a.files.output, "the include (the input's name with .pbrt)");
  app.add_flag("--info", a.info, "list the grids of the file and write nothing");
  addVolumeOptions(app, a.conversion);
  addLookOptions(app, a);
  const std::map<std::string, NvdbPrecision> precisions{{"float", NvdbPrecision::Float},
                                                        {"fp16", NvdbPrecision::Fp16},
                                                        {"fp8", NvdbPrecision::Fp8},
                                                        {"fp4", NvdbPrecision::Fp4},
                                                        {"fpn", NvdbPrecision::FpN}};
  CLI::Option* precision =
      app.add_option(
             "--precision", a.conversion.nvdb.precision,
             "float (exact), or 16, 8, 4 or as few bits as --tolerance allows between the extremes of "
             "each 8^3 voxels: fp16, fp8, fp4, fpn")
          ->transform(oneOf(precisions))
          ->type_name("NAME");
  app.add_flag("--half", a.half, "the same as --precision fp16")->excludes(precision);
  app.add_option("--tolerance", a.conversion.nvdb.tolerance, "fpn: largest error of a value (0.01)")
      ->check(number(NumberRange::above(0)));
  app.add_flag("--zip", a.conversion.nvdb.zip, "pack the .nvdb file");
  const std::map<std::string, DenseForm> forms{{"inline", DenseForm::Inline}, {"gz", DenseForm::Gz}};
  app.add_option("--dense", a.conversion.dense,
                 "no .nvdb: all samples as PBRT-v3's heterogeneous medium in the include, plain (inline) or "
                 "gzip-compressed (gz)")
      ->transform(oneOf(forms))
      ->type_name("FORM");
  app.add_option("--frames", a.files.frames,
                 "FIRST-LAST or FIRST-LAST:STEP, for names with a place for the frame (all that are there)");
  app.add_flag("--skip-missing", a.files.skipMissing, "leave out frames that are not there (else an error)");
  app.add_flag("--quiet", a.quiet, "no notices, no progress");
}

std::optional<Vec3d> threeOf(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Vec3d(values[0], values[1], values[2]);
}

void checkEmission(ConversionOptions& c, const std::vector<double>& le) {
  c.le = threeOf(le);
  if (c.le && !c.grids.temperature.empty()) {
    throw std::runtime_error("--Le: the colour comes from --temperature already: one of them");
  }
  if (c.grids.temperature.empty() && (c.temperatureScale || c.temperatureOffset != 0)) {
    throw std::runtime_error("--temperaturescale and --temperatureoffset belong to --temperature GRID");
  }
  if (c.grids.temperature.empty() && c.grids.factor.empty() && (c.le || c.leScale)) {
    throw std::runtime_error("--Le and --Lescale belong to --temperature GRID or --Legrid GRID");
  }
}

void checkArguments(Arguments& a) {
  ConversionOptions& c = a.conversion;
  c.sigmaA = threeOf(a.sigmaA);
  c.sigmaS = threeOf(a.sigmaS);
  checkEmission(c, a.le);
  if (a.half) c.nvdb.precision = NvdbPrecision::Fp16;
  if (c.dense != DenseForm::None && (c.nvdb.precision != NvdbPrecision::Float || c.nvdb.zip)) {
    throw std::runtime_error("--dense writes no .nvdb file: --half, --precision and --zip do not go with it");
  }
  if (a.files.output.empty()) {
    a.files.output = std::filesystem::path(a.files.input).replace_extension(".pbrt").string();
    if (c.dense == DenseForm::Gz) a.files.output += ".gz";
  }
}

int run(Arguments& a) {
  if (a.info) {
    std::cout << describeVolume(a.files.input);
    return 0;
  }
  checkArguments(a);
  ProgressLine line = ProgressLine::onStandardError();
  const Notice notice = [&](const std::string& text) {
    if (a.quiet) return;
    line.clear();
    std::cerr << "vdb2pbrt: " << text << '\n';
  };
  const Progress progress =
      a.quiet ? Progress() : [&](const std::string& what, double share) { line.update(what, share); };
  try {
    // A file of exactly that name is no sequence, whatever its name holds.
    if (hasFramePlace(a.files.input) && !std::filesystem::exists(a.files.input)) {
      convertSequence(a.files, a.conversion, notice, progress);
    } else if (!a.files.frames.empty()) {
      throw std::runtime_error(
          "--frames needs a place for the frame in the input's name, such as %04d, $F4 or ####");
    } else {
      a.conversion.scene = a.files.scene;
      convertVdb(a.files.input, a.files.output, a.conversion, notice, progress);
    }
  } catch (...) {
    line.clear();
    throw;
  }
  line.clear();
  return 0;
}

}  // namespace
}  // namespace pbrtmedia

int main(int argc, char** argv) {
  CLI::App app("Converts OpenVDB volumes for pbrt-media", "vdb2pbrt");
  pbrtmedia::Arguments arguments;
  pbrtmedia::addOptions(app, arguments);
  return pbrtmedia::runTool(app, argc, argv, [&] {
    return pbrtmedia::runGuarded(arguments.files.input, [&] {
      return pbrtmedia::runProgram("vdb2pbrt", [&] { return pbrtmedia::run(arguments); });
    });
  });
}
