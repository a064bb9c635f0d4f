// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/heatmap_picture.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tools/medialab/canvas.h"

namespace pbrtmedia {
namespace {

using Measure = Heatmap::Measure;

constexpr int kPanel = 220;  ///< least width of a panel's map, pixels
constexpr int kMargin = 14, kAxis = 40, kTitle = 24, kLegend = 300, kBar = 16;
/// The scale covers all values but these shares of the darkest and of the brightest, and no more decades: a
/// few outliers would take the contrast from all maps.
constexpr double kDarkShare = 0.02, kBrightShare = 0.002, kMostDecades = 8;
constexpr int kMostColumns = 6;

const char* titleOf(Measure measure) {
  switch (measure) {
    case Measure::Variance:
      return "variance";
    case Measure::VarianceLookups:
      return "variance * lookups";
    case Measure::VarianceSeconds:
      return "variance * seconds";
  }
  return "";
}

/// Powers of ten that hold the positive values but for outliers.
struct Scale {
  double low = 0, high = 1;
  bool isCutBelow = false, isCutAbove = false;

  explicit Scale(const Heatmap& map, Measure measure) {
    std::vector<double> values;
    for (const Heatmap::Layer& layer : map.layers) {
      for (const Heatmap::Pixel& p : layer.pixels) {
        const double value = p.value(measure);
        if (value > 0 && std::isfinite(value)) values.push_back(std::log10(value));
      }
    }
    if (values.empty()) return;
    std::sort(values.begin(), values.end());
    const auto beyond = [&](double share) {
      return static_cast<std::size_t>(share * static_cast<double>(values.size()));
    };
    high = std::ceil(values[values.size() - 1 - beyond(kBrightShare)]);
    low = std::max(std::floor(values[beyond(kDarkShare)]), high - kMostDecades);
    if (low == high) --low;
    isCutBelow = values.front() < low;
    isCutAbove = values.back() > high;
  }
  Rgb colour(double value) const {
    if (!std::isfinite(value)) return {1, 1, 1};
    if (!(value > 0)) return {0, 0, 0};
    return sequentialColour((std::log10(value) - low) / (high - low));
  }
};

std::string shortNumber(double v) {
  std::string text = formatNumber(std::round(v * 1e4) / 1e4);
  return text;
}

class Picture {
 public:
  Picture(const Heatmap& map, Measure measure, const std::string& function)
      : map_(map),
        measure_(measure),
        scale_(map, measure),
        dot_(std::max(1, (kPanel + std::max(map.width, map.height) - 1) / std::max(map.width, map.height))),
        panelWidth_(std::max(kPanel, map.width * dot_) + kAxis + kMargin),
        panelHeight_(map.height * dot_ + kTitle + kAxis),
        columns_(columnsOf(static_cast<int>(map.layers.size()) + 1)),
        canvas_(columns_ * panelWidth_ + kLegend, kTitle + rows() * panelHeight_ + kMargin) {
    rankLayers();
    canvas_.text(kMargin, 6, std::string(titleOf(measure)) + ", " + function, kInk, 2);
    panel(0, "best unbiased: see legend", [&](std::size_t i) {
      const std::size_t best = map_.best(i, measure_);
      return best == Heatmap::kNoBest ? Rgb{1, 1, 1} : categoricalColour(rank_[best]);
    });
    for (std::size_t l = 0; l < map.layers.size(); ++l) {
      const Heatmap::Layer& layer = map.layers[l];
      panel(l + 1, layer.estimator,
            [&](std::size_t i) { return scale_.colour(layer.pixels[i].value(measure_)); });
    }
    bar();
    legend();
  }
  const Image& image() const { return canvas_.image(); }

 private:
  int rows() const { return (static_cast<int>(map_.layers.size()) + columns_) / columns_; }
  /// A little wider than high.
  static int columnsOf(int panels) {
    return std::min({panels, kMostColumns, 1 + static_cast<int>(std::sqrt(1.5 * panels))});
  }
  /// How often each layer is best.
  std::vector<std::size_t> countBest(Measure measure) const {
    std::vector<std::size_t> counts(map_.layers.size());
    const std::size_t pixels = static_cast<std::size_t>(map_.width) * static_cast<std::size_t>(map_.height);
    for (std::size_t i = 0; i < pixels; ++i) {
      if (const std::size_t best = map_.best(i, measure); best != Heatmap::kNoBest) ++counts[best];
    }
    return counts;
  }
  /// Colours are dealt to the layers that are best most often: the first few differ most. The same in all
  /// pictures of a map, and not by measured times.
  void rankLayers() {
    std::vector<std::size_t> counts = countBest(Measure::Variance);
    const std::vector<std::size_t> more = countBest(Measure::VarianceLookups);
    for (std::size_t l = 0; l < counts.size(); ++l) counts[l] += more[l];
    std::vector<std::size_t> order(counts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return counts[a] > counts[b]; });
    rank_.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) rank_[order[i]] = i;
  }

