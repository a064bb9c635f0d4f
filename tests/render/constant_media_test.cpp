// SPDX-License-Identifier: BSD-2-Clause
// One constant medium in every storage that scenes know: they must look the same.
#include <gtest/gtest.h>

#include "support/render_scene.h"
#include "support/temporary_folder.h"
#ifdef PBRT_MEDIA_HAS_NANOVDB
#include "fields/nano_vdb_samples.h"
#endif

namespace pbrtmedia::test {
namespace {

/// Everything a medium "m" of density 1 in the cube [0, 1]³ has but its coefficients.
struct Stored {
  const char* name;
  std::string (*parameters)(const TemporaryFolder& folder);
};

std::string ones(int n) {
  std::ostringstream os;
  os << "\"string type\" \"heterogeneous\" \"string border\" \"clamp\" \"integer nx\" " << n
     << " \"integer ny\" " << n << " \"integer nz\" " << n << " \"float density\" [";
  for (int i = 0; i < n * n * n; ++i) os << " 1";
  os << " ] ";
  return os.str();
}
const std::string kSlab =
    "\"string type\" \"analytic\" \"string function\" \"slab\" \"float from\" -1 \"float to\" 2 ";

const Stored kStored[] = {
    {"Homogeneous", [](const TemporaryFolder&) { return std::string("\"string type\" \"homogeneous\" "); }},
    {"OneVoxel", [](const TemporaryFolder&) { return ones(1); }},
    {"Grid64", [](const TemporaryFolder&) { return ones(64); }},
    {"HalfPrecision", [](const TemporaryFolder&) { return ones(8) + "\"string precision\" \"half\" "; }},
    {"Analytic", [](const TemporaryFolder&) { return kSlab; }},
    {"AnalyticUnderALooseBound",
     [](const TemporaryFolder&) { return kSlab + "\"string bounds\" \"constant\" \"float majorant\" 9 "; }},
    {"Texture",
     [](const TemporaryFolder&) {
       return std::string(
           "\"string type\" \"texture\" \"float density\" 1 \"string bounds\" \"constant\" "
           "\"float majorant\" 9 ");
     }},
#ifdef PBRT_MEDIA_HAS_NANOVDB
    {"NanoVdbTile",
     [](const TemporaryFolder& folder) {
       // Voxels 0..127 and two more around, which the cube [0, 1]³ does not reach.
       writeNanoVdb(folder.path() / "tile.nvdb",
                    {{.min = {-8, -8, -8},
                      .max = {135, 135, 135},
                      .worldFromIndex = Transform::scale(1. / 127, 1. / 127, 1. / 127)}});
       return std::string("\"string type\" \"nanovdb\" \"string filename\" \"tile.nvdb\" ");
     }},
#endif
};

class ConstantMedia : public testing::TestWithParam<Stored> {
 protected:
  Rendered render(double sigmaA, double sigmaS, std::uint64_t seed, const std::string& more = "") const {
    std::ostringstream medium;
    medium << "MakeNamedMedium \"m\" " << GetParam().parameters(folder_) << more << " \"rgb sigma_a\" [ "
           << sigmaA << ' ' << sigmaA << ' ' << sigmaA << " ] \"rgb sigma_s\" [ " << sigmaS << ' ' << sigmaS
           << ' ' << sigmaS << " ]\n";
    return renderText(
        pencil(16, 64, "\"volpath\" \"integer maxdepth\" 20", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .4) +
            "WorldBegin\n" + kWhiteEnvironment + medium.str() + mediumBox("m", {0, 0, 0}, {1, 1, 1}) +
            "WorldEnd\n",
        {.seed = seed}, folder_.path());
  }
  TemporaryFolder folder_;
};

RunningStats pixelsOf(const Image& image) {
  RunningStats stats;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) stats.add(static_cast<double>(image.at(x, y, 0)));
  }
  return stats;
}

TEST_P(ConstantMedia, AbsorbsExponentially) {
  const RunningStats pixels = pixelsOf(render(1.5, 0, 1).image);
  if (pixels.variance() == 0) {
    EXPECT_NEAR(pixels.mean(), std::exp(-1.5), 2e-6);
    return;
  }
  const ZTest test = zTest(pixels, std::exp(-1.5), 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST_P(ConstantMedia, ScattersAsTheHomogeneousOne) {
  RunningStats here, reference;
  const auto means = [&](const char* parameters, RunningStats& to, std::uint64_t firstSeed) {
    for (std::uint64_t seed = firstSeed; seed < firstSeed + 10; ++seed) {
      const std::string text =
          pencil(16, 64, "\"volpath\" \"integer maxdepth\" 20", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .4) +
          "WorldBegin\n" + kWhiteEnvironment + "MakeNamedMedium \"m\" " + parameters +
          " \"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" [ 4 4 4 ] \"float g\" .3\n" +
          mediumBox("m", {0, 0, 0}, {1, 1, 1}) + "WorldEnd\n";
      to.add(imageMean(renderText(text, {.seed = seed}, folder_.path()).image));
    }
  };
  means(GetParam().parameters(folder_).c_str(), here, 100);
  means("\"string type\" \"homogeneous\"", reference, 1);
  const double z =
      (here.mean() - reference.mean()) / std::hypot(here.standardError(), reference.standardError());
  EXPECT_LT(std::abs(z), kMaxAbsZ) << here.mean() << " and " << reference.mean();
}

INSTANTIATE_TEST_SUITE_P(Storages, ConstantMedia, testing::ValuesIn(kStored),
                         [](const auto& value) { return std::string(value.param.name); });

}  // namespace
}  // namespace pbrtmedia::test
