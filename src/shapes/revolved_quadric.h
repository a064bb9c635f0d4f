// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/quadric.h"

namespace pbrtmedia {

/// A quadric of revolution about z: x² + y² = c0 + c1 z + c2 z² for zMin <= z <= zMax and azimuth phi from 0
/// to phiMax, u = phi / phiMax. Everything except the disk.
class RevolvedQuadric : public Quadric {
 protected:
  struct Profile {
    double c0 = 0, c1 = 0, c2 = 0;  ///< squared radius as a polynomial in z
    double zMin = 0, zMax = 0;      ///< zMin < zMax; the squared radius is >= 0 between
    double gap = 0;                 ///< but where |z| < gap; 0: no gap
    double phiMax = 0;              ///< radians, (0, 2 pi]
    bool clipsZ = true;             ///< false: nothing of the unclipped surface lies outside [zMin, zMax]
    /// Sign of dp/du x dp/dv against the gradient of x² + y² - squared radius.
    double normalSign = 1;
    double radiusSquared(double z) const { return c0 + z * (c1 + z * c2); }
    double slope(double z) const { return c1 + 2 * c2 * z; }  ///< d(radius²)/dz
  };
  RevolvedQuadric(const ShapePlacement& placement, const Profile& profile);

  /// v at height z, and its inverse derivatives dz/dv, d²z/dv².
  virtual double vAt(double z) const = 0;
  struct HeightDerivatives {
    double first, second;
  };
  virtual HeightDerivatives heightDerivatives(double z) const = 0;
  /// Azimuth at which phi = 0 lies at height z (the hyperboloid's segment turns).
  virtual double phase(double) const { return 0; }

  Bounds3d objectBounds() const final;
  std::array<double, 3> lineEquation(Vec3d o, Vec3d d) const final;
  Vec3d project(Vec3d p) const final;
  bool contains(Vec3d p) const final;
  Point2d parameters(Vec3d p) const final;
  Vec3d normal(Vec3d p) const override { return surfaceNormal(p); }
  Vec3d surfaceNormal(Vec3d p) const final;
  Derivatives derivatives(Vec3d p) const override;
  double objectArea() const final { return area_; }
  Vec3d sampleObject(Point2d u) const final;

  const Profile& profile() const { return profile_; }
  /// Azimuth of p in [0, 2 pi), counted from `phase`.
  double azimuth(Vec3d p) const;

 private:
  /// Antiderivative of the arc-length-weighted radius r sqrt(1 + r'²): area below z is 2 pi times it.
  double bandArea(double z) const;
  double bandAreaWithoutGap(double z) const;
  double heightOfBand(double u) const;

  Profile profile_;
  double largestRadius_;
  double a2_, a1_, a0_;  ///< (r sqrt(1 + r'²))² = a2 z² + a1 z + a0
  double bandMin_, bandMax_;
  double area_;
};

}  // namespace pbrtmedia
