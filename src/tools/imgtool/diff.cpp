// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/diff.h"

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tools/imgtool/layers.h"

namespace pbrtmedia {
namespace {

using nlohmann::json;

struct Verdict {
  bool agree = true;
  std::vector<std::string> reasons;

  void limit(const char* what, double value, const std::optional<double>& most) {
    if (!most || value <= *most) return;
    agree = false;
    std::ostringstream reason;
    reason << what << ' ' << value << " exceeds " << *most;
    reasons.push_back(reason.str());
  }
};

/// Percent by which the mean of the first image departs from that of the second; infinite against 0.
double meanDifferencePercent(const ErrorSummary& e) {
  if (e.meanSigned == 0) return 0;
  return 100 * std::abs(e.meanSigned / e.meanReference);
}

Verdict judge(const ImageDifference& d, const std::optional<double>& flip, const DiffOptions& options) {
  Verdict verdict;
  // --difftol 0 is the default of PBRT's tool: any difference counts.
  const bool anyDifferenceCounts =
      (options.diffTol && *options.diffTol == 0) ||
      (!options.diffTol && !options.maxMse && !options.maxRelativeMse && !options.maxAbs && !options.maxFlip);
  if (anyDifferenceCounts && d.differingPixels > 0) {
    verdict.agree = false;
    verdict.reasons.push_back(std::to_string(d.differingPixels) + " pixels differ");
  }
  if (options.diffTol && *options.diffTol > 0) {
    verdict.limit("difference of means in percent", meanDifferencePercent(d.total), options.diffTol);
  }
  verdict.limit("MSE", d.total.mse, options.maxMse);
  verdict.limit("relative MSE", d.total.relativeMse, options.maxRelativeMse);
  verdict.limit("largest difference", d.total.maxAbs, options.maxAbs);
  if (flip) verdict.limit("FLIP", *flip, options.maxFlip);
  return verdict;
}

json summaryJson(const ErrorSummary& e) {
  return {{"meanFirst", e.meanTest},
          {"meanSecond", e.meanReference},
          {"meanSigned", e.meanSigned},
          {"mse", e.mse},
          {"rmse", e.rmse},
          {"relativeMse", e.relativeMse},
          {"relativeMseRobust", e.relativeMseRobust},
          {"smape", e.smape},
          {"maxAbs", e.maxAbs},
          {"maxAt", {e.maxAt.x, e.maxAt.y}}};
}

void printJson(const DiffOptions& options, const ImageDifference& d, const std::optional<double>& flip,
               const Verdict& verdict) {
  json out = summaryJson(d.total);
  out["first"] = options.test;
  out["second"] = options.reference;
  out["epsilon"] = d.epsilon;
  out["maxChannel"] = d.maxChannel;
  out["differingPixels"] = d.differingPixels;
  out["agree"] = verdict.agree;
  out["reasons"] = verdict.reasons;
  if (flip) out["flip"] = *flip;
  for (const ChannelError& c : d.channels) out["channels"][c.channel] = summaryJson(c);
  std::cout << out.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
}

void printSummary(const std::string& name, const ErrorSummary& e) {
  std::cout << "  " << name << ": mean signed " << e.meanSigned << "  MSE " << e.mse << "  RMSE " << e.rmse
            << "  relative MSE " << e.relativeMse << " (robust " << e.relativeMseRobust << ")  SMAPE "
            << e.smape << "  max " << e.maxAbs << " at " << e.maxAt << '\n';
}

void printText(const DiffOptions& options, const ImageDifference& d, const std::optional<double>& flip,
               const Verdict& verdict) {
  std::cout << options.test << " (a) against " << options.reference << " (b): " << d.differingPixels
            << " pixels differ\n";
  for (const ChannelError& c : d.channels) printSummary("channel " + c.channel, c);
  printSummary("all", d.total);
  std::cout << "  means: a " << d.total.meanTest << ", b " << d.total.meanReference
            << "; mean signed: a - b\n"
            << "  largest difference in channel " << d.maxChannel << '\n'
            << "  relative MSE: mean over pixels and channels of (a - b)^2 / (b^2 + " << d.epsilon << ")\n"
            << "  robust: without the worst of " << kPixelsPerWorst << " pixels, rounded up\n"
            << "  SMAPE: mean of |a - b| / ((|a| + |b|) / 2)\n";
  if (flip) std::cout << "  FLIP (LDR, values clamped to [0, 1]): " << *flip << '\n';
  for (const std::string& reason : verdict.reasons) std::cout << "  " << reason << '\n';
  std::cout << (verdict.agree ? "  the images agree\n" : "  the images differ\n");
}

int reportFailure(const DiffOptions& options, const std::string& reason) {
  if (options.json) {
    const json out = {
        {"first", options.test}, {"second", options.reference}, {"agree", false}, {"error", reason}};
    std::cout << out.dump(2, ' ', false, json::error_handler_t::replace) << '\n';
  } else {
    std::cout << options.test << " against " << options.reference << ": cannot be compared: " << reason
              << '\n';
  }
  return 1;
}

/// |test - reference|, in the reference's channels.
Image absoluteDifference(const Image& test, const Image& reference) {
  Image out = reference;
  out.metadata.clear();
  for (std::size_t c = 0; c < reference.channelCount(); ++c) {
    const std::size_t other = *test.channelIndex(reference.channels()[c]);
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) {
        out.at(x, y, c) = std::abs(test.at(x, y, other) - reference.at(x, y, c));
      }
    }
  }
  return out;
}

}  // namespace

int runDiff(const DiffOptions& options) {
  for (const std::string& file : {options.outfile, options.flipMap}) {
    if (!file.empty()) requireWritable(file);
  }
  LoadedImage test = loadLinear(options.test), reference = loadLinear(options.reference);
  if (!options.layer.empty()) {
    test.image = layerAlone(options.test, test.image, options.layer);
    reference.image = layerAlone(options.reference, reference.image, options.layer);
  }
  const bool bothExr = test.format == ImageFormat::Exr && reference.format == ImageFormat::Exr;
  const auto result = compareImages(test.image, reference.image, options.epsilon);
  if (const auto* failure = std::get_if<ComparisonFailure>(&result)) {
    return reportFailure(options, failure->reason);
  }
  if (bothExr && !(test.image.dataWindow == reference.image.dataWindow)) {
    return reportFailure(options, "different data windows: " + toString(test.image.dataWindow) + " and " +
                                      toString(reference.image.dataWindow));
  }
  const auto& difference = std::get<ImageDifference>(result);
  std::optional<double> flip;
  if (options.flip || options.maxFlip || !options.flipMap.empty()) {
    if (!test.image.hasRgb()) return reportFailure(options, "FLIP needs channels R, G, B or Y");
    const Image map = flipMap(reference.image, test.image, options.pixelsPerDegree);
    flip = flipMean(map);
    if (!options.flipMap.empty()) writeImage(options.flipMap, map, {.pixelType = PixelType::Float});
  }
  const Verdict verdict = judge(difference, flip, options);
  if (options.json) {
    printJson(options, difference, flip, verdict);
  } else {
    printText(options, difference, flip, verdict);
  }
  if (!verdict.agree && !options.outfile.empty()) {
    writeImage(options.outfile, absoluteDifference(test.image, reference.image),
               {.pixelType = PixelType::Float});
  }
  return verdict.agree ? 0 : 1;
}

}  // namespace pbrtmedia
