// SPDX-License-Identifier: BSD-2-Clause
#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace pbrtmedia {
namespace {

/// Sums of one channel; mean values come out at the end.
class Accumulator {
 public:
  /// Answers the relative squared error.
  double add(double test, double reference, Point2i pixel, double epsilon) {
    const double d = test - reference, relative = d * d / (reference * reference + epsilon);
    test_ += test;
    reference_ += reference;
    signed_ += d;
    squared_ += d * d;
    relative_ += relative;
    if (d != 0) smape_ += std::abs(d) / ((std::abs(test) + std::abs(reference)) / 2);
    if (std::abs(d) > maxAbs_) {
      maxAbs_ = std::abs(d);
      maxAt_ = pixel;
    }
    return relative;
  }
  void add(const Accumulator& o) {
    test_ += o.test_;
    reference_ += o.reference_;
    signed_ += o.signed_;
    squared_ += o.squared_;
    relative_ += o.relative_;
    smape_ += o.smape_;
  }
  void fill(ErrorSummary& out, double count) const {
    out.meanTest = test_ / count;
    out.meanReference = reference_ / count;
    out.meanSigned = signed_ / count;
    out.mse = squared_ / count;
    out.rmse = std::sqrt(out.mse);
    out.relativeMse = relative_ / count;
    out.smape = smape_ / count;
    out.maxAbs = maxAbs_;
    out.maxAt = maxAt_;
  }

 private:
  double test_ = 0, reference_ = 0, signed_ = 0, squared_ = 0, relative_ = 0, smape_ = 0, maxAbs_ = 0;
  Point2i maxAt_;
};

/// Mean of what pixels have each, without the worst; changes their order.
double robustMean(std::vector<double>& ofPixels) {
  const std::size_t dropped = (ofPixels.size() + kPixelsPerWorst - 1) / kPixelsPerWorst;
  if (dropped == ofPixels.size()) return 0;
  const auto end = ofPixels.end() - static_cast<std::ptrdiff_t>(dropped);
  std::nth_element(ofPixels.begin(), end, ofPixels.end());
  return std::accumulate(ofPixels.begin(), end, 0.0) / static_cast<double>(end - ofPixels.begin());
}

std::optional<std::string> whyNotComparable(const Image& test, const Image& reference) {
  std::ostringstream why;
  if (test.width() != reference.width() || test.height() != reference.height()) {
    why << "different sizes: " << test.width() << " x " << test.height() << " and " << reference.width()
        << " x " << reference.height();
    return why.str();
  }
  if (test.data().empty()) return "images without pixels";
  for (const std::string& c : reference.channels()) {
    if (!test.channelIndex(c)) return "channel \"" + c + "\" is missing in the first image";
  }
  for (const std::string& c : test.channels()) {
    if (!reference.channelIndex(c)) return "channel \"" + c + "\" is missing in the second image";
  }
  return std::nullopt;
}

std::optional<std::string> firstNonFinite(const Image& image, const char* which) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (std::size_t c = 0; c < image.channelCount(); ++c) {
        const float v = image.at(x, y, c);
        if (std::isfinite(v)) continue;
        std::ostringstream why;
        why << "the " << which << " image has the value " << v << " at pixel (" << x << ", " << y
            << "), channel \"" << image.channels()[c] << "\"";
        return why.str();
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::variant<ImageDifference, ComparisonFailure> compareImages(const Image& test, const Image& reference,
                                                               double epsilon) {
  if (!(epsilon > 0)) throw std::invalid_argument("the epsilon of the relative error must be above 0");
  if (auto why = whyNotComparable(test, reference)) return ComparisonFailure{*why};
  if (auto why = firstNonFinite(test, "first")) return ComparisonFailure{*why};
  if (auto why = firstNonFinite(reference, "second")) return ComparisonFailure{*why};

  const std::size_t channels = reference.channelCount();
  std::vector<std::size_t> inTest;
  for (const std::string& name : reference.channels()) inTest.push_back(*test.channelIndex(name));
  std::vector<Accumulator> sums(channels);
  // Relative errors by channel, and their mean over the channels, of all pixels.
  std::vector<std::vector<double>> relative(channels + 1);
  ImageDifference result;
  result.epsilon = epsilon;
  for (int y = 0; y < reference.height(); ++y) {
    for (int x = 0; x < reference.width(); ++x) {
      bool differs = false;
      double sum = 0;
      for (std::size_t c = 0; c < channels; ++c) {
        const float a = test.at(x, y, inTest[c]), b = reference.at(x, y, c);
        differs |= a != b;
        relative[c].push_back(sums[c].add(static_cast<double>(a), static_cast<double>(b), {x, y}, epsilon));
        sum += relative[c].back();
      }
      relative[channels].push_back(sum / static_cast<double>(channels));
      if (differs) ++result.differingPixels;
    }
  }

  const double pixels = static_cast<double>(reference.width()) * static_cast<double>(reference.height());
  Accumulator all;
  for (std::size_t c = 0; c < channels; ++c) {
    ChannelError e;
    e.channel = reference.channels()[c];
    sums[c].fill(e, pixels);
    e.relativeMseRobust = robustMean(relative[c]);
    result.channels.push_back(e);
    all.add(sums[c]);
  }
  all.fill(result.total, pixels * static_cast<double>(channels));
  result.total.relativeMseRobust = robustMean(relative[channels]);
  result.maxChannel = reference.channels().front();
  for (const ChannelError& e : result.channels) {
    if (e.maxAbs > result.total.maxAbs) {
      result.total.maxAbs = e.maxAbs;
      result.total.maxAt = e.maxAt;
      result.maxChannel = e.channel;
    }
  }
  return result;
}

}  // namespace pbrtmedia
