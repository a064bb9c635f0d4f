// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/profile.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "base/writable.h"
#include "image/image.h"
#include "tools/medialab/canvas.h"

namespace pbrtmedia {
namespace {

struct Profile {
  LabProblem problem;
  std::vector<std::string> labels;
  std::vector<RecordedEstimate> estimates;
};

ProblemChoice firstChoice(const ProfileOptions& o, const CanonicalFunction& function) {
  return problemChoices(o.problem, function).front();
}

Profile measure(const ProfileOptions& o, const CanonicalFunction& function, LabTable& table) {
  o.problem.check();
  if (o.points < 2) throw std::runtime_error("--points: expected at least 2");
  std::vector<LabTable::Skipped> skipped;
  const std::vector<LabEstimator> estimators = o.selection.select(skipped);
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  noteQuantity(table, estimators);
  const ProblemChoice choice = firstChoice(o, function);
  Profile profile{makeProblem(o.problem, function, choice), {}, {}};
  for (const LabEstimator& e : estimators) {
    if (const std::string why = whyNotApplicable(e, profile.problem.line); !why.empty()) {
      table.skip(e.label(), why);
      continue;
    }
    profile.labels.push_back(e.label());
    profile.estimates.push_back(
        recordEstimate(e, profile.problem, rowSeed(o.lab.seed, e.label(), function.about().name, choice)));
    table.note(e.label() + ": estimate " + formatNumber(profile.estimates.back().value) + " of " +
               formatNumber(profile.problem.exact(e)) + " from " +
               std::to_string(profile.estimates.back().points.size()) + " look-ups");
  }
  return profile;
}

DensityBounds<double> boundAt(const CanonicalLine& line, double s) {
  for (const CanonicalLine::Interval& i : line.intervals()) {
    if (s <= i.sExit) return i.bound;
  }
  return {};
}

std::vector<LabTable::Cell> rowAt(const Profile& profile, const std::string& kind, std::uint64_t index,
                                  double s) {
  const CanonicalLine& line = profile.problem.line;
  const double sigma = profile.problem.sigmaT;
  const DensityBounds<double> bound = boundAt(line, s);
  const auto extinction = [&](double density) { return sigma * density; };
  return {kind,
          index,
          s,
          extinction(line.density(s)),
          extinction(bound.upper),
          extinction(bound.lower),
          bound.hasMean() ? extinction(bound.mean) : std::nan("")};
}

void fill(const ProfileOptions& o, const Profile& profile, LabTable& table) {
  const double length = profile.problem.line.length();
  for (unsigned i = 0; i < o.points; ++i) {
    table.add(rowAt(profile, "field", i, length * i / (o.points - 1)));
  }
  for (std::size_t e = 0; e < profile.estimates.size(); ++e) {
    std::uint64_t index = 0;
    for (const double s : profile.estimates[e].points) {
      table.add(rowAt(profile, profile.labels[e], index++, s));
    }
  }
}

LabTable emptyTable(const ProfileOptions& o) {
  return {o.lab.command, {"kind", "index", "s", "extinction", "upper", "lower", "mean"}};
}

/// The field as a curve, its controls as steps, below it a row of ticks for each estimate.
Image plot(const Profile& profile) {
  constexpr int kWidth = 800, kHeight = 360, kLeft = 70, kTop = 40, kTickRow = 22;
  constexpr Rgb kField{0, 0.35f, 0.75f}, kUpper{0.85f, 0.2f, 0.1f}, kLower{0.1f, 0.55f, 0.2f},
      kMean{0.6f, 0.6f, 0.6f};
  const CanonicalLine& line = profile.problem.line;
  const int rows = static_cast<int>(profile.labels.size());
  LabCanvas canvas(kLeft + kWidth + 220, kTop + kHeight + 40 + rows * kTickRow);
  double top = 0;
  for (const auto& i : line.intervals()) top = std::max(top, i.bound.upper);
  const double width = line.length();
  top = std::max(top, line.function().range().max * line.setup().scale);
  const auto xOf = [&](double s) { return kLeft + s / width * kWidth; };
  const auto yOf = [&](double density) { return kTop + kHeight * (1 - density / top); };
  for (const auto& i : line.intervals()) {
    for (const auto& [density, colour] :
         {std::pair{i.bound.mean, kMean}, {i.bound.lower, kLower}, {i.bound.upper, kUpper}}) {
      if (density < 0) continue;
      const auto pixel = [](double x) { return static_cast<int>(std::lround(x)); };
      const int left = pixel(xOf(i.sEnter)), right = std::max(left + 1, pixel(xOf(i.sExit)));
      canvas.fill(left, pixel(yOf(density)) - 1, right - left, 2, colour);
    }
  }
  for (int x = 0; x < kWidth; ++x) {
    const auto value = [&](int column) { return line.density(width * column / kWidth); };
    canvas.line(kLeft + x, yOf(value(x)), kLeft + x + 1, yOf(value(x + 1)), kField);
  }
  canvas.frame(kLeft, kTop, kWidth, kHeight + 1, kInk);
  canvas.text(kLeft, 10, line.function().about().name + ", depth " + formatNumber(profile.problem.depth()),
              kInk, 2);
  char most[32];
  std::snprintf(most, sizeof most, "%.4g", top * profile.problem.sigmaT);
  canvas.text(kLeft - 6 - LabCanvas::textWidth(most), kTop, most, kInk);
  canvas.text(kLeft - 6 - LabCanvas::textWidth("0"), kTop + kHeight - 7, "0", kInk);
  canvas.text(kLeft, kTop + kHeight + 8, "0", kInk);
  const std::string end = formatNumber(width);
  canvas.text(kLeft + kWidth - LabCanvas::textWidth(end), kTop + kHeight + 8, end, kInk);
  int legend = kTop;
  for (const auto& [name, colour] : {std::pair{"extinction", kField},
                                     {"upper control", kUpper},
                                     {"lower control", kLower},
                                     {"mean", kMean}}) {
    canvas.fill(kLeft + kWidth + 14, legend + 2, 18, 3, colour);
    canvas.text(kLeft + kWidth + 38, legend, name, kInk);
    legend += 14;
  }
  for (std::size_t e = 0; e < profile.labels.size(); ++e) {
    const int y = kTop + kHeight + 30 + static_cast<int>(e) * kTickRow;
    for (const double s : profile.estimates[e].points) {
      canvas.line(xOf(s), y, xOf(s), y + kTickRow - 8, kInk);
    }
    canvas.text(kLeft + kWidth + 14, y + 3, profile.labels[e], kInk);
  }
  return canvas.image();
}

}  // namespace

int runProfile(const ProfileOptions& o) {
  checkOutput(o.lab);
  if (!o.picture.empty() && !isWritableImageName(o.picture)) {
    throw std::runtime_error(o.picture + ": unknown image extension; known: .exr, .pfm, .png, .tga");
  }
  if (!o.picture.empty()) checkWritable(o.picture);
  const CanonicalFunction function = o.function.select().front();
  LabTable table = emptyTable(o);
  const Profile profile = measure(o, function, table);
  fill(o, profile, table);
  if (!o.picture.empty()) writeImage(o.picture, plot(profile));
  writeTable(table, o.lab);
  return 0;
}

}  // namespace pbrtmedia
