// SPDX-License-Identifier: BSD-2-Clause
#include "materials/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "base/math.h"
#include "materials/local_frame.h"
#include "materials/metal.h"

namespace pbrtmedia {
namespace {

TEST(FresnelDielectric, IsFourPercentForGlassAtNormalIncidence) {
  EXPECT_NEAR(fresnelDielectric(1, 1, 1.5f), 0.04f, 1e-7f);
  EXPECT_NEAR(fresnelDielectric(-1, 1, 1.5f), 0.04f, 1e-7f);
  EXPECT_EQ(fresnelDielectric(1, 1.33f, 1.33f), 0);
}

TEST(FresnelDielectric, IsTheMeanOfBothPolarisations) {
  // 45 degrees into 1.5: sin t = 0.471405, Rs = 0.0920134, Rp = Rs².
  EXPECT_NEAR(fresnelDielectric(std::sqrt(0.5f), 1, 1.5f), 0.5f * (0.0920134f + 0.0084665f), 1e-6f);
  // Brewster's angle, tan = 1.5: no parallel part, Rs = ((1 - 2.25) / (1 + 2.25))².
  EXPECT_NEAR(fresnelDielectric(1 / std::sqrt(3.25f), 1, 1.5f), 0.5f * sqr(1.25f / 3.25f), 1e-6f);
}

TEST(FresnelDielectric, ReflectsTotallyBeyondTheCriticalAngle) {
  const float critical = std::asin(1 / 1.5f);
  EXPECT_EQ(fresnelDielectric(-std::cos(critical + 1e-3f), 1, 1.5f), 1);
  EXPECT_LT(fresnelDielectric(-std::cos(critical - 1e-3f), 1, 1.5f), 0.9f);
  EXPECT_EQ(fresnelDielectric(std::cos(critical + 1e-3f), 1.5f, 1), 1);
  EXPECT_NEAR(fresnelDielectric(0, 1, 1.5f), 1, 1e-6f);
}

TEST(FresnelDielectric, IsTheSameFromBothSidesOfARefractedRay) {
  for (float degrees = 1; degrees < 90; degrees += 7) {
    const float sinI = std::sin(radians(degrees)), sinT = sinI / 1.5f;
    const float cosI = std::sqrt(1 - sinI * sinI), cosT = std::sqrt(1 - sinT * sinT);
    // At 85 degrees dF/dcosT is 88: the rounding of cosT alone moves F by 5e-6.
    EXPECT_NEAR(fresnelDielectric(cosI, 1, 1.5f), fresnelDielectric(-cosT, 1, 1.5f), 1e-5f) << degrees;
  }
}

TEST(FresnelConductor, HasTheTextbookValueAtNormalIncidence) {
  const Rgb f = fresnelConductor(1, kCopperEta, kCopperK);
  for (std::size_t c = 0; c < 3; ++c) {
    const float k2 = sqr(kCopperK[c]);
    EXPECT_NEAR(f[c], (sqr(kCopperEta[c] - 1) + k2) / (sqr(kCopperEta[c] + 1) + k2), 1e-6f);
  }
  EXPECT_EQ(f, fresnelConductor(-1, kCopperEta, kCopperK));
}

TEST(FresnelConductor, EqualsTheComplexFormula) {
  using Complex = std::complex<double>;
  for (const auto& [eta, k] : {std::pair{0.2f, 3.9f}, std::pair{1.1f, 2.1f}, std::pair{2.5f, 0.3f}}) {
    for (float degrees = 0; degrees < 90; degrees += 9) {
      const double c = std::cos(radians(static_cast<double>(degrees)));
      const Complex n(static_cast<double>(eta), static_cast<double>(k));
      const Complex ct = std::sqrt(1.0 - (1 - c * c) / (n * n));
      const double expected =
          0.5 * (std::norm((c - n * ct) / (c + n * ct)) + std::norm((n * c - ct) / (n * c + ct)));
      EXPECT_NEAR(fresnelConductor(static_cast<float>(c), Rgb(eta), Rgb(k)).r, expected, 3e-6)
          << eta << ' ' << degrees;
    }
  }
}

TEST(FresnelConductor, EqualsTheDielectricWithoutAbsorption) {
  for (const float c : {1.0f, 0.7f, 0.3f, 0.05f}) {
    EXPECT_NEAR(fresnelConductor(c, Rgb(1.5f), Rgb(0)).g, fresnelDielectric(c, 1, 1.5f), 2e-6f) << c;
  }
  EXPECT_NEAR(fresnelConductor(0, kCopperEta, kCopperK).b, 1, 1e-6f);
  EXPECT_EQ(fresnelConductor(0, Rgb(1), Rgb(0)).r, 0);  // not there at all
}

TEST(Refract, ObeysSnellsLaw) {
  for (const float eta : {1 / 1.5f, 0.9f, 1.2f}) {
    const Vector3f w = normalize(Vector3f{0.3f, 0.4f, 1.0f}), n{0, 0, 1};
    const std::optional<Vector3f> t = refract(w, n, eta);
    ASSERT_TRUE(t);
    EXPECT_NEAR(t->x, -eta * w.x, 1e-6f);
    EXPECT_NEAR(t->y, -eta * w.y, 1e-6f);
    EXPECT_NEAR(length(*t), 1, 1e-6f);
    EXPECT_LT(t->z, 0);
  }
  EXPECT_FALSE(refract(normalize(Vector3f{1, 0, 0.5f}), {0, 0, 1}, 1.5f));
  const Vector3f w = normalize(Vector3f{0.123f, -0.456f, 0.789f});
  EXPECT_EQ(*refract(w, {0, 0, 1}, 1), -w);
}

TEST(SchlickWeight, IsTheFifthPower) {
  EXPECT_EQ(schlickWeight(1), 0);
  EXPECT_EQ(schlickWeight(0), 1);
  EXPECT_EQ(schlickWeight(0.5f), 0.03125f);
  EXPECT_EQ(schlickWeight(2), 0);
  EXPECT_EQ(schlickWeight(-1), 1);
}

}  // namespace
}  // namespace pbrtmedia
