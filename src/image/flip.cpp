// SPDX-License-Identifier: BSD-2-Clause
#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace pbrtmedia {
namespace {

using std::numbers::pi;
using Color = std::array<double, 3>;

// Constants of the paper: section 4.1 (contrast sensitivity, table 1), 4.1.3 and 4.3 (exponents, map), 4.2.
constexpr double kColorExponent = 0.7;       // q_c
constexpr double kCompressionStart = 0.4;    // p_c, fraction of the largest colour difference
constexpr double kCompressionTarget = 0.95;  // p_t
constexpr double kFeatureWidth = 0.082;      // w, degrees
constexpr double kFeatureExponent = 0.5;     // q_f

struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;

  Plane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  double at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

/// A kernel over -radius ... radius.
using Kernel = std::vector<double>;

Color toXyz(const Color& c) {
  return {0.4124564 * c[0] + 0.3575761 * c[1] + 0.1804375 * c[2],
          0.2126729 * c[0] + 0.7151522 * c[1] + 0.0721750 * c[2],
          0.0193339 * c[0] + 0.1191920 * c[1] + 0.9503041 * c[2]};
}

const Color kWhite = toXyz({1, 1, 1});

/// The inverse of `toXyz`, by Cramer's rule on its columns.
Color toLinear(const Color& xyz) {
  static const std::array<Color, 3> kColumns{toXyz({1, 0, 0}), toXyz({0, 1, 0}), toXyz({0, 0, 1})};
  const auto det = [](const Color& a, const Color& b, const Color& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - b[0] * (a[1] * c[2] - a[2] * c[1]) +
           c[0] * (a[1] * b[2] - a[2] * b[1]);
  };
  const double d = det(kColumns[0], kColumns[1], kColumns[2]);
  return {det(xyz, kColumns[1], kColumns[2]) / d, det(kColumns[0], xyz, kColumns[2]) / d,
          det(kColumns[0], kColumns[1], xyz) / d};
}

/// Linearised L*a*b*: a luminance and two opponent channels that can be filtered.
Color toOpponent(const Color& linear) {
  const Color n = toXyz(linear);
  const double x = n[0] / kWhite[0], y = n[1] / kWhite[1], z = n[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Color fromOpponent(const Color& o) {
  const double y = (o[0] + 16) / 116, x = y + o[1] / 500, z = y - o[2] / 200;
  return toLinear({x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

/// CIELAB, with chroma shrunk in the dark (Hunt effect).
Color toHuntLab(const Color& linear) {
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const Color n = toXyz(linear);
  const double fx = f(n[0] / kWhite[0]), fy = f(n[1] / kWhite[1]), fz = f(n[2] / kWhite[2]);
  const double l = 116 * fy - 16;
  return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
}

/// Large colour differences in L*a*b*: city block in lightness, Euclidean in chroma (Abasi et al. 2020).
double hyab(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

/// Correlation with `kx` along rows and `ky` along columns; the edge is repeated outwards.
Plane filter(const Plane& in, const Kernel& kx, const Kernel& ky) {
  const int radius = static_cast<int>(kx.size() / 2);
  Plane rows(in.width, in.height), out(in.width, in.height);
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int i = -radius; i <= radius; ++i) {
        sum += kx[static_cast<std::size_t>(i + radius)] * in.at(std::clamp(x + i, 0, in.width - 1), y);
      }
      rows.at(x, y) = sum;
    }
  }
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int i = -radius; i <= radius; ++i) {
        sum += ky[static_cast<std::size_t>(i + radius)] * rows.at(x, std::clamp(y + i, 0, in.height - 1));
      }
      out.at(x, y) = sum;
    }
  }
  return out;
}

/// One Gaussian of a contrast sensitivity function, a sqrt(π/b) e^{-π² d² / b}, d in degrees.
struct Sensitivity {
  double a, b;
};

/// The filter of one opponent channel: a sum of Gaussians, each separable, with total weight 1.
Plane filterChannel(const Plane& in, const std::vector<Sensitivity>& terms, double pixelsPerDegree) {
  constexpr double kWidest = 0.04;  // largest b of the three channels: one radius for all
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * pi * pi)) * pixelsPerDegree));
  std::vector<Kernel> kernels;
  std::vector<double> weights;
  double total = 0;
  for (const Sensitivity& term : terms) {
    Kernel k;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) {
      const double d = i / pixelsPerDegree;
      k.push_back(std::exp(-pi * pi * d * d / term.b));
      sum += k.back();
    }
    kernels.push_back(k);
    weights.push_back(term.a * std::sqrt(pi / term.b));
    total += weights.back() * sum * sum;
  }
  Plane out(in.width, in.height);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const Plane part = filter(in, kernels[t], kernels[t]);
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += weights[t] / total * part.values[i];
  }
  return out;
}

using Planes = std::array<Plane, 3>;

