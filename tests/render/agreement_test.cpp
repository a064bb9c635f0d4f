// SPDX-License-Identifier: BSD-2-Clause
// Every unbiased transmittance estimator with every unbiased free-flight sampler on every class of medium
// makes the same image, pixel by pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "freeflight/flight_list.h"
#include "support/render_scene.h"
#include "support/temporary_folder.h"
#include "transmittance/estimator_list.h"
#ifdef PBRT_MEDIA_HAS_NANOVDB
#include "fields/nano_vdb_samples.h"
#endif

namespace pbrtmedia::test {
namespace {

constexpr int kResolution = 4;
constexpr std::uint64_t kSeed = 20260801;
constexpr double kTooBright = 1.04;  ///< what an estimator or a sampler must not get away with
constexpr double kSeen = .04;        ///< the least difference of an estimator or sampler that is seen
constexpr std::int64_t kSamples = 512,
                       kTrueSamples = 32768;  ///< per pixel: of each pair, of what they are compared with

/// A class of medium: its name and the parameters that define its density in [-1, 1]^3.
struct MediumClass {
  std::string_view name;
  std::string parameters;
  bool isPiecewiseCubic;  ///< serves estimators and samplers that ask for pieces
  friend std::ostream& operator<<(std::ostream& os, const MediumClass& m) { return os << m.name; }
};

std::string gridParameters() {
  std::ostringstream os;
  os << R"("string type" "heterogeneous" "integer nx" 4 "integer ny" 4 "integer nz" 4
     "point p0" [ -1 -1 -1 ] "point p1" [ 1 1 1 ] "float density" [ )";
  Rng rng(5);
  for (int i = 0; i < 64; ++i) os << (i % 5 == 0 ? 0 : 4 * rng.uniform()) << ' ';
  os << "] ";
  return os.str();
}

const std::string kBox = R"("point p0" [ -1 -1 -1 ] "point p1" [ 1 1 1 ] )";

std::vector<MediumClass> mediumClasses() {
  return {
      {"heterogeneous", gridParameters(), true},
      {"heterogeneousBoundedByLearning",
       gridParameters() + R"("string bounds" "progressive" "float initialextinction" 100 )", false},
      {"perlin",
       R"("string type" "perlin" "integer octaves" 3 "float frequency" 1.5 "float threshold" 0.3 "integer supervoxels" 8 )" +
           kBox,
       false},
      {"analytic",
       R"("string type" "analytic" "string function" "sphere" "float radius" 0.9 "float edge" 0.6 )" + kBox,
       false},
      {"texture",
       R"("string type" "texture" "texture density" "blocks" "string bounds" "constant" "float majorant" 3 )" +
           kBox,
       false},
#ifdef PBRT_MEDIA_HAS_NANOVDB
      {"nanovdb", R"("string type" "nanovdb" "string filename" "bricks.nvdb" )", true},
#endif
  };
}

#ifdef PBRT_MEDIA_HAS_NANOVDB
/// 4 x 4 x 4 bricks of 8 voxels each way in [-1, 1]^3. By turns a brick is empty (nothing is stored), of one
/// value (a tile), or of values that differ from voxel to voxel.
void writeBricks(const std::filesystem::path& file) {
  const auto valueAt = [](Ijk at) {
    const auto brick = [&](std::size_t axis) { return (at[axis] + 16) / 8; };
    const int number = brick(0) + 4 * brick(1) + 16 * brick(2);
    if (number % 4 == 0) return 0.0;
    if (number % 4 == 1) return 0.5 + number % 3;
    const auto voxel = static_cast<std::uint64_t>((at[0] + 16) + 32 * (at[1] + 16) + 1024 * (at[2] + 16));
    return 4 * Rng(voxel).uniformDouble();
  };
  const double h = 1.0 / 16;
  writeNanoVdb(file,
               {{.min = {-16, -16, -16},
                 .max = {15, 15, 15},
                 .valueAt = valueAt,
                 .worldFromIndex = Transform::translate({h / 2, h / 2, h / 2}) * Transform::scale(h, h, h)}});
}
#endif

/// Environment and a point light around the medium, seen by a camera that looks past its corner; three
/// bounces.
std::string sceneOf(const MediumClass& mediumClass, std::string_view estimator, std::string_view sampler,
                    double light = 1) {
  std::ostringstream os;
  os << "Film \"image\" \"integer xresolution\" " << kResolution << " \"integer yresolution\" " << kResolution
     << R"( "string filename" "unused.exr"
Sampler "random" "integer pixelsamples" 64
Integrator "volpath" "integer maxdepth" 3
LookAt 2 1.5 -4  0.2 0.1 0  0 1 0
Camera "perspective" "float fov" 30
WorldBegin
LightSource "infinite" "rgb L" [ 0.04 0.05 0.06 ] "rgb scale" [ )"
     << light << ' ' << light << ' ' << light << R"( ]
LightSource "point" "point from" [ 1.5 2 -1 ] "rgb I" [ 12 9 6 ] "rgb scale" [ )"
     << light << ' ' << light << ' ' << light << R"( ]
Texture "blocks" "float" "checkerboard" "integer dimension" 3 "float tex1" 0.2 "float tex2" 2
)"
     << "MakeNamedMedium \"m\" \"rgb sigma_a\" [ 0.2 0.2 0.2 ] \"rgb sigma_s\" [ 1 1 1 ] \"float g\" 0.3 "
        "\"string transmittance\" \""
     << estimator << "\" \"string freeflight\" \"" << sampler << "\" " << mediumClass.parameters << '\n'
     << mediumBox("m", {-1, -1, -1}, {1, 1, 1}) << "WorldEnd\n";
  return os.str();
}

using Pixels = std::vector<RunningStats>;

/// Green radiance of `samples` samples of every pixel. `folder`: where the scene's files are.
Pixels takeSamples(const std::string& text, const TemporaryFolder& folder, std::int64_t samples,
                   std::uint64_t seed) {
  // The sampler too: images that share its numbers are not independent, and their sums are less certain.
  const Construction scene = constructText(text, {.seed = seed}, folder.path());
  const std::unique_ptr<Sampler> sampler = scene.sampler->clone();
  RenderCounters counters;
  Pixels pixels;
  for (int y = 0; y < kResolution; ++y) {
    for (int x = 0; x < kResolution; ++x) {
      RunningStats& stats = pixels.emplace_back();
      for (std::int64_t i = 0; i < samples; ++i) {
        const Rgb radiance = renderSample(*scene.camera, *sampler, samplingIntegrator(scene), {x, y}, i,
                                          samples, seed, counters);
        stats.add(static_cast<double>(radiance.g));
      }
    }
  }
  return pixels;
}

/// Difference of two images at one pixel. Few samples of a skewed estimate may show too little of its
/// variance: then that of the other image, which has many, counts.
ZTest difference(const RunningStats& a, const RunningStats& truth) {
  const double variance = std::max(a.variance(), truth.variance());
  return {a.mean(), truth.mean(), std::sqrt(variance / static_cast<double>(a.count())), truth.standardError(),
          kSeed,    a.count()};
}

/// Sums of differences from the truth over pixels and images: what all images of one estimator, or of one
/// sampler, have in common shows in fewer samples than what one pair has.
class Differences {
 public:
  explicit Differences(const Pixels& truth) : truth_(truth) {}
  /// The largest |z| of a pixel.
  double add(const Pixels& image) {
    double worst = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
      const ZTest test = difference(image[i], truth_[i]);
      worst = std::max(worst, std::abs(test.z()));
      sum_ += test.mean;
      variance_ += test.standardError * test.standardError;
    }
    ++images_;
    return worst;
  }
  ZTest test() const {
    double sum = 0, variance = 0;
    for (const RunningStats& pixel : truth_) {
      sum += pixel.mean();
      variance += pixel.standardError() * pixel.standardError();
    }
    const double pixels = static_cast<double>(truth_.size());
    return {sum_ / images_ / pixels, sum / pixels, std::sqrt(variance_) / images_ / pixels,
            std::sqrt(variance) / pixels, kSeed};
  }

