// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/conversion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "construct/attempt.h"
#include "exporters/vdb_samples.h"
#include "fields/grid_field.h"
#include "fields/nano_vdb_field.h"
#include "media/medium.h"
#include "scene/param_reader.h"
#include "scene/parser.h"
#include "support/temporary_folder.h"
#include "vdb2pbrt/describe_volume.h"

namespace pbrtmedia {
namespace {

using test::Attempt;
using test::attemptWorld;
using test::sampledByOpenVdb;
using test::VdbKind;
using test::writeVdb;

class Vdb2Pbrt : public testing::Test {
 protected:
  std::filesystem::path in(const std::string& name) const { return folder_.path() / name; }
  /// Converts t.vdb to t.pbrt and returns all notices.
  std::string convert(VdbKind kind, const ConversionOptions& options = {}) {
    writeVdb(in("t.vdb"), kind);
    std::string notices;
    convertVdb(in("t.vdb"), in("t.pbrt"), options, [&](const std::string& line) { notices += line + '\n'; });
    return notices;
  }
  std::string refusal(VdbKind kind, const ConversionOptions& options = {}) {
    try {
      return "accepted " + convert(kind, options);
    } catch (const std::exception& e) {
      return e.what();
    }
  }
  /// A scene that includes what was made.
  Attempt scene(const std::string& include = "t.pbrt") const {
    return attemptWorld("Include \"" + include + "\"", {.folder = folder_.path()});
  }
  /// Compares a field with OpenVDB's sampler at 1000 points of the field's box.
  template <class Field>
  void expectSampled(const Field& field, const Bounds3d& localBox, int grid, double tolerance) const {
    Rng rng(4);
    std::vector<Vec3d> points;
    for (int n = 0; n < 1000; ++n) {
      const Vec3d d = localBox.diagonal();
      points.push_back(field.worldFromLocal().point(localBox.min + Vec3d(rng.uniformDouble() * d.x,
                                                                         rng.uniformDouble() * d.y,
                                                                         rng.uniformDouble() * d.z)));
    }
    const std::vector<double> expected = sampledByOpenVdb(in("t.vdb"), grid, points);
    ASSERT_EQ(expected.size(), points.size());
    int filled = 0;
    for (std::size_t n = 0; n < points.size(); ++n) {
      filled += expected[n] != 0;
      ASSERT_NEAR(field.density(field.localFromWorld().point(points[n])), expected[n], tolerance)
          << points[n];
    }
    EXPECT_GT(filled, 20);
  }

