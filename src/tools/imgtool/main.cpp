// SPDX-License-Identifier: BSD-2-Clause
#include <CLI/CLI.hpp>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "tools/imgtool/assemble.h"
#include "tools/imgtool/cat.h"
#include "tools/imgtool/convert.h"
#include "tools/imgtool/diff.h"
#include "tools/imgtool/info.h"
#include "tools/imgtool/merge.h"
#include "tools/run_tool.h"

// Each `addX` declares one command and stores in `run` what it does; the options live as long as the program.

namespace pbrtmedia {
namespace {

using Run = std::function<int()>;

constexpr const char* kLayerHelp =
    "only this layer: a name (normal, albedo, colour ...), a prefix of channels (N), or a channel (N.X)";

/// --pixeltype and --compression of commands that write EXR; the same words as those of pbrt.
void addWriteOptions(CLI::App* command, WriteOptions& write) {
  const std::map<std::string, PixelType> pixelTypes{{"half", PixelType::Half}, {"float", PixelType::Float}};
  command->add_option("--pixeltype", write.pixelType, "EXR: half (default) or float numbers")
      ->transform(oneOf(pixelTypes))
      ->type_name("TYPE");
  const std::map<std::string, ExrCompression> compressions{
      {"none", ExrCompression::None}, {"zip", ExrCompression::Zip}, {"piz", ExrCompression::Piz}};
  command->add_option("--compression", write.compression, "EXR: zip (default), piz or none")
      ->transform(oneOf(compressions))
      ->type_name("NAME");
}

void addInfo(CLI::App& app, InfoOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("info", "Print size, windows, channels, metadata and statistics");
  c->add_option("files", o.files, "images")->required();
  c->add_option("--layer", o.layer, kLayerHelp)->type_name("NAME");
  c->add_flag("--json", o.json, "print a JSON array instead of text");
  c->callback([&o, &run] { run = [&o] { return runInfo(o); }; });
}

void addConvert(CLI::App& app, ConvertOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("convert", "Convert between formats and process");
  c->footer(
      "Steps are applied in this order: layer, crop, scale and exposure, offset, despike, bloom, tonemap, "
      "preservecolors,\n"
      "signed, resize, repeatpix, flipy. PNG and TGA are linearised on reading and sRGB-encoded on writing.");
  c->add_option("input", o.input, "image to read")->required();
  c->add_option("output", o.output, "image to write: .exr, .pfm, .png or .tga")->required();
  c->add_option("--layer", o.layer, kLayerHelp)->type_name("NAME");
  constexpr double kLargest = 1e30;  // of factors and luminances: well within float
  c->add_option("--crop", o.crop, "x0 x1 y0 y1: pixels to keep, upper ends exclusive")
      ->expected(4)
      ->check(wholeNumber(0, std::numeric_limits<int>::max()));
  c->add_option("--scale", o.scale, "multiply values")
      ->check(number(NumberRange::between(-kLargest, kLargest)));
  c->add_option("--exposure", o.exposure, "multiply values by 2^stops")
      ->check(number(NumberRange::between(-100, 100)));
  c->add_option("--offset", o.offset, "then add this: --layer normal --scale 0.5 --offset 0.5")
      ->check(number(NumberRange::between(-kLargest, kLargest)));
  c->add_option("--despike", o.despike, "replace pixels of at least this luminance by the 3x3 median")
      ->check(number(NumberRange::between(0, kLargest)));
  CLI::Option* level =
      c->add_option("--bloomlevel", o.bloomLevel, "pixels of at least this luminance glow (off)")
          ->check(number(NumberRange::between(0, kLargest)));
  c->add_option("--bloomwidth", o.bloom.width, "width of the blur in pixels, odd (15)")
      ->check(wholeNumber(1, 9999))
      ->needs(level);
  c->add_option("--bloomscale", o.bloom.scale, "strength of the glow (0.3)")
      ->check(number(NumberRange::between(0, kLargest)))
      ->needs(level);
  c->add_option("--bloomiters", o.bloom.iterations, "number of successive blurs (5)")
      ->check(wholeNumber(1, 1000))
      ->needs(level);
  CLI::Option* toneMap = c->add_flag("--tonemap", o.toneMap, "multiply by (1 + Y/maxluminance^2) / (1 + Y)");
  c->add_option("--maxluminance", o.maxLuminance, "luminance that tone mapping turns into 1 (1)")
      ->check(number(NumberRange{.least = 0, .most = kLargest, .excludesLeast = true}))
      ->needs(toneMap);
  CLI::Option* preserve = c->add_flag("--preservecolors", o.preserveColors,
                                      "divide by the largest component where it is above 1");
  CLI::Option* isSigned =
      c->add_flag(
           "--signed", o.isSigned,
           "show signed values, as of pbrt --derivative: blue below 0, red above; full colour at 1 of what "
           "--scale makes, else where few pixels are beyond; tells the scale")
          ->excludes(level)
          ->excludes(toneMap)
          ->excludes(preserve);
  const std::map<std::string, ZeroColor> zeros{{"white", ZeroColor::White}, {"black", ZeroColor::Black}};
  c->add_option("--zero", o.zero, "what 0 is with --signed: white (default) or black")
      ->transform(oneOf(zeros))
      ->needs(isSigned)
      ->type_name("COLOUR");
  c->add_option("--resize", o.resize, "WIDTHxHEIGHT");
  const std::map<std::string, ResizeFilter> filters{{"box", ResizeFilter::Box},
                                                    {"lanczos", ResizeFilter::Lanczos}};
  c->add_option("--resizefilter", o.resizeFilter, "box (default) or lanczos")
      ->transform(oneOf(filters))
      ->type_name("NAME");
  c->add_option("--repeatpix", o.repeatPixels, "repeat pixels in both directions (1)")
      ->check(wholeNumber(1, 4096));
  c->add_flag("--flipy", o.flipY, "turn upside down");
  addWriteOptions(c, o.write);
  c->callback([&o, &run] { run = [&o] { return runConvert(o); }; });
}

void addDiff(CLI::App& app, DiffOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("diff", "Compare an image with a reference");
  c->footer(
      "Exit status 0 when the images agree, else 1. Without limits they agree only when identical, with\n"
      "limits when none is exceeded. Different size, channels or windows, NaN or infinity never agree.");
  c->add_option("a", o.test, "image to judge")->required();
  c->add_option("b", o.reference, "reference")->required();
  c->add_option("--layer", o.layer, kLayerHelp)->type_name("NAME");
  c->add_option("--difftol", o.diffTol, "percent by which the means may differ; 0: no pixel may differ")
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--max-mse", o.maxMse, "limit of the mean squared error")
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--max-relmse", o.maxRelativeMse,
                "limit of the relative MSE, mean of (a-b)^2 / (b^2 + epsilon)")
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--max-abs", o.maxAbs, "limit of the largest difference")
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--max-flip", o.maxFlip, "limit of the mean FLIP error")
      ->check(number(NumberRange::atLeast(0)));
  c->add_option("--epsilon", o.epsilon, "epsilon of the relative MSE (0.01)")
      ->check(number(NumberRange::above(0)));
  c->add_flag("--flip", o.flip, "also compute LDR-FLIP of the values clamped to [0, 1]");
  c->add_option("--flip-map", o.flipMap, "write the FLIP error of each pixel here, in [0, 1]; computes FLIP");
  c->add_option("--ppd", o.pixelsPerDegree, "pixels per degree for FLIP (67.02)")
      ->check(number(NumberRange::between(1, 1000)));
  c->add_option("-o,--outfile", o.outfile, "write |a - b| here when the images differ");
  c->add_flag("--json", o.json, "print JSON instead of text");
  c->callback([&o, &run] { run = [&o] { return runDiff(o); }; });
}

void addCat(CLI::App& app, CatOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("cat", "Print every pixel as \"(x, y): values\"");
  c->add_option("file", o.file, "image")->required();
  c->add_flag("--sort", o.sort, "by luminance instead of row by row");
  c->callback([&o, &run] { run = [&o] { return runCat(o); }; });
}

void addMerge(CLI::App& app, MergeOptions& o, Run& run) {
  CLI::App* c =
      app.add_subcommand("merge", "Average renders of one scene with different seeds, or join ranges of one");
  c->footer(
      "Weights are the samples of each render. Ranges (pbrt --samples) are joined to the bits of one render: "
      "their\n"
      "sums are added in double. Needs the metadata samples, seed and sceneHash that the\n"
      "renderer writes. Writes 32-bit values unless told otherwise.");
  c->add_option("inputs", o.inputs, "EXR renders")->required();
  c->add_option("-o,--outfile", o.outfile, "image to write")->required();
  addWriteOptions(c, o.write);
  c->callback([&o, &run] { run = [&o] { return runMerge(o); }; });
}

void addAssemble(CLI::App& app, AssembleOptions& o, Run& run) {
  CLI::App* c = app.add_subcommand("assemble", "Put cropped EXR tiles together by their data windows");
  c->footer("Reports overlaps (the last tile counts) and gaps, which are an error unless allowed.");
  c->add_option("inputs", o.inputs, "EXR tiles")->required();
  c->add_option("-o,--outfile", o.outfile, "image to write")->required();
  c->add_flag("--allow-gaps", o.allowGaps, "write an image although pixels are missing; they are black");
  addWriteOptions(c, o.write);
  c->callback([&o, &run] { run = [&o] { return runAssemble(o); }; });
}

}  // namespace

int imgtoolMain(int argc, char** argv) {
  CLI::App app{"Inspects, converts, compares and combines images (OpenEXR, PNG, PFM, TGA)", "imgtool"};
  app.require_subcommand(1);
  InfoOptions info;
  ConvertOptions convert;
  DiffOptions diff;
  CatOptions cat;
  MergeOptions merge;
  AssembleOptions assemble;
  Run run;
  addInfo(app, info, run);
  addConvert(app, convert, run);
  addDiff(app, diff, run);
  addCat(app, cat, run);
  addMerge(app, merge, run);
  addAssemble(app, assemble, run);
  return runTool(app, argc, argv, run);
}

}  // namespace pbrtmedia

int main(int argc, char** argv) { return pbrtmedia::imgtoolMain(argc, argv); }
