// SPDX-License-Identifier: BSD-2-Clause
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/run_tool.h"
#include "vdb2pbrt/conversion.h"
#include "vdb2pbrt/crash_guard.h"
#include "vdb2pbrt/frame_names.h"

namespace pbrtmedia {
namespace {

struct Arguments {
  std::string input, output, frames;
  bool info = false, half = false, skipMissing = false, quiet = false;
  std::vector<double> sigmaA{0, 0, 0}, sigmaS{1, 1, 1};
  ConversionOptions conversion;
};

void addOptions(CLI::App& app, Arguments& a) {
  app.footer(
      "Writes OUTPUT, a .pbrt include with a medium and a box around it, and the .nvdb file of the same "
      "name\n"
      "that the medium reads. Exit status 0, or 1 after any error; files are replaced only when complete.");
  app.add_option("input", a.input, "a .vdb file; %04d in its name stands for the frame (--info: also .nvdb)")
      ->required();
  app.add_option("-o,--outfile", a.output, "the include (the input's name with .pbrt)");
  app.add_flag("--info", a.info, "list the grids of the file and write nothing");
  app.add_option(
      "-g,--grid", a.conversion.grids,
      "grid by name, number or unique beginning; may be repeated (the only density, or \"density\")");
  app.add_flag("--all", a.conversion.allGrids, "convert every density of the file");
  app.add_option("--medium", a.conversion.medium,
                 "name of the medium, when there is one grid (the grid's name)");
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
          ->transform(CLI::CheckedTransformer(precisions, CLI::ignore_case))
          ->type_name("NAME");
  app.add_flag("--half", a.half, "the same as --precision fp16")->excludes(precision);
  app.add_option("--tolerance", a.conversion.nvdb.tolerance, "fpn: largest error of a value (0.01)")
      ->check(number(NumberRange::above(0)));
  app.add_flag("--zip", a.conversion.nvdb.zip, "pack the .nvdb file");
  const std::map<std::string, DenseForm> forms{{"inline", DenseForm::Inline}, {"gz", DenseForm::Gz}};
  app.add_option("--dense", a.conversion.dense,
                 "no .nvdb: all samples as PBRT-v3's heterogeneous medium in the include, plain (inline) or "
                 "gzip-compressed (gz)")
      ->transform(CLI::CheckedTransformer(forms, CLI::ignore_case))
      ->type_name("FORM");
  const std::map<std::string, NegativeRule> rules{
      {"clamp", NegativeRule::Clamp}, {"error", NegativeRule::Error}, {"keep", NegativeRule::Keep}};
  app.add_option("--negative", a.conversion.negative,
                 "voxels below 0: clamp to 0 and count them, error, or keep (clamp)")
      ->transform(CLI::CheckedTransformer(rules, CLI::ignore_case))
      ->type_name("RULE");
  app.add_option("--sigma-a", a.sigmaA, "R G B: absorption at density 1, per world length (0 0 0)")
      ->check(number(NumberRange::atLeast(0)))
      ->expected(3);
  app.add_option("--sigma-s", a.sigmaS, "R G B: scattering at density 1, per world length (1 1 1)")
      ->check(number(NumberRange::atLeast(0)))
      ->expected(3);
  app.add_option("--scale", a.conversion.include.scale, "multiplies both (1)")
      ->check(number(NumberRange::atLeast(0)));
  app.add_option("--frames", a.frames, "FIRST-LAST or FIRST-LAST:STEP, for names with %d or %04d");
  app.add_flag("--skip-missing", a.skipMissing, "leave out frames that are not there (else an error)");
  app.add_flag("--quiet", a.quiet, "no notices");
}

Vec3d coefficients(const std::vector<double>& values, const char* option) {
  for (const double v : values) {
    if (!(v >= 0) || !std::isfinite(v)) {
      throw std::runtime_error(std::string(option) + ": expected three finite numbers >= 0");
    }
  }
  return {values[0], values[1], values[2]};
}

void checkArguments(Arguments& a) {
  a.conversion.include.sigmaA = coefficients(a.sigmaA, "--sigma-a");
  a.conversion.include.sigmaS = coefficients(a.sigmaS, "--sigma-s");
  if (!(a.conversion.include.scale >= 0) || !std::isfinite(a.conversion.include.scale)) {
    throw std::runtime_error("--scale: expected a finite number >= 0");
  }
  if (!(a.conversion.nvdb.tolerance > 0) || !std::isfinite(a.conversion.nvdb.tolerance)) {
    throw std::runtime_error("--tolerance: expected a finite number > 0");
  }
  if (a.half) a.conversion.nvdb.precision = NvdbPrecision::Fp16;
  if (a.conversion.dense != DenseForm::None &&
      (a.conversion.nvdb.precision != NvdbPrecision::Float || a.conversion.nvdb.zip)) {
    throw std::runtime_error("--dense writes no .nvdb file: --half, --precision and --zip do not go with it");
  }
  if (a.output.empty()) {
    a.output = std::filesystem::path(a.input).replace_extension(".pbrt").string();
    if (a.conversion.dense == DenseForm::Gz) a.output += ".gz";
  }
}

int convertFrames(const Arguments& a, const Notice& notice) {
  if (!hasFramePlace(a.input)) {
    if (!a.frames.empty()) throw std::runtime_error("--frames needs %d or %04d in the name of the input");
    convertVdb(a.input, a.output, a.conversion, notice);
    return 0;
  }
  const auto range = parseFrameRange(a.frames);
  if (!range) {
    throw std::runtime_error(
        "the input stands for a sequence: expected --frames FIRST-LAST or FIRST-LAST:STEP, found \"" +
        a.frames + '"');
  }
  if (range->first != range->last && !hasFramePlace(a.output)) {
    throw std::runtime_error(
        "--outfile needs %d or %04d in its name, or all frames would be written to one file");
  }
  int missing = 0, done = 0;
  // A missing frame is found before the first is converted.
  for (int pass = 0; pass < 2; ++pass) {
    for (long frame = range->first; frame <= range->last; frame += range->step) {
      const std::filesystem::path input = frameName(a.input, static_cast<int>(frame));
      if (!std::filesystem::exists(input)) {
        if (pass == 0) {
          ++missing;
          notice((a.skipMissing ? "left out, not there: " : "not there: ") + input.string());
        }
        continue;
      }
      if (pass == 0) continue;
      convertVdb(input, frameName(a.output, static_cast<int>(frame)), a.conversion,
                 [&](const std::string& line) { notice("frame " + std::to_string(frame) + ": " + line); });
      ++done;
    }
    if (pass == 0 && missing > 0 && !a.skipMissing) {
      throw std::runtime_error(std::to_string(missing) + " frames of " + a.input +
                               " are missing; nothing was converted (--skip-missing leaves them out)");
    }
  }
  if (done == 0) throw std::runtime_error("no frame of " + a.input + " is there");
  return 0;
}

int run(Arguments& a) {
  if (a.info) {
    std::cout << describeVolume(a.input);
    return 0;
  }
  checkArguments(a);
  return convertFrames(a, [&](const std::string& line) {
    if (!a.quiet) std::cerr << "vdb2pbrt: " << line << '\n';
  });
}

}  // namespace
}  // namespace pbrtmedia

int main(int argc, char** argv) {
  CLI::App app("Converts OpenVDB volumes for pbrt-media", "vdb2pbrt");
  pbrtmedia::Arguments arguments;
  pbrtmedia::addOptions(app, arguments);
  return pbrtmedia::runTool(app, argc, argv, [&] {
    return pbrtmedia::runGuarded(arguments.input, [&] {
      return pbrtmedia::runProgram("vdb2pbrt", [&] { return pbrtmedia::run(arguments); });
    });
  });
}