 private:
  const Pixels& truth_;
  double sum_ = 0, variance_ = 0, images_ = 0;
};

class Agreement : public testing::TestWithParam<MediumClass> {
 protected:
  void SetUp() override {
#ifdef PBRT_MEDIA_HAS_NANOVDB
    if (GetParam().name == "nanovdb") writeBricks(folder_.path() / "bricks.nvdb");
#endif
  }
  Pixels takeSamples(const std::string& text, std::int64_t samples, std::uint64_t seed) const {
    return test::takeSamples(text, folder_, samples, seed);
  }
  TemporaryFolder folder_;
};

TEST_P(Agreement, OfEveryEstimatorWithEverySampler) {
  const MediumClass& mediumClass = GetParam();
  const Pixels truth = takeSamples(sceneOf(mediumClass, "ratio", "delta"), kTrueSamples, kSeed);
  std::map<std::string_view, Differences> ofEstimator, ofSampler;
  int pairs = 0;
  for (const std::string_view estimatorName : estimatorNames()) {
    const EstimatorTraits estimator = traitsOf(*findEstimator(estimatorName));
    if (estimator.bias != EstimatorTraits::Bias::Unbiased || !estimator.laws.has(ExponentialLaw{}) ||
        (estimator.needsPieces && !mediumClass.isPiecewiseCubic)) {
      continue;
    }
    for (const std::string_view samplerName : flightNames()) {
      const FlightTraits sampler = traitsOf(*findFlight(samplerName));
      if (sampler.bias != EstimatorTraits::Bias::Unbiased ||
          (sampler.needsPieces && !mediumClass.isPiecewiseCubic))
        continue;
      // Weights of either sign multiply along a path: too rare and large for so few samples.
      if (sampler.mayBeNegative) continue;
      const Pixels image = takeSamples(sceneOf(mediumClass, estimatorName, samplerName), kSamples,
                                       hashCombine(kSeed, static_cast<std::uint64_t>(++pairs)));
      Differences pair(truth);
      EXPECT_LT(pair.add(image), kMaxAbsZ) << estimatorName << " with " << samplerName;
      EXPECT_LT(std::abs(pair.test().z()), kMaxAbsZ)
          << estimatorName << " with " << samplerName << ": " << pair.test();
      ofEstimator.try_emplace(estimatorName, truth).first->second.add(image);
      ofSampler.try_emplace(samplerName, truth).first->second.add(image);
    }
  }
  EXPECT_GE(pairs, 80);
  for (const auto& all : {ofEstimator, ofSampler}) {
    for (const auto& [name, differences] : all) {
      EXPECT_LT(std::abs(differences.test().z()), kMaxAbsZ) << name << ": " << differences.test();
      EXPECT_TRUE(differences.test().sees(kSeen)) << name << ": " << differences.test();
    }
  }
}

TEST_P(Agreement, SeesImagesThatAreTooBright) {
  const Pixels a = takeSamples(sceneOf(GetParam(), "ratio", "delta"), kTrueSamples, kSeed);
  Differences differences(a);
  for (std::uint64_t i = 1; i <= 4; ++i) {  // as many samplers as there are at least
    differences.add(takeSamples(sceneOf(GetParam(), "ratio", "delta", kTooBright), kSamples, kSeed + i));
  }
  EXPECT_GT(std::abs(differences.test().z()), kMaxAbsZ) << differences.test();
}

INSTANTIATE_TEST_SUITE_P(AllMediumClasses, Agreement, testing::ValuesIn(mediumClasses()),
                         [](const auto& value) { return std::string(value.param.name); });

}  // namespace
}  // namespace pbrtmedia::test
