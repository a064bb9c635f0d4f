// SPDX-License-Identifier: BSD-2-Clause
// Media whose extinction differs from channel to channel: each channel is what it would be alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr std::array<double, 3> kSigma = {0, 1, 10};
constexpr int kResolution = 3;
constexpr std::int64_t kSamples = 4000;  ///< per pixel

/// A scattering cube in a dim environment beside a point light, seen at an angle.
std::string scene(const std::array<double, 3>& sigma, const std::string& density, const std::string& sampler,
                  const std::string& channelSampling = "auto") {
  std::ostringstream os;
  const auto times = [&](double factor) {
    os << "[ " << factor * sigma[0] << ' ' << factor * sigma[1] << ' ' << factor * sigma[2] << " ] ";
  };
  os << "Film \"image\" \"integer xresolution\" " << kResolution << " \"integer yresolution\" " << kResolution
     << R"( "string filename" "unused.exr"
Sampler "random" "integer pixelsamples" 16
Integrator "volpath" "integer maxdepth" 6 "string channelsampling" ")"
     << channelSampling << R"("
LookAt 2 1.5 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 16
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.2 0.2 ]
LightSource "point" "point from" [ 1.5 2 -1 ] "rgb I" [ 6 6 6 ]
MakeNamedMedium "m" )"
     << density << "\"rgb sigma_a\" ";
  times(0.1);
  os << "\"rgb sigma_s\" ";
  times(0.9);
  if (!sampler.empty()) os << "\"string freeflight\" \"" << sampler << "\" ";
  os << '\n' << mediumBox("m", {-1, -1, -1}, {1, 1, 1}) << "WorldEnd\n";
  return os.str();
}

const std::string kGrid = R"("string type" "heterogeneous" "integer nx" 2 "integer ny" 2 "integer nz" 2
  "string border" "clamp" "point p0" [ -1 -1 -1 ] "point p1" [ 1 1 1 ] "float density" [ 1 .2 .6 1 0 1 .4 1 ] )";
const std::string kHomogeneous = R"("string type" "homogeneous" )";

/// Per channel, over all samples of all pixels.
std::array<RunningStats, 3> render(const std::string& text, std::uint64_t seed) {
  const Construction made = constructText(text);
  const std::unique_ptr<Sampler> sampler = made.sampler->clone();
  RenderCounters counters;
  std::array<RunningStats, 3> channels;
  for (int y = 0; y < kResolution; ++y) {
    for (int x = 0; x < kResolution; ++x) {
      for (std::int64_t i = 0; i < kSamples; ++i) {
        const Rgb radiance = renderSample(*made.camera, *sampler, samplingIntegrator(made), {x, y}, i,
                                          kSamples, seed, counters);
        for (std::size_t c = 0; c < 3; ++c) channels[c].add(static_cast<double>(radiance[c]));
      }
    }
  }
  return channels;
}

class Chromatic : public testing::TestWithParam<std::pair<const char*, std::string>> {};

TEST_P(Chromatic, EachChannelHasTheMeanOfARenderOfItsOwn) {
  const std::string sampler = GetParam().first;
  const std::string& density = GetParam().second;
  const std::array<RunningStats, 3> shared = render(scene(kSigma, density, sampler, "shared"), 1);
  const std::array<RunningStats, 3> automatic = render(scene(kSigma, density, sampler), 2);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::array<RunningStats, 3> alone =
        render(scene({kSigma[c], kSigma[c], kSigma[c]}, density, sampler), 3 + c);
    for (const RunningStats& all : {shared[c], automatic[c]}) {
      const ZTest test = zTest(all, alone[c]);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "channel " << c << ": " << test;
    }
    // Channels this far apart are followed one by one. A path that they share is not as good.
    EXPECT_LE(automatic[c].variance(), 2 * alone[c].variance()) << "channel " << c;
    if (c > 0) {
      EXPECT_GT(shared[c].variance(), 2 * alone[c].variance()) << "channel " << c;
    }
  }
}

TEST_P(Chromatic, SeesAnotherChannelsMean) {
  const std::string sampler = GetParam().first;
  const std::string& density = GetParam().second;
  const std::array<RunningStats, 3> all = render(scene(kSigma, density, sampler), 2);
  const std::array<RunningStats, 3> other = render(scene({2, 2, 2}, density, sampler), 6);
  EXPECT_GT(std::abs(zTest(all[1], other[1]).z()), kMaxAbsZ);
}

TEST(ChromaticPaths, ShareOneWhereChannelsAreNear) {
  // With nothing to split, the path takes the same steps.
  const auto rendered = [](const char* sampling, double factor) {
    return render(scene({1, 1.2, factor}, kHomogeneous, "", sampling), 1);
  };
  EXPECT_EQ(rendered("auto", 2)[1].mean(), rendered("shared", 2)[1].mean());
  EXPECT_NE(rendered("auto", 9)[1].mean(), rendered("shared", 9)[1].mean());
}

INSTANTIATE_TEST_SUITE_P(Samplers, Chromatic,
                         testing::Values(std::pair{"", kHomogeneous}, std::pair{"weighted-delta", kGrid},
                                         std::pair{"delta", kGrid}, std::pair{"decomposition", kGrid},
                                         std::pair{"single-particle", kGrid}),
                         [](const auto& value) {
                           std::string name = *value.param.first ? value.param.first : "homogeneous";
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace pbrtmedia::test
