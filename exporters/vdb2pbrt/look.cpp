// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/look.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "spectrum/spectrum.h"

namespace pbrtmedia {
namespace {

constexpr double kDark = 100;  // kelvin: the renderer shows nothing of bodies up to there
constexpr Vec3d kFlameColour{1, 0.36, 0.08};

/// Two digits: numbers that a person will read and change.
double twoDigits(double x) {
  if (!(x > 0) || !std::isfinite(x)) return x;
  std::ostringstream text;
  text.precision(2);
  text << x;
  return std::stod(text.str());
}

std::string shown(double x) {
  std::ostringstream text;
  text.precision(4);
  text << x;
  return text.str();
}

double shortestVoxel(const VdbDensity& density) {
  double shortest = length(density.worldFromIndex().vector(Vec3d(1, 0, 0)));
  shortest = std::min(shortest, length(density.worldFromIndex().vector(Vec3d(0, 1, 0))));
  return std::min(shortest, length(density.worldFromIndex().vector(Vec3d(0, 0, 1))));
}

/// Integrals of the density along parallel rays through the volume in the direction of a camera, those that
/// meet nothing left out; rising.
std::vector<double> columns(const Volume& volume, UpAxis up) {
  constexpr int kRays = 48;         // along each side
  constexpr int kMostSteps = 1024;  // along a ray
  const Bounds3d box = volume.box();
  std::vector<double> result;
  if (box.isEmpty()) return result;
  const Framing f = framed(box, up);
  const Vec3d away = normalize(f.look - f.eye), right = f.right, upward = cross(right, away);
  const double radius = length(box.diagonal()) / 2;
  for (int i = 0; i < kRays * kRays; ++i) {
    const int column = i % kRays, row = i / kRays;
    const double x = (2 * (column + 0.5) / kRays - 1) * radius, y = (2 * (row + 0.5) / kRays - 1) * radius;
    const Vec3d middle = box.centre() + x * right + y * upward;
    double sum = 0;
    for (const VdbDensity& density : volume.densities()) {
      const int steps = static_cast<int>(
          std::clamp(2 * radius / shortestVoxel(density), 16.0, static_cast<double>(kMostSteps)));
      sum += density.integral(middle - radius * away, middle + radius * away, steps);
    }
    if (sum > 0) result.push_back(sum);
  }
  std::sort(result.begin(), result.end());
  return result;
}

double largest(Vec3d v) { return std::max({v.x, v.y, v.z}); }

void chooseScale(const Volume& volume, ConversionOptions& o, const Notice& notice) {
  const double sigmaT = largest(*o.sigmaA + *o.sigmaS);
  if (o.scene.empty()) {
    if (!o.scale) o.scale = 1;
    return;
  }
  const std::vector<double> rays = columns(volume, *o.up);
  if (rays.empty() || sigmaT == 0) {
    if (!o.scale) o.scale = 1;
    return;
  }
  const double thick = rays[rays.size() * 9 / 10];
  if (!o.scale) {
    o.scale = twoDigits((volume.glows() ? kGlowDepth : kSceneDepth) / (sigmaT * thick));
    notice("--scale " + shown(*o.scale) + ", for an optical depth of about " +
           shown(twoDigits(*o.scale * sigmaT * thick)) + " through the volume");
  } else if (const double depth = *o.scale * sigmaT * thick; depth < 0.05 || depth > 500) {
    notice("the optical depth through the volume is about " + shown(twoDigits(depth)) +
           (depth < 1 ? ": it is hardly seen" : ": it looks solid") +
           "; without --scale a fitting one is chosen");
  }
}

void chooseTemperatures(const Volume& volume, ConversionOptions& o, const Notice& notice) {
  if (!volume.temperature) {
    if (!o.temperatureScale) o.temperatureScale = 1;
    return;
  }
  const VdbDensity& grid = volume.grids[*volume.temperature];
  const double most = static_cast<double>(grid.range().max) - o.temperatureOffset;
  if (!o.temperatureScale) {
    o.temperatureScale = 1;
    if (most > 0 && most <= kDark) {
      o.temperatureScale = twoDigits(kHottest / most);
      notice("grid \"" + grid.name() + "\" holds numbers up to " + shown(double{grid.range().max}) +
             ", which are no kelvin: --temperaturescale " + shown(*o.temperatureScale) +
             " makes the hottest about " + shown(kHottest) + " K");
    }
  }
  if (!(most * *o.temperatureScale > kDark)) {
    notice("grid \"" + grid.name() + "\" stays at or below " + shown(kDark) +
           " K: nothing glows (--temperaturescale, --temperatureoffset)");
  }
}

/// What 95 of 100 voxels do not exceed, but at least `share` of the largest value: of a fire that has cooled
/// down for the most part the flames count.
double highValue(const VdbDensity& grid, double share) {
  constexpr double kMost = 0.95;
  return std::max(double{grid.quantile(kMost)}, share * double{grid.range().max});
}

void chooseRadiance(const Volume& volume, ConversionOptions& o, const Notice& notice) {
  if (!o.le) o.le = kFlameColour;
  if (o.leScale) return;
  double radiance = largest(*o.le);
  if (volume.temperature) {
    const double value = highValue(volume.grids[*volume.temperature], 0.75);
    const double kelvin = (value - o.temperatureOffset) * *o.temperatureScale;
    radiance = kelvin > kDark ? double{blackbodyToRgb(static_cast<float>(kelvin), 1).max()} : 0;
  }
  if (volume.factor) radiance *= highValue(volume.grids[*volume.factor], 0.3);
  o.leScale = radiance > 0 ? twoDigits(kRadiance / radiance) : 1;
  if (radiance > 0) {
    notice("--Lescale " + shown(*o.leScale) + ", for a radiance of about " + shown(kRadiance) + " in the " +
           (volume.temperature ? "hottest" : "brightest") + " parts");
  }
}

/// What glows beside the density stays dark.
void noticeDark(const Volume& volume, const Notice& notice) {
  const VdbDensity& grid = volume.grids[volume.factor ? *volume.factor : *volume.temperature];
  double share = 1;
  for (const VdbDensity& density : volume.densities()) {
    share = std::min(share, grid.shareOutside(density, grid.quantile(0.95) / 2));
  }
  constexpr double kMuch = 0.1;
  if (share < kMuch) return;
  notice(shown(std::round(100 * share)) + " % of what is bright in grid \"" + grid.name() +
         "\" lies where there is no density, and stays dark: the medium emits sigma_a times density times "
         "radiance. --grid may name a second grid, the flames, for a density of their own");
}

}  // namespace

ConversionOptions lookFor(const Volume& volume, const ConversionOptions& options, const Notice& notice) {
  ConversionOptions o = options;
  if (!o.up) o.up = volume.creator.find("Blender") != std::string::npos ? UpAxis::Z : UpAxis::Y;
  if (!o.sigmaS) o.sigmaS = Vec3d(1, 1, 1);
  if (!o.sigmaA && volume.glows()) notice("--sigma-a 1 1 1, for what absorbs nothing emits nothing");
  if (!o.sigmaA)
    o.sigmaA = volume.glows() ? Vec3d(1, 1, 1) : o.scene.empty() ? Vec3d(0, 0, 0) : Vec3d(.03, .03, .03);
  if (volume.glows() && largest(*o.sigmaA) == 0) notice("sigma_a is 0: what absorbs nothing emits nothing");
  chooseScale(volume, o, notice);
  if (!volume.glows()) return o;
  chooseTemperatures(volume, o, notice);
  chooseRadiance(volume, o, notice);
  noticeDark(volume, notice);
  return o;
}

}  // namespace pbrtmedia
