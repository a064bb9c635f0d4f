// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "base/diagnostics.h"
#include "materials/bsdf_test_support.h"
#include "materials/fourier_sample.h"
#include "materials/fourier_scattering.h"
#include "materials/fourier_table.h"

namespace pbrtmedia {
namespace {

using test::FourierFile;
using test::FourierSample;
using test::polar;

FourierSample sample() { return {.cosines = test::fourierCosines(8)}; }
FourierTable tableOf(const FourierSample& s) { return FourierTable::parse(s.bytes(), "t.bsdf"); }

TEST(FourierScattering, IsTheLawOfItsTable) {
  const FourierTable table = tableOf(sample());
  const FourierScattering law{&table};
  EXPECT_EQ(table.eta(), 1.5f);
  const Vector3f wo = polar(40, 20), mirrored = polar(60, 200), toSide = polar(60, 110),
                 below = -polar(60, 20);
  const float sines = std::sin(radians(40.0f)) * std::sin(radians(60.0f));
  // Light that flies along -wi: seen against its azimuth the mirror direction is that of phi 0.
  EXPECT_NEAR(law.f(wo, mirrored).g, 0.6f * kInvPi * (1 + 0.4f * sines), 2e-3f);
  EXPECT_NEAR(law.f(wo, toSide).g, 0.6f * kInvPi, 2e-3f);
  EXPECT_NEAR(law.f(wo, polar(60, 20)).g, 0.6f * kInvPi * (1 - 0.4f * sines), 2e-3f);
  // Light that goes through keeps its azimuth; radiance is squeezed by the square of the index on its way in.
  EXPECT_NEAR(law.f(wo, below).g, 0.3f * kInvPi * (1 + 0.4f * sines) / sqr(1.5f), 2e-3f);
  EXPECT_NEAR(law.f(-wo, -below).g, 0.3f * kInvPi * (1 + 0.4f * sines) * sqr(1.5f), 5e-3f);
}

TEST(FourierScattering, HasChannels) {
  FourierSample s = sample();
  s.channels = 3;
  const FourierTable table = tableOf(s);
  const Rgb f = FourierScattering{&table}.f(polar(40, 20), polar(60, 110));
  const float y = 0.6f * kInvPi;
  EXPECT_NEAR(f.r, 0.8f * y, 2e-3f);
  EXPECT_NEAR(f.b, 0.6f * y, 2e-3f);
  EXPECT_NEAR(f.g, (1.39829f - 0.100913f * 0.6f - 0.297375f * 0.8f) * y, 2e-3f);
}

TEST(FourierScattering, IsANumberWhereQuotientsAreBeyondAll) {
  FourierSample s = sample();
  s.reflectance = 3e20f;
  const FourierTable table = tableOf(s);
  const FourierScattering law{&table};
  const Vector3f grazing{1, 0, 1e-25f};
  ASSERT_GT(FourierTable::Blend(table, -grazing.z, polar(40, 20).z).value(0).g, 1e15f);
  EXPECT_EQ(law.f(polar(40, 20), grazing), Rgb(0));
  EXPECT_GT(law.f(polar(40, 20), polar(60, 110)).g, 1e19f);
}

TEST(FourierScattering, ReturnsWhatItsTableSays) {
  const FourierTable table = tableOf(sample());
  const FourierScattering law{&table};
  const Lobe lobe(Rgb(1), RareLobe(law));
  for (const Vector3f wo : {polar(10, 0), polar(60, 70)}) {
    const test::RunningStats above = test::albedoBySampling(test::viewOf(lobe, wo), 1, 3, 20000);
    // Reflection, and transmission in the units of radiance.
    const float through = 0.3f / sqr(1.5f);
    const test::ZTest z = test::zTest(above, 0.6 + static_cast<double>(through));
    EXPECT_NEAR(above.mean(), 0.6 + static_cast<double>(through), 5e-3 + 5 * above.standardError()) << z;
  }
}

/// Of laws that are: only splines between their cosines are not, most where sines bend.
TEST(FourierScattering, IsReciprocalAsItsTable) {
  const FourierTable table =
      FourierTable::parse(test::FourierMirror{}.bytes(test::fourierCosines(32, true)), "t.bsdf");
  const FourierTable tilted = tableOf({.eta = 1, .cosines = test::fourierCosines(8, true), .azimuthal = .9f});
  Rng rng(12);
  int compared = 0;
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3f a = sampleUniformSphere({rng.uniform(), rng.uniform()}),
                   b = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const auto isFarFromEnds = [](float z) { return std::abs(z) > .15f && std::abs(z) < .85f; };
    if (!isFarFromEnds(a.z) || !isFarFromEnds(b.z)) continue;
    for (const FourierTable* t : {&table, &tilted}) {
      const float there = FourierScattering{t}.f(a, b).g, back = FourierScattering{t}.f(b, a).g;
      worst = std::max(worst, double{std::abs(there - back)} / std::max(.05, double{there + back} / 2));
      compared += there > .05f ? 1 : 0;
    }
  }
  std::printf("reciprocal but for %.2g\n", worst);
  EXPECT_LT(worst, 1e-2);
  EXPECT_GT(compared, 500);
}

/// What the table was made of, which returns as much.
TEST(FourierScattering, ReturnsWhatFacetsReturn) {
  const test::FourierMirror facets;
  const FourierTable table = FourierTable::parse(facets.bytes(test::fourierCosines(24)), "t.bsdf");
  for (const float degrees : {10.0f, 45.0f, 75.0f}) {
    const Vector3f wo = polar(degrees, 70);
    constexpr int kPoints = 200;
    double truth = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double muI = (i + .5) / kPoints;
      for (int k = 0; k < kPoints; ++k)
        truth += facets.value(muI, double{wo.z}, 2 * double{kPi} * (k + .5) / kPoints);
    }
    truth *= 2 * double{kPi} / (kPoints * kPoints);
    const test::RunningStats albedo = test::albedoBySampling(
        test::viewOf(Lobe(Rgb(1), RareLobe(FourierScattering{&table})), wo), 1, 3, 20000);
    std::printf("%2.0f degrees: %.4f +- %.4f, facets %.4f\n", degrees, albedo.mean(), albedo.standardError(),
                truth);
    EXPECT_NEAR(albedo.mean(), truth, 5e-3 + 5 * albedo.standardError()) << degrees;
  }
}

