// SPDX-License-Identifier: BSD-2-Clause
#include "main/convergence.h"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/diagnostics.h"
#include "main/image_error.h"

namespace pbrtmedia {
namespace {

struct Column {
  std::string_view name, definition;
};

/// docs/convergence.md tells the same (a test compares).
constexpr std::array<Column, 13> kColumns = {{
    {"seconds", "wall-clock seconds of rendering so far, without reading, building and measuring"},
    {"cpu_seconds", "the same, of all threads added up"},
    {"spp", "samples taken per pixel, a mean"},
    {"lookups", "evaluations of density fields, those that explore bounds included"},
    {"rays", "ray queries: closest hits and shadow rays"},
    {"mse", "mean over pixels and channels of (image - reference)^2"},
    {"rmse", "sqrt(mse)"},
    {"relmse", "mean of (image - reference)^2 / (reference^2 + 0.01)"},
    {"relmse_robust", "relmse without the 0.01 % of the pixels where it is worst (rounded up)"},
    {"smape", "mean of |image - reference| / ((|image| + |reference|) / 2), 0 where both are 0"},
    {"mean_signed_difference",
     "mean of image - reference: bias, where it is more than its noise; without reference empty"},
    {"time_to_unit_variance",
     "mse * seconds: when an error that falls as 1/seconds is 1; the smaller the better"},
    {"error_of",
     "reference: against --reference; halves: estimated from the samples of even and of odd index, whose "
     "difference stands for that from the truth (an upper estimate where samples complement each other)"},
}};

/// A reference in coordinates of the whole picture: one without windows of its own may be as large as what
/// the film shows.
Image placed(Image reference, const Film& film) {
  const Bounds2i shown = film.pixelBounds();
  const bool isPlain =
      reference.dataWindow == reference.displayWindow && reference.dataWindow.min == Point2i{};
  if (isPlain && reference.width() == shown.width() && reference.height() == shown.height()) {
    reference.dataWindow = shown;
    reference.displayWindow = {{0, 0}, film.settings().resolution};
  }
  return reference;
}

void checkReference(const Image& reference, const Film& film, Bounds2i pixels) {
  std::ostringstream why;
  const Point2i resolution = film.settings().resolution;
  const Bounds2i have = reference.dataWindow;
  if (!reference.hasRgb()) {
    why << "it has no channels R, G and B";
  } else if (!(reference.displayWindow == Bounds2i{{0, 0}, resolution})) {
    why << "it is a picture of " << reference.displayWindow.width() << " x "
        << reference.displayWindow.height() << " pixels; this one has " << resolution.x << " x "
        << resolution.y;
  } else if (!(intersect(have, pixels) == pixels)) {
    why << "it lacks pixels of this image";
  } else {
    const Image cut = cutOut(reference, pixels);
    const auto same = compareImages(cut, cut);
    if (std::holds_alternative<ComparisonFailure>(same)) why << "it holds values that are no finite numbers";
  }
  if (!why.str().empty()) throw SceneError({}, "--reference: " + why.str());
}

}  // namespace

double ConvergenceLog::mostGrowth() { return std::pow(10.0, 1.0 / (2 * kRowsPerDecade)) - 1; }

ConvergenceLog::ConvergenceLog(const Params& params, const Film& film)
    : film_(film), pixels_(params.pixels), onRow_(params.onRow) {
  if (params.reference) {
    const Image reference = placed(*params.reference, film);
    checkReference(reference, film, pixels_);
    reference_ = cutOut(reference, pixels_);
  }
  out_.open(params.file);
  out_ << "# convergence of: " << params.command << '\n';
  for (const Column& c : kColumns) out_ << "# " << c.name << ": " << c.definition << '\n';
  for (const Column& c : kColumns) out_ << c.name << (&c == &kColumns.back() ? '\n' : ',');
  out_.flush();
  if (!out_) throw std::runtime_error("cannot write \"" + params.file.string() + '"');
  out_.precision(9);
}

void ConvergenceLog::afterPass(const RenderResult& result) {
  if (isDue(result)) writeRow(result);
}

void ConvergenceLog::finish(const RenderResult& result) {
  if (result.samplesTaken > samplesOfLastRow_) writeRow(result);
  out_ << "# measuring took " << measuring_.wall << " s (cpu " << measuring_.cpu << " s) for " << rows_
       << " rows, which are in no other number\n";
  out_.close();
  if (!out_) throw std::runtime_error("--convergence: the file could not be written to its end");
}

std::optional<ErrorSummary> ConvergenceLog::error(const RenderResult& result) const {
  if (!reference_) return estimatedError(film_, pixels_, result);
  return std::get<ImageDifference>(compareImages(cutOut(film_.develop(), pixels_), *reference_)).total;
}

void ConvergenceLog::writeRow(const RenderResult& result) {
  const Stopwatch watch;
  nextRow_ = result.seconds * (1 + mostGrowth());
  samplesOfLastRow_ = result.samplesTaken;
  const RenderCounters& c = result.counters;
  const double samples = static_cast<double>(result.samplesTaken) / static_cast<double>(result.pixelsTotal);
  out_ << result.seconds << ',' << result.cpuSeconds << ',' << samples << ',' << c.densityLookups << ','
       << c.rays + c.shadowRays << ',';
  if (const std::optional<ErrorSummary> e = error(result)) {
    out_ << e->mse << ',' << e->rmse << ',' << e->relativeMse << ',' << e->relativeMseRobust << ','
         << e->smape << ',';
    if (reference_) out_ << e->meanSigned;
    out_ << ',' << e->mse * result.seconds << ',';
    if (onRow_) onRow_({result.seconds, samples, *e, reference_.has_value()});
  } else {
    out_ << ",,,,,,,";
  }
  out_ << (reference_ ? "reference" : "halves") << '\n';
  out_.flush();
  ++rows_;
  measuring_ += watch.elapsed();
}

}  // namespace pbrtmedia