  TemporaryFolder folder_;
};

/// The samples that a dense include holds, with their transformation.
GridField denseField(const std::filesystem::path& folder) {
  Diagnostics diagnostics;
  std::vector<SceneDescription> worlds =
      parseText(test::kSmall + "WorldBegin Include \"t.pbrt\" WorldEnd", "scene.pbrt", folder, diagnostics);
  MediumDescription& medium = worlds.at(0).media.at(0);
  ParamReader reader(medium, diagnostics, "medium");
  GridField::Params params;
  params.nx = reader.findInt("nx", 0);
  params.ny = reader.findInt("ny", 0);
  params.nz = reader.findInt("nz", 0);
  params.p0 = reader.findPoint3("p0", {});
  params.p1 = reader.findPoint3("p1", {});
  params.density = reader.takeFloats("density");
  return GridField(params, medium.ctm->start);
}

TEST_F(Vdb2Pbrt, RoundTripsEqualOpenVdbsSampler) {
  for (const VdbKind kind : {VdbKind::TilesOnly, VdbKind::NegativeOrigin, VdbKind::Placed, VdbKind::OneVoxel,
                             VdbKind::Half, VdbKind::Double, VdbKind::Background, VdbKind::Inactive}) {
    SCOPED_TRACE(static_cast<int>(kind));
    convert(kind);
    const NanoVdbField field({in("t.nvdb"), "density", {}}, Transform());
    expectSampled(field, field.localBox(), 0, 1e-6);
  }
}

TEST_F(Vdb2Pbrt, KeepsTheIndexBoxBothEndsIncluded) {
  convert(VdbKind::NegativeOrigin);
  const NanoVdbField field({in("t.nvdb"), "", {}}, Transform());
  EXPECT_EQ(field.activeMin(), (Vec3<std::int64_t>(-66, -21, -90)));
  EXPECT_EQ(field.activeMax(), (Vec3<std::int64_t>(59, 64, 63)));
}

TEST_F(Vdb2Pbrt, QuantisedValuesStayWithinTheirSteps) {
  // Values lie in [0, 1.05]: half a step of 65535, 255 or 15, or the tolerance.
  const std::vector<std::pair<NvdbPrecision, double>> steps = {{NvdbPrecision::Fp16, 1.05 / 65535},
                                                               {NvdbPrecision::Fp8, 1.05 / 255},
                                                               {NvdbPrecision::Fp4, 1.05 / 15},
                                                               {NvdbPrecision::FpN, 0.003}};
  for (const auto& [precision, step] : steps) {
    ConversionOptions options;
    options.nvdb.precision = precision;
    options.nvdb.tolerance = 0.003f;
    convert(VdbKind::Placed, options);
    const NanoVdbField field({in("t.nvdb"), "density", {}}, Transform());
    expectSampled(field, field.localBox(), 0, 0.51 * step + (precision == NvdbPrecision::FpN ? 0.0015 : 0));
  }
  // Nothing to pack.
  ConversionOptions options;
  options.nvdb.precision = NvdbPrecision::FpN;
  EXPECT_NE(convert(VdbKind::Empty, options).find("clear"), std::string::npos);
  convert(VdbKind::TilesOnly, options);
  const NanoVdbField field({in("t.nvdb"), "density", {}}, Transform());
  expectSampled(field, field.localBox(), 0, 1e-6);
}

TEST_F(Vdb2Pbrt, DenseIncludesEqualOpenVdbsSampler) {
  for (const DenseForm form : {DenseForm::Inline, DenseForm::Gz}) {
    for (const VdbKind kind : {VdbKind::Placed, VdbKind::OneVoxel, VdbKind::Half}) {
      ConversionOptions options;
      options.dense = form;
      convert(kind, options);
      EXPECT_FALSE(folder_.has("t.nvdb"));
      const Attempt a = scene();
      ASSERT_TRUE(a.isSilent()) << a.messages();
      const GridField field = denseField(folder_.path());
      // Without the half voxel beyond the added samples, where both are 0.
      const Bounds3d box = field.localBox();
      const Vec3d half(0.5, 0.5, 0.5);
      expectSampled(field, {box.min + half, box.max - half}, 0, 1e-5);
    }
  }
}

TEST_F(Vdb2Pbrt, IncludesAreGoodScenesWithABoxAroundTheDensity) {
  for (const VdbKind kind : {VdbKind::TilesOnly, VdbKind::NegativeOrigin, VdbKind::Placed, VdbKind::Empty,
                             VdbKind::OneVoxel, VdbKind::Background}) {
    SCOPED_TRACE(static_cast<int>(kind));
    convert(kind);
    const Attempt a = scene();
    ASSERT_TRUE(a.isSilent()) << a.messages();
    ASSERT_EQ(a.worlds.front().media.size(), 1u);
    EXPECT_EQ(a.worlds.front().media.front().name, "density");
    const NanoVdbField field({in("t.nvdb"), "", {}}, Transform());
    if (kind == VdbKind::Empty) continue;
    // A ray through the middle of the box enters a medium and leaves it where the field's box ends.
    const Vec3d centre = field.localBox().centre(),
                out = centre + Vec3d(2 * field.localBox().diagonal().x, 0.1, 0.2);
    const Vec3d from = field.worldFromLocal().point(out), to = field.worldFromLocal().point(centre);
    const Ray ray{.o = Point3f(from), .d = Vector3f(to - from), .tMax = kInfinity};
    std::uint64_t queries = 0;
    const auto hit = a.made->scene->closest(ray, 0, Exclusions{}, queries);
    ASSERT_TRUE(hit);
    ASSERT_NE(hit->primitive->media.inside, nullptr);
    EXPECT_EQ(hit->primitive->media.outside, nullptr);
    const Vec3d local = field.localFromWorld().point(from + static_cast<double>(hit->t()) * (to - from));
    EXPECT_NEAR(local.x, field.localBox().max.x, 1e-3);
    const SurfaceInteraction si = a.made->scene->surface(*hit, ray);
    EXPECT_GT(dot(si.n, -ray.d), 0.0f) << "the boundary faces outward";
    EXPECT_EQ(hit->primitive->media.inside->typeName(), "nanovdb");
  }
}

TEST_F(Vdb2Pbrt, AnIncludeMovesWithTheTransformationAroundIt) {
  convert(VdbKind::Placed);
  const Attempt a = attemptWorld("Rotate 20 0 1 0 Scale -2 2 2 Translate 1 2 3 Include \"t.pbrt\"",
                                 {.folder = folder_.path()});
  ASSERT_TRUE(a.isSilent()) << a.messages();
  const Bounds3f medium = a.made->scene->bounds();
  EXPECT_FALSE(medium.isEmpty());
}

TEST_F(Vdb2Pbrt, ClampsCountsRefusesOrKeepsNegativeValues) {
  ConversionOptions options;
  const std::string notices = convert(VdbKind::Negative, options);
  EXPECT_NE(notices.find("514 voxels are negative"), std::string::npos) << notices;
  EXPECT_NE(notices.find("they are now 0"), std::string::npos) << notices;
  const NanoVdbField field({in("t.nvdb"), "", {}}, Transform());
  EXPECT_EQ(field.densityAt({-5, 0, 0}), 0.0f);
  EXPECT_EQ(field.densityAt({2, 3, 4}), 0.0f);
  EXPECT_EQ(field.densityAt({2, 3, 5}), 0.75f);
  options.negative = NegativeRule::Error;
  EXPECT_NE(refusal(VdbKind::Negative, options).find("expected >= 0"), std::string::npos);
  options.negative = NegativeRule::Keep;
  EXPECT_NE(convert(VdbKind::Negative, options).find("the renderer will take them as 0"), std::string::npos);
  EXPECT_THROW(NanoVdbField({in("t.nvdb"), "", {}}, Transform()), SceneError);
}

TEST_F(Vdb2Pbrt, RefusesWhatIsNoDensity) {
  EXPECT_NE(refusal(VdbKind::NotANumber).find("grid \"density\": voxel (1, 2, 3) is nan"), std::string::npos)
      << refusal(VdbKind::NotANumber);
  EXPECT_NE(refusal(VdbKind::LevelSet).find("is a level set"), std::string::npos);
  EXPECT_NE(refusal(VdbKind::LevelSet).find("--level-set fog"), std::string::npos);
  EXPECT_NE(refusal(VdbKind::Frustum).find("frustum"), std::string::npos) << refusal(VdbKind::Frustum);
  EXPECT_FALSE(folder_.has("t.nvdb"));
  EXPECT_FALSE(folder_.has("t.pbrt"));
}

TEST_F(Vdb2Pbrt, CountsWhatIsNotFiniteAndMakesItZero) {
  const std::string error = refusal(VdbKind::NotFinite);
  for (const char* part : {"voxel (40, 0, 0) is inf, and 512 more like it", "--nan zero", "t.vdb"}) {
    EXPECT_NE(error.find(part), std::string::npos) << part << " in " << error;
  }
  ConversionOptions options;
  options.nan = NanRule::Zero;
  const std::string notices = convert(VdbKind::NotFinite, options);
  EXPECT_NE(notices.find("513 voxels are no finite number, the first (40, 0, 0) with inf; they are now 0"),
            std::string::npos)
      << notices;
  const NanoVdbField field({in("t.nvdb"), "", {}}, Transform());
  EXPECT_EQ(field.densityAt({1, 2, 3}), 0.0f);
  EXPECT_EQ(field.densityAt({41, 3, 3}), 0.0f);
  EXPECT_EQ(field.densityAt({2, 2, 3}), 0.75f);
  EXPECT_NE(
      convert(VdbKind::NotANumber, options).find("1 voxel is no finite number, the first (1, 2, 3) with nan"),
      std::string::npos);
}

TEST_F(Vdb2Pbrt, MakesFogOfLevelSets) {
  ConversionOptions options;
  options.levelSet = LevelSetRule::Fog;
  EXPECT_NE(convert(VdbKind::SphereLevelSet, options).find("it is a fog volume now"), std::string::npos);
  const NanoVdbField field({in("t.nvdb"), "", {}}, Transform());
  EXPECT_EQ(field.densityAt({2, 0, 0}), 1.0f);
  EXPECT_EQ(field.densityAt({2, 0.5, 0}), 1.0f);
  EXPECT_EQ(field.densityAt({2, 0, 1.15}), 0.0f);
  EXPECT_EQ(field.densityAt({0, 0, 0}), 0.0f);
  const float inBand = field.densityAt({2, 0.85, 0});
  EXPECT_GT(inBand, 0.3f);
  EXPECT_LT(inBand, 0.7f);
  EXPECT_TRUE(scene().isSilent()) << scene().messages();
}

TEST_F(Vdb2Pbrt, NoticesTheBackgroundAndEmptyGrids) {
  EXPECT_NE(convert(VdbKind::Background).find("has the background 0.25"), std::string::npos);
  EXPECT_NE(convert(VdbKind::Empty).find("no active voxels"), std::string::npos);
  EXPECT_EQ(convert(VdbKind::Placed), "");
}

TEST_F(Vdb2Pbrt, ChoosesGridsByNameNumberAndBeginning) {
  test::writeVdbOfManyGrids(in("t.vdb"));
  const auto notice = [](const std::string&) {};
  const auto converted = [&](std::vector<std::string> grids, bool all = false) {
    ConversionOptions options;
    options.grids.densities = std::move(grids);
    options.grids.allDensities = all;
    convertVdb(in("t.vdb"), in("t.pbrt"), options, notice);
    const Attempt a = scene();
    EXPECT_TRUE(a.made.has_value()) << a.messages();
    std::string names;
    for (const MediumDescription& m : a.worlds.front().media) names += m.name + "|";
    return names;
  };
  EXPECT_EQ(converted({"temp"}), "temperature|");
  EXPECT_EQ(converted({"density"}), "density|");
  EXPECT_EQ(converted({"density[1]"}), "density|");
  EXPECT_EQ(NanoVdbField({in("t.nvdb"), "", {}}, Transform()).activeMin(), (Vec3<std::int64_t>(3, -4, 5)));
  EXPECT_EQ(converted({"1"}), "t|") << "a grid without name takes the file's";
  EXPECT_EQ(converted({"with \"quotes\""}), "t|");
  EXPECT_EQ(folder_.read("t.pbrt").find("overlap"), std::string::npos);
  EXPECT_EQ(converted({}, true), "density|t|density-2|t-2|");
  EXPECT_NE(folder_.read("t.pbrt").find("\"string overlap\" \"add\""), std::string::npos);
  // Two grids of one name and two without a plain one are told apart by number.
  EXPECT_EQ(NanoVdbField({in("t.nvdb"), "2", {}}, Transform()).activeMin(), (Vec3<std::int64_t>(3, -4, 5)));
  ConversionOptions options;
  for (const std::string miss : {"Density", "v", "99", ""}) {
    options.grids.densities.assign(miss.empty() ? 0 : 1, miss);
    try {
      convertVdb(in("t.vdb"), in("t.pbrt"), options, notice);
      ADD_FAILURE() << miss;
    } catch (const std::exception& e) {
      EXPECT_NE(std::string(e.what()).find("4: \"temperature\" (float, fog volume, "), std::string::npos)
          << e.what();
      EXPECT_NE(std::string(e.what()).find("t.vdb"), std::string::npos) << e.what();
    }
  }
}

TEST_F(Vdb2Pbrt, GivesTheSameBytesForTheSameGrid) {
  convert(VdbKind::Placed);
  const std::string first = folder_.read("t.nvdb"), text = folder_.read("t.pbrt");
  convert(VdbKind::Placed);
  EXPECT_EQ(first, folder_.read("t.nvdb"));
  EXPECT_EQ(text, folder_.read("t.pbrt"));
}

TEST_F(Vdb2Pbrt, ReadsFilesOfStreams) {
  test::writeVdbStream(in("t.vdb"), VdbKind::Placed);
  ConversionOptions options;
  options.grids.densities = {"1"};
  convertVdb(in("t.vdb"), in("t.pbrt"), options, [](const std::string&) {});
  EXPECT_EQ(NanoVdbField({in("t.nvdb"), "", {}}, Transform()).activeMin(), (Vec3<std::int64_t>(3, -4, 5)));
}

TEST_F(Vdb2Pbrt, ZipFilesAreSmallerAndTheSame) {
  convert(VdbKind::Half);
  const std::size_t plain = folder_.read("t.nvdb").size();
  ConversionOptions options;
  options.nvdb.zip = true;
  convert(VdbKind::Half, options);
  EXPECT_LT(folder_.read("t.nvdb").size(), plain / 2);
  const NanoVdbField field({in("t.nvdb"), "density", {}}, Transform());
  expectSampled(field, field.localBox(), 0, 1e-6);
}

TEST_F(Vdb2Pbrt, NamesOtherFilesVersionsAndTruncations) {
  convert(VdbKind::Placed);
  const std::string whole = folder_.read("t.vdb");
  const auto complaint = [&](const std::string& bytes) -> std::string {
    folder_.write("bad.vdb", bytes);
    try {
      convertVdb(in("bad.vdb"), in("bad.pbrt"), {}, [](const std::string&) {});
    } catch (const std::exception& e) {
      EXPECT_NE(std::string(e.what()).find("bad.vdb"), std::string::npos) << e.what();
      EXPECT_FALSE(folder_.has("bad.pbrt"));
      return e.what();
    }
    return "";
  };
  EXPECT_NE(complaint("").find("not an OpenVDB file"), std::string::npos);
  EXPECT_NE(
      complaint("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n").find("Git LFS pointer"),
      std::string::npos);
  EXPECT_NE(complaint(folder_.read("t.nvdb")).find("a NanoVDB file already"), std::string::npos);
  std::string version = whole;
  version[8] = '\x7f';
  version[9] = '\x01';
  EXPECT_NE(complaint(version).find("format version 383, this program reads 213 to "), std::string::npos)
      << complaint(version);
  version[8] = 100;
  version[9] = 0;
  EXPECT_NE(complaint(version).find("format version 100"), std::string::npos) << complaint(version);
  for (std::size_t size = 12; size < whole.size(); size += size < 200 ? 1 : 997) {
    ASSERT_NE(complaint(whole.substr(0, size)).find("truncated"), std::string::npos)
        << size << " of " << whole.size() << ": " << complaint(whole.substr(0, size));
  }
  // In a file of streams nothing tells where a grid should end.
  test::writeVdbStream(in("t.vdb"), VdbKind::Half);
  const std::string stream = folder_.read("t.vdb");
  for (std::size_t size = 12; size < stream.size(); size += size < 200 ? 1 : 997) {
    ASSERT_NE(complaint(stream.substr(0, size)), "") << size << " of " << stream.size();
  }
  EXPECT_NE(complaint("x").find("not an OpenVDB file"), std::string::npos);
}

TEST_F(Vdb2Pbrt, InfoTellsAllOfAVolume) {
  test::writeVdbOfManyGrids(in("t.vdb"));
  const std::string vdb = describeVolume(in("t.vdb"));
  for (const char* part :
       {"6 grids", "grid 0 \"density\": float, ", "grid 5 \"v\": vec3s", "stored as half",
        "values 0 .. 2, background 0, 1 active voxels in (3, -4, 5) .. (3, -4, 5)", "world from index ["}) {
    EXPECT_NE(vdb.find(part), std::string::npos) << part << " in\n" << vdb;
  }
  convert(VdbKind::OneVoxel);
  const std::string nvdb = describeVolume(in("t.nvdb"));
  for (const char* part :
       {"NanoVDB, 1 grids", "0: \"density\" (float, fog volume, 1 active voxels in [3 -4 5]..[3 -4 5]"}) {
    EXPECT_NE(nvdb.find(part), std::string::npos) << part << " in\n" << nvdb;
  }
}

}  // namespace
}  // namespace pbrtmedia
