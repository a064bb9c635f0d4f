// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/framed_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vdb2pbrt/pbrt_include.h"

namespace pbrtmedia {
namespace {

constexpr double kAzimuth = 35, kElevation = 11;  // degrees: a three-quarter view from eye height
constexpr double kRoom = 1.18;                    // of the picture, around the box
constexpr int kLongSide = 640;
constexpr double kMinAspect = 0.6, kMaxAspect = 1.8;
constexpr int kShapeSteps = 8;  // sides are multiples of this

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A few digits are enough for a scene that a person will change: multiples of a power of ten.
double rounded(double x, double precision) {
  const double power = std::floor(std::log10(precision));
  return power < 0 ? std::round(x * std::pow(10.0, -power)) / std::pow(10.0, -power)
                   : std::round(x / std::pow(10.0, power)) * std::pow(10.0, power);
}

void putPoint(std::string& out, Vec3d p, double precision) {
  putVector(out, {rounded(p.x, precision), rounded(p.y, precision), rounded(p.z, precision)});
}

int sideOf(double pixels) {
  return std::max(kShapeSteps, static_cast<int>(std::lround(pixels / kShapeSteps)) * kShapeSteps);
}

}  // namespace

Framing framed(const Bounds3d& given, UpAxis upAxis) {
  Bounds3d box = given;
  const double size = length(box.diagonal());
  for (std::size_t a = 0; a < 3; ++a) {
    const double lack = std::max(0.0, 0.01 * size - box.diagonal()[a]) / 2;
    box.min[a] -= lack;
    box.max[a] += lack;
  }
  Framing f;
  f.up = upAxis == UpAxis::Y ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1);
  // Front: where Houdini's and Blender's front views look from.
  const Vec3d front = upAxis == UpAxis::Y ? Vec3d(0, 0, 1) : Vec3d(0, -1, 0), side(1, 0, 0);
  f.toCamera = std::cos(radians(kAzimuth)) * front + std::sin(radians(kAzimuth)) * side;
  f.right = cross(f.up, f.toCamera);
  const Vec3d away = -(std::cos(radians(kElevation)) * f.toCamera + std::sin(radians(kElevation)) * f.up);
  const Vec3d upward = cross(f.right, away);

  double halfWidth = 0, halfHeight = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3d q = box.corner(i) - box.centre();
    halfWidth = std::max(halfWidth, std::abs(dot(q, f.right)));
    halfHeight = std::max(halfHeight, std::abs(dot(q, upward)));
  }
  const double aspect = std::clamp(halfWidth / halfHeight, kMinAspect, kMaxAspect);
  f.width = aspect >= 1 ? kLongSide : sideOf(kLongSide * aspect);
  f.height = aspect >= 1 ? sideOf(kLongSide / aspect) : kLongSide;
  const double shorter = std::tan(radians(f.fov / 2)), across = static_cast<double>(f.width),
               down = static_cast<double>(f.height);
  const double tanX = shorter * std::max(1.0, across / down), tanY = shorter * std::max(1.0, down / across);
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3d q = box.corner(i) - box.centre();
    const double depth = dot(q, away);
    distance = std::max(distance, kRoom * std::abs(dot(q, f.right)) / tanX - depth);
    distance = std::max(distance, kRoom * std::abs(dot(q, upward)) / tanY - depth);
  }
  f.look = box.centre();
  f.eye = f.look - distance * away;
  return f;
}

std::string framedScene(const SceneParams& p) {
  const Framing f = framed(p.box, p.up);
  const double size = length(p.box.diagonal()), precision = 1e-3 * size;
  const Vec3d centre = p.box.centre();
  std::string out = "# Made by vdb2pbrt from " + inComment(p.source) + ": camera, light and ground for " +
                    inComment(p.include) + ", to be changed at will.\n\n";
  // PBRT's camera space is left-handed, the programs that write volumes are not.
  out += "Scale -1 1 1  # a right-handed world\nLookAt ";
  putPoint(out, f.eye, precision);
  out += "  ";
  putPoint(out, f.look, precision);
  out += "  ";
  putVector(out, f.up);
  out += "\nCamera \"perspective\" \"float fov\" ";
  putNumber(out, f.fov);
  out += "\nFilm \"image\" \"integer xresolution\" " + std::to_string(f.width) + " \"integer yresolution\" " +
         std::to_string(f.height) + " \"string filename\" " + quoted(p.image) +
         "\nPixelFilter \"gaussian\" \"float xwidth\" 1.5 \"float ywidth\" 1.5\n"
         "Sampler \"halton\" \"integer pixelsamples\" 64\n"
         "Integrator \"volpath\" \"integer maxdepth\" 60\n\nWorldBegin\n\n";
  const Vec3d key = -0.85 * f.right + 0.6 * f.up + 0.12 * f.toCamera;
  out += p.glows ? "# Dusk: a weak sky, and a moon on the left.\n" : "# The sky, and a sun on the left.\n";
  out += "LightSource \"infinite\" \"rgb L\" [ ";
  out += p.glows ? "0.025 0.035 0.06" : "0.26 0.36 0.52";
  out += " ]\nLightSource \"distant\" \"point from\" [ ";
  putPoint(out, key, 0.01);
  out += " ] \"point to\" [ 0 0 0 ] \"rgb L\" [ ";
  out += p.glows ? "0.12 0.14 0.18" : "4.2 3.7 3.1";
  out += " ]\n\nInclude " + quoted(p.include) + "\n\n";
  const std::size_t axis = p.up == UpAxis::Y ? 1 : 2;
  const double floor = p.box.min[axis] - 0.01 * size;
  out +=
      "# The ground, just below the volume.\nMaterial \"matte\" \"rgb Kd\" [ 0.32 0.3 0.28 ]\n"
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ]\n  \"point P\" [";
  constexpr double kReach = 60;  // in sizes of the volume: to the horizon
  for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Vec3d corner = centre;
    corner.x += kReach * size * a;
    (p.up == UpAxis::Y ? corner.z : corner.y) += kReach * size * b;
    corner[axis] = floor;
    out += "  ";
    putPoint(out, corner, precision);
  }
  out += " ]\n\nWorldEnd\n";
  return out;
}

}  // namespace pbrtmedia