TEST(FourierTable, OfAnyBytesIsRefusedOrCanBeAsked) {
  const std::string good = FourierSample{.cosines = test::fourierCosines(2)}.bytes();
  Rng rng(77);
  int tables = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string bytes = good;
    for (int k = 0; k < 3; ++k) {
      const float u = rng.uniform(), v = rng.uniform();
      bytes[8 + static_cast<std::size_t>(u * static_cast<float>(bytes.size() - 8))] =
          static_cast<char>(static_cast<int>(v * 256));
    }
    try {
      const FourierTable table = FourierTable::parse(bytes, "t.bsdf");
      ++tables;
      const FourierScattering law{&table};
      const float a = rng.uniform(), b = rng.uniform(), c = rng.uniform(), d = rng.uniform();
      const Vector3f wo = sampleUniformSphere({a, b});
      const LobeSample s = law.sample(wo, {c, d});
      if (s.pdf > 0) {
        EXPECT_NEAR(length(s.wi), 1, 1e-3f);
      }
      EXPECT_GE(law.pdf(wo, sampleUniformSphere({c, d})), 0);
    } catch (const SceneError&) {
      ++refused;
    }
  }
  EXPECT_GT(tables, 100);
  EXPECT_GT(refused, 100);
}

TEST(FourierTable, RefusesWhatIsNone) {
  const auto refusal = [](std::string_view bytes) -> std::string {
    try {
      FourierTable::parse(bytes, "t.bsdf");
    } catch (const SceneError& e) {
      EXPECT_EQ(e.location().toString(), "t.bsdf");
      return e.what();
    }
    return "";
  };
  const std::string good = sample().bytes();
  EXPECT_EQ(refusal(good), "");
  const auto expect = [&](const std::string& bytes, std::string_view what) {
    EXPECT_NE(refusal(bytes).find(what), std::string::npos) << refusal(bytes) << " and not " << what;
  };
  expect("", "does not begin with SCATFUN");
  expect("SCATFUN\x02 and more", "does not begin with SCATFUN");
  for (std::size_t n = 8; n < good.size(); n += 97) expect(good.substr(0, n), "truncated");
  const auto changed = [&](std::size_t word, std::uint32_t to) {
    std::string bytes = good, number;
    FourierFile::append(number, to);
    return bytes.replace(8 + 4 * word, 4, number);
  };
  expect(changed(0, 2), "found 2 as flags, expected 1");
  expect(changed(1, 1), "found 1 cosines");
  expect(changed(1, 0x7fffffff), "cosines, expected 2 to");
  expect(changed(2, 0x7fffffff), "truncated");
  expect(changed(3, 1), "more orders than its header tells");
  expect(changed(4, 2), "found 2 channels");
  expect(changed(4, 4), "found 4 channels");
  expect(changed(5, 2), "found 2 bases");
  expect(changed(9, 0), "index of refraction");
  expect(changed(9, std::bit_cast<std::uint32_t>(-1.5f)), "index of refraction");
  expect(changed(9, std::bit_cast<std::uint32_t>(1e4f)), "not in 0.001 to 1000");
  expect(changed(14, std::bit_cast<std::uint32_t>(-2.0f)), "not in [-1, 1]");
  expect(changed(15, std::bit_cast<std::uint32_t>(-1.0f)), "do not increase");
  expect(changed(15, 0x7fc00000), "cosine that is no finite number");
  const std::size_t cosines = sample().cosines.size(), pairs = 14 + cosines + cosines * cosines;
  expect(changed(pairs, 0xffffffff), "beyond its coefficients");
  expect(changed(pairs + 2 * cosines * cosines, 0x7f800000), "coefficient that is no finite number");
  expect(changed(pairs + 2 * cosines * cosines, std::bit_cast<std::uint32_t>(-2e20f)), "number up to 1e20");
  EXPECT_EQ(refusal(changed(pairs + 2 * cosines * cosines, std::bit_cast<std::uint32_t>(1e20f))), "");
}

}  // namespace
}  // namespace pbrtmedia