Planes toOpponentPlanes(const Image& image) {
  Planes planes{Plane(image.width(), image.height()), Plane(image.width(), image.height()),
                Plane(image.width(), image.height())};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y);
      if (!c.isFinite()) throw std::invalid_argument("FLIP needs finite values");
      const Rgb shown = c.clamped(0, 1);
      const Color o = toOpponent(
          {static_cast<double>(shown.r), static_cast<double>(shown.g), static_cast<double>(shown.b)});
      for (std::size_t k = 0; k < 3; ++k) planes[k].at(x, y) = o[k];
    }
  }
  return planes;
}

/// What the eye sees of the colours: filtered, back inside the gamut, in Hunt-adjusted L*a*b*.
std::vector<Color> perceivedColors(const Planes& opponent, double pixelsPerDegree) {
  const Plane achromatic = filterChannel(opponent[0], {{1, 0.0047}}, pixelsPerDegree);
  const Plane redGreen = filterChannel(opponent[1], {{1, 0.0053}}, pixelsPerDegree);
  const Plane blueYellow = filterChannel(opponent[2], {{34.1, 0.04}, {13.5, 0.025}}, pixelsPerDegree);
  std::vector<Color> out;
  for (std::size_t i = 0; i < achromatic.values.size(); ++i) {
    Color linear = fromOpponent({achromatic.values[i], redGreen.values[i], blueYellow.values[i]});
    for (double& v : linear) v = std::clamp(v, 0.0, 1.0);
    out.push_back(toHuntLab(linear));
  }
  return out;
}

/// HyAB differences to [0, 1]: the many small ones get most of the range.
double mapColorDifference(double distance) {
  static const double kLargest = std::pow(hyab(toHuntLab({0, 1, 0}), toHuntLab({0, 0, 1})), kColorExponent);
  const double powered = std::pow(distance, kColorExponent), knee = kCompressionStart * kLargest;
  if (powered < knee) return kCompressionTarget / knee * powered;
  return kCompressionTarget + (powered - knee) / (kLargest - knee) * (1 - kCompressionTarget);
}

/// Positive weights to sum 1, negative ones to sum -1.
void normalizeSigned(Kernel& k) {
  double positive = 0, negative = 0;
  for (const double w : k) (w > 0 ? positive : negative) += std::abs(w);
  for (double& w : k) w /= w > 0 ? positive : negative;
}

struct Features {
  std::vector<double> edge, point;  ///< gradient magnitudes
};

/// First and second Gaussian derivatives of the achromatic channel, scaled to [0, 1].
Features detectFeatures(const Plane& achromatic, double pixelsPerDegree) {
  Plane y = achromatic;
  for (double& v : y.values) v = (v + 16) / 116;
  const double sigma = 0.5 * kFeatureWidth * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  Kernel smooth, first, second;
  double total = 0;
  for (int i = -radius; i <= radius; ++i) {
    const double g = std::exp(-0.5 * i * i / (sigma * sigma));
    smooth.push_back(g);
    first.push_back(-i * g);
    second.push_back((i * i / (sigma * sigma) - 1) * g);
    total += g;
  }
  for (double& w : smooth) w /= total;
  normalizeSigned(first);
  normalizeSigned(second);
  const auto magnitude = [&](const Kernel& derivative) {
    const Plane dx = filter(y, derivative, smooth), dy = filter(y, smooth, derivative);
    std::vector<double> out;
    for (std::size_t i = 0; i < dx.values.size(); ++i) out.push_back(std::hypot(dx.values[i], dy.values[i]));
    return out;
  };
  return {magnitude(first), magnitude(second)};
}

}  // namespace

Image flipMap(const Image& reference, const Image& test, double pixelsPerDegree) {
  if (reference.width() != test.width() || reference.height() != test.height() || reference.data().empty()) {
    throw std::invalid_argument("FLIP needs two images of one size");
  }
  if (!reference.hasRgb() || !test.hasRgb()) throw std::invalid_argument("FLIP needs channels R, G, B or Y");
  if (!(pixelsPerDegree > 0) || !std::isfinite(pixelsPerDegree)) {
    throw std::invalid_argument("FLIP needs a positive number of pixels per degree");
  }
  const Planes a = toOpponentPlanes(reference), b = toOpponentPlanes(test);
  const std::vector<Color> colorsA = perceivedColors(a, pixelsPerDegree),
                           colorsB = perceivedColors(b, pixelsPerDegree);
  const Features featuresA = detectFeatures(a[0], pixelsPerDegree),
                 featuresB = detectFeatures(b[0], pixelsPerDegree);
  Image map(reference.width(), reference.height(), {"Y"});
  for (std::size_t i = 0; i < map.data().size(); ++i) {
    const double color = mapColorDifference(hyab(colorsA[i], colorsB[i]));
    const double feature = std::max(std::abs(featuresA.edge[i] - featuresB.edge[i]),
                                    std::abs(featuresA.point[i] - featuresB.point[i]));
    const double amplifier = std::min(1.0, std::pow(feature / std::numbers::sqrt2, kFeatureExponent));
    map.data()[i] = static_cast<float>(std::clamp(std::pow(color, 1 - amplifier), 0.0, 1.0));
  }
  return map;
}

double flipMean(const Image& map) {
  double sum = 0;
  for (const float v : map.data()) sum += static_cast<double>(v);
  return sum / static_cast<double>(map.data().size());
}

}  // namespace pbrtmedia
