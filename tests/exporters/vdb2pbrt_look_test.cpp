// SPDX-License-Identifier: BSD-2-Clause
// What vdb2pbrt makes of grids that glow, and the scenes it writes.
#include <gtest/gtest.h>

#include <cmath>

#include "construct/attempt.h"
#include "exporters/vdb_samples.h"
#include "media/medium.h"
#include "render/sample_taker.h"
#include "spectrum/spectrum.h"
#include "support/render_scene.h"
#include "support/temporary_folder.h"
#include "vdb2pbrt/conversion.h"
#include "vdb2pbrt/vdb_density.h"
#include "vdb2pbrt/vdb_file.h"

namespace pbrtmedia {
namespace {

using test::Attempt;
using test::VdbKind;

class Vdb2PbrtLook : public testing::Test {
 protected:
  std::filesystem::path in(const std::string& name) const { return folder_.path() / name; }
  /// Converts t.vdb to t.pbrt and returns all notices.
  std::string convert(const ConversionOptions& options) const {
    std::string notices;
    convertVdb(in("t.vdb"), in("t.pbrt"), options, [&](const std::string& line) { notices += line + '\n'; });
    return notices;
  }
  Attempt included() const { return test::attemptWorld("Include \"t.pbrt\"", {.folder = folder_.path()}); }
  Attempt scene() const { return test::attempt(folder_.read("scene.pbrt"), {.folder = folder_.path()}); }
  static Rgb emissionAt(const Attempt& a, Point3f p) {
    RenderCounters counters;
    return a.made->scene->media()[0]->at(p, counters).emission;
  }
  static void expectPart(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  /// Mean luminance of pixels in the middle and in the corners of the scene's picture.
  struct Look {
    double middle = 0, corners = 0;
    std::uint64_t scatterings = 0;
  };
  Look look(const Attempt& a) const {
    Look result;
    const Construction& made = *a.made;
    const std::unique_ptr<Sampler> sampler = made.sampler->clone();
    RenderCounters counters;
    const Bounds2i film = made.film->pixelBounds();
    constexpr int kSide = 12;
    for (int i = 0; i < kSide * kSide; ++i) {
      const auto radiance = [&](int x, int y) {
        return static_cast<double>(
            renderSample(*made.camera, *sampler, test::samplingIntegrator(made), {x, y}, 0, 1, 0, counters)
                .luminance());
      };
      result.corners += radiance(i % kSide, i / kSide) / (kSide * kSide);
    }
    counters = {};
    for (int i = 0; i < kSide * kSide; ++i) {
      const Point2i pixel{film.min.x + film.width() * 3 / 8 + i % kSide * film.width() / 4 / kSide,
                          film.min.y + film.height() * 3 / 8 + i / kSide * film.height() / 4 / kSide};
      result.middle +=
          static_cast<double>(
              renderSample(*made.camera, *sampler, test::samplingIntegrator(made), pixel, 0, 1, 0, counters)
                  .luminance()) /
          (kSide * kSide);
    }
    result.scatterings = counters.mediumScatterings;
    return result;
  }

  TemporaryFolder folder_;
  const Point3f above_{0.05f, 0.6f, 0.1f}, below_{0.05f, -0.6f, 0.1f};
};

TEST_F(Vdb2PbrtLook, TemperaturesMakeTheMediumGlow) {
  test::writeFireVdb(in("t.vdb"), 1800);
  ConversionOptions options;
  options.grids.temperature = "temperature";
  options.sigmaA = Vec3d(1, 2, 3);
  options.leScale = 5;
  const std::string notices = convert(options);
  EXPECT_EQ(notices.find("left out: grid \"temperature\""), std::string::npos) << notices;
  expectPart(notices, "left out: grid \"heat\"");
  const Attempt a = included();
  ASSERT_TRUE(a.isSilent()) << a.messages();
  const Rgb expected = Rgb(1, 2, 3) * blackbodyToRgb(1800, 5).nonNegative();
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(emissionAt(a, above_)[c], expected[c], 2e-3f * expected.max());
  }
  EXPECT_EQ(emissionAt(a, below_), Rgb());
}

TEST_F(Vdb2PbrtLook, NormalisedTemperaturesBecomeKelvinWithANotice) {
  test::writeFireVdb(in("t.vdb"), 0.75f);
  ConversionOptions options;
  options.grids.temperature = "temp";
  const std::string notices = convert(options);
  for (const char* part : {"holds numbers up to 0.75, which are no kelvin", "--temperaturescale 2900",
                           "--Lescale ", "--sigma-a 1 1 1"}) {
    expectPart(notices, part);
  }
  const Attempt a = included();
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_NEAR(emissionAt(a, above_).max(), 6, 0.5) << "sigma_a 1 times the radiance of the hottest parts";
  options.temperatureScale = 2000;
  options.leScale = 1;
  EXPECT_EQ(convert(options).find("which are no kelvin"), std::string::npos);
  EXPECT_NEAR(emissionAt(included(), above_).r, blackbodyToRgb(1500, 1).r, 2e-3f * blackbodyToRgb(1500, 1).r);
  options.temperatureScale = 100;
  expectPart(convert(options), "stays at or below 100 K: nothing glows");
  // Less an offset of a quarter the hottest is a half: what makes 2200 K of that is told.
  ConversionOptions shifted;
  shifted.grids.temperature = "temp";
  shifted.temperatureOffset = 0.25f;
  expectPart(convert(shifted), "--temperaturescale 4400");
}

TEST_F(Vdb2PbrtLook, QuantilesCountVoxelsFromTheSmallest) {
  test::writeVdb(in("t.vdb"), VdbKind::TilesOnly);  // 128^3 voxels of 0.5, 3072 of 1.25
  const VdbDensity grid = VdbFile(in("t.vdb")).read(0);
  constexpr float kBin = 1.25f / 4096;
  for (const double most : {0.001, 0.5, 0.998}) EXPECT_NEAR(grid.quantile(most), 0.5f, kBin) << most;
  for (const double few : {0.999, 1.0}) EXPECT_NEAR(grid.quantile(few), 1.25f, kBin) << few;
}

TEST_F(Vdb2PbrtLook, FactorsAloneAndWithTemperatures) {
  test::writeFireVdb(in("t.vdb"), 1800);
  ConversionOptions options;
  options.grids.factor = "heat";
  options.le = Vec3d(4, 2, 1);
  options.leScale = 3;
  convert(options);
  EXPECT_EQ(emissionAt(included(), below_), Rgb(6, 3, 1.5f));
  EXPECT_EQ(emissionAt(included(), above_), Rgb());
  // Both: only what is hot and burns, which here meets nowhere but at the seam.
  options.grids.temperature = "temperature";
  options.le = std::nullopt;
  const std::string notices = convert(options);
  EXPECT_EQ(notices.find("left out: grid"), std::string::npos) << notices;
  const Attempt both = included();
  ASSERT_TRUE(both.isSilent()) << both.messages();
  EXPECT_EQ(emissionAt(both, above_), Rgb());
  EXPECT_EQ(emissionAt(both, below_), Rgb());
}

TEST_F(Vdb2PbrtLook, DenseIncludesGlowAsTheSparseOnesDo) {
  test::writeFireVdb(in("t.vdb"), 1800);
  for (const bool withFactors : {false, true}) {
    ConversionOptions options;
    options.grids.temperature = "temperature";
    if (withFactors) options.grids.factor = "density";
    options.leScale = 5;
    convert(options);
    const Rgb sparse = emissionAt(included(), above_);
    options.dense = DenseForm::Inline;
    convert(options);
    const Attempt dense = included();
    ASSERT_TRUE(dense.isSilent()) << dense.messages();
    EXPECT_GT(sparse.r, 0.1f);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(emissionAt(dense, above_)[c], sparse[c], 2e-3f * sparse.r);
    EXPECT_EQ(emissionAt(dense, below_), Rgb());
  }
}

TEST_F(Vdb2PbrtLook, SaysWhatGlowsWhereNoDensityIs) {
  test::writeFireVdb(in("t.vdb"), 1800);
  ConversionOptions options;
  options.grids.densities = {"heat"};         // below
  options.grids.temperature = "temperature";  // above
  expectPart(convert(options),
             "100 % of what is bright in grid \"temperature\" lies where there is no density");
}

TEST_F(Vdb2PbrtLook, ScenesShowTheVolumeAsTheyStand) {
  for (const bool glows : {false, true}) {
    SCOPED_TRACE(glows);
    test::writeFireVdb(in("t.vdb"), 0.75f);
    ConversionOptions options;
    options.scene = in("scene.pbrt");
    if (glows) options.grids.temperature = "temperature";
    const std::string notices = convert(options);
    // sigma_t is 2 with emission and 1.03 without; a ray meets up to some 2.5 units of density 1.
    expectPart(notices, glows ? "for an optical depth of about 3" : "for an optical depth of about 8");
    const Attempt a = scene();
    ASSERT_TRUE(a.isSilent()) << a.messages();
    const Look seen = look(a);
    EXPECT_GT(seen.scatterings, 20u) << "the volume is in the middle";
    EXPECT_GT(seen.middle, 0.2);
    EXPECT_LT(seen.middle, 8);
    EXPECT_GT(seen.corners, glows ? 0.01 : 0.1);
    EXPECT_LT(seen.corners, 1);
    EXPECT_GT(seen.middle, (glows ? 10 : 0) * seen.corners);
  }
}

TEST_F(Vdb2PbrtLook, ScenesSuitThinAndDenseAndTinyVolumes) {
  for (const VdbKind kind : {VdbKind::OneVoxel, VdbKind::TilesOnly, VdbKind::Placed, VdbKind::Empty}) {
    SCOPED_TRACE(static_cast<int>(kind));
    test::writeVdb(in("t.vdb"), kind);
    ConversionOptions options;
    options.scene = in("scene.pbrt");
    const std::string notices = convert(options);
    const Attempt a = scene();
    ASSERT_TRUE(a.isSilent()) << a.messages();
    if (kind == VdbKind::Empty) continue;
    expectPart(notices, "for an optical depth of about 8");
    // What a ray through the middle passes: neither nothing nor a wall.
    EXPECT_GT(look(a).scatterings, 3u);
  }
  test::writeVdb(in("t.vdb"), VdbKind::Placed);
  ConversionOptions options;
  options.scene = in("scene.pbrt");
  options.scale = 1e6;
  expectPart(convert(options), "it looks solid");
  options.scale = 1e-6;
  expectPart(convert(options), "it is hardly seen");
}

TEST_F(Vdb2PbrtLook, OneLookServesASequence) {
  test::writeFireVdb(in("t.vdb"), 0.75f);
  ConversionOptions options;
  options.scene = in("scene.pbrt");
  options.grids.temperature = "temperature";
  const ConversionOptions common = settled(in("t.vdb"), options, [](const std::string&) {});
  EXPECT_NEAR(*common.temperatureScale, 2900, 1e-9);
  test::writeFireVdb(in("t.vdb"), 0.5f);
  EXPECT_EQ(convert(common),
            "left out: grid \"heat\"; it looks like what burns: --Legrid \"heat\" makes the medium "
            "glow by it\nleft out, vectors, masks and the like: \"vel\" (vec3s), \"mask\" (bool)\n");
  expectPart(folder_.read("t.pbrt"), "\"float temperaturescale\" 2900");
  const Bounds3d box = boxOfDensities(in("t.vdb"), common);
  EXPECT_NEAR(box.min.x, -1.1, 1e-6);
  EXPECT_NEAR(box.max.z, 1.0, 1e-6);
}

}  // namespace
}  // namespace pbrtmedia