  template <class Colour>
  void panel(std::size_t number, const std::string& title, const Colour& colour) {
    const int n = static_cast<int>(number);
    const int x0 = n % columns_ * panelWidth_ + kAxis, y0 = kTitle + n / columns_ * panelHeight_ + kTitle;
    const int width = map_.width * dot_, height = map_.height * dot_;
    canvas_.text(x0, y0 - 12, title, kInk);
    for (int y = 0; y < map_.height; ++y) {
      for (int x = 0; x < map_.width; ++x) {
        canvas_.fill(x0 + x * dot_, y0 + y * dot_, dot_, dot_, colour(map_.index(x, y)));
      }
    }
    canvas_.frame(x0, y0, width, height, kInk);
    const std::string right = shortNumber(map_.column(map_.width - 1));
    const char* const answer = !map_.family.empty()                       ? "member"
                               : map_.quantity == Quantity::Transmittance ? "T"
                                                                          : "1/F";
    canvas_.text(x0, y0 + height + 4, shortNumber(map_.column(0)), kInk);
    canvas_.text(x0 + width / 2 - LabCanvas::textWidth(answer) / 2, y0 + height + 4, answer, kInk);
    canvas_.text(x0 + width - LabCanvas::textWidth(right), y0 + height + 4, right, kInk);
    const std::string top = shortNumber(map_.row(0)), bottom = shortNumber(map_.row(map_.height - 1));
    const char* const rows = map_.rows == HeatmapRows::Efficiency ? "eff"
                             : map_.rows == HeatmapRows::Control  ? "ctl"
                                                                  : "tau";
    canvas_.text(x0 - 4 - LabCanvas::textWidth(top), y0, top, kInk);
    canvas_.text(x0 - 4 - LabCanvas::textWidth(rows), y0 + height / 2 - 4, rows, kInk);
    canvas_.text(x0 - 4 - LabCanvas::textWidth(bottom), y0 + height - 8, bottom, kInk);
  }
  void bar() {
    const int x0 = columns_ * panelWidth_ + kMargin, y0 = 2 * kTitle, height = 240;
    canvas_.text(x0, y0 - 18, "scale, powers of ten", kInk);
    for (int y = 0; y < height; ++y) {
      canvas_.fill(x0, y0 + y, kBar, 1, sequentialColour(1 - (y + 0.5) / height));
    }
    canvas_.frame(x0, y0, kBar, height, kInk);
    for (double decade = scale_.low; decade <= scale_.high; ++decade) {
      const int y =
          y0 + static_cast<int>(std::lround((scale_.high - decade) / (scale_.high - scale_.low) * height));
      canvas_.fill(x0 + kBar, y, 4, 1, kInk);
      std::string label = "1e" + formatNumber(decade);
      if (decade == scale_.low && scale_.isCutBelow) label += " and less";
      if (decade == scale_.high && scale_.isCutAbove) label += " and more";
      canvas_.text(x0 + kBar + 8, y - 3, label, kInk);
    }
    canvas_.fill(x0, y0 + height + 14, kBar, 10, {0, 0, 0});
    canvas_.text(x0 + kBar + 8, y0 + height + 15, "0", kInk);
    canvas_.text(x0, y0 + height + 32, "eff = depth / depth of control", kInk);
    canvas_.text(x0, y0 + height + 44, "T = transmittance, " + map_.law, kInk);
  }
  /// The estimators that are best somewhere, most often first.
  void legend() {
    const std::size_t pixels = static_cast<std::size_t>(map_.width) * static_cast<std::size_t>(map_.height);
    std::vector<std::pair<std::size_t, std::size_t>> counts;  // how often, which
    for (const std::size_t count : countBest(measure_)) counts.emplace_back(count, counts.size());
    std::sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    const int x0 = columns_ * panelWidth_ + kMargin;
    int y = 2 * kTitle + 240 + 70;
    canvas_.text(x0, y, "best unbiased, share of the map", kInk);
    for (const auto& [count, layer] : counts) {
      y += 16;
      if (count == 0 || y + 16 > canvas_.image().height()) break;
      const double percent = 100 * static_cast<double>(count) / static_cast<double>(pixels);
      canvas_.fill(x0, y - 2, kBar, 11, categoricalColour(rank_[layer]));
      canvas_.frame(x0, y - 2, kBar, 11, kInk);
      canvas_.text(x0 + kBar + 8, y,
                   formatNumber(std::round(10 * percent) / 10) + "% " + map_.layers[layer].estimator, kInk);
    }
  }

  const Heatmap& map_;
  Measure measure_;
  Scale scale_;
  int dot_, panelWidth_, panelHeight_, columns_;
  LabCanvas canvas_;
  std::vector<std::size_t> rank_;  ///< of each layer, for its colour in the map of the best
};

}  // namespace

Image heatmapChannels(const Heatmap& map, const std::string& command, bool hasSeconds) {
  std::vector<std::pair<Measure, std::string>> measures{{Measure::Variance, "variance"},
                                                        {Measure::VarianceLookups, "variance_lookups"}};
  if (hasSeconds) measures.emplace_back(Measure::VarianceSeconds, "variance_seconds");
  std::vector<std::string> channels;
  std::string names;
  for (const Heatmap::Layer& layer : map.layers) {
    for (const auto& measure : measures) channels.push_back(layer.estimator + '.' + measure.second);
    names += (names.empty() ? "" : ",") + layer.estimator;
  }
  for (const auto& measure : measures) channels.push_back("best." + measure.second);
  Image image(map.width, map.height, channels);
  image.metadata["estimators"] = names;
  image.metadata["command"] = command;
  image.metadata["law"] = map.law;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = map.index(x, y);
      std::size_t c = 0;
      for (const Heatmap::Layer& layer : map.layers) {
        for (const auto& measure : measures) {
          image.at(x, y, c++) = static_cast<float>(layer.pixels[i].value(measure.first));
        }
      }
      for (const auto& measure : measures) {
        const std::size_t best = map.best(i, measure.first);
        image.at(x, y, c++) = best == Heatmap::kNoBest ? -1.0f : static_cast<float>(best);
      }
    }
  }
  return image;
}

Image heatmapPicture(const Heatmap& map, Measure measure, const std::string& function) {
  return Picture(map, measure, function).image();
}

}  // namespace pbrtmedia
