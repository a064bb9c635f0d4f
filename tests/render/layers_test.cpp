// SPDX-License-Identifier: BSD-2-Clause
// Layers of whole renders: against closed forms, against each other, and against the image.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "film/layers.h"
#include "support/render_scene.h"
#include "support/statistics.h"

namespace pbrtmedia::test {
namespace {

/// The text with layers asked for.
std::string withLayers(std::string text, const std::string& names) {
  const std::string film = "Film \"image\"";
  text.insert(text.find(film) + film.size(), " \"string layers\" [ " + names + " ]");
  return text;
}
std::string withAll(const std::string& text) { return withLayers(text, "\"all\""); }

std::size_t channelOf(const Image& image, std::string_view name) {
  const auto channel = image.channelIndex(name);
  if (!channel) throw std::runtime_error("no channel " + std::string(name));
  return *channel;
}
double meanOf(const Image& image, std::string_view name) { return imageMean(image, channelOf(image, name)); }
double sumOf(const Image& image, std::string_view name) {
  double sum = 0;
  for (std::size_t i = channelOf(image, name); i < image.data().size(); i += image.channelCount())
    sum += static_cast<double>(image.data()[i]);
  return sum;
}

/// Independent renders, and means of their channels against true values.
class Renders {
 public:
  explicit Renders(const std::string& text, std::uint64_t seeds = 16) {
    for (std::uint64_t s = 1; s <= seeds; ++s) images_.push_back(renderText(text, {.seed = s}).image);
  }
  ZTest zTestOf(std::string_view channel, double truth) const {
    RunningStats means;
    for (const Image& image : images_) means.add(meanOf(image, channel));
    return zTest(means, truth, 1);
  }

 private:
  std::vector<Image> images_;
};

// ---- A plane without media

const std::string kPlane =
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 "
    "]\n";
const std::string kMatte = "Material \"matte\" \"rgb Kd\" [ 0.25 0.5 0.75 ]\n";

class EachIntegrator : public testing::TestWithParam<const char*> {
 protected:
  static std::string quoted() { return std::string("\"") + GetParam() + '"'; }
};
INSTANTIATE_TEST_SUITE_P(All, EachIntegrator, testing::Values("path", "volpath", "directlighting", "whitted"),
                         [](const auto& value) { return value.param; });

TEST_P(EachIntegrator, TellsAPlaneExactly) {
  const Image image = renderText(withAll(pencil(4, 3, quoted(), "LookAt 0 0 -3  0 0 0  0 1 0", .5)) +
                                 "WorldBegin\n" + kWhiteEnvironment + kMatte + kPlane + "WorldEnd\n")
                          .image;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const auto at = [&](std::string_view name) { return image.at(x, y, channelOf(image, name)); };
      EXPECT_EQ(at("A"), 1);
      EXPECT_EQ(at("Z"), 3);
      EXPECT_EQ(at("N.X"), 0);
      EXPECT_EQ(at("N.Y"), 0);
      EXPECT_EQ(at("N.Z"), -1) << "on the camera's side";
      EXPECT_EQ(at("P.Z"), 0);
      // The mean of positions is within the pixel: y down, x to the right seen from behind the plane.
      EXPECT_NEAR(at("P.X"), (x + .5) / 4 - .5, .125);
      EXPECT_NEAR(at("P.Y"), .5 - (y + .5) / 4, .125);
      EXPECT_NEAR(at("albedo.R"), .25, 1e-6);
      EXPECT_NEAR(at("albedo.G"), .5, 1e-6);
      EXPECT_NEAR(at("albedo.B"), .75, 1e-6);
      EXPECT_EQ(at("samples"), 3);
      EXPECT_EQ(at("lookups"), 0);
      EXPECT_EQ(at("emission.R"), 0);
    }
  }
}

TEST_P(EachIntegrator, TellsHowFarTheRayGoesNotHowDeep) {
  // A perspective camera: Z is the distance to P, also toward the corners.
  const Image image = renderText(
                          "Film \"image\" \"integer xresolution\" 5 \"integer yresolution\" 5 \"string "
                          "layers\" [ \"depth\" \"position\" ]\nSampler \"halton\" \"integer "
                          "pixelsamples\" 1\nIntegrator " +
                          quoted() +
                          "\nLookAt 0 0 -2  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 90\n"
                          "WorldBegin\n" +
                          kWhiteEnvironment + kMatte + kPlane + "WorldEnd\n")
                          .image;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      const Vec3d p(image.at(x, y, channelOf(image, "P.X")), image.at(x, y, channelOf(image, "P.Y")),
                    image.at(x, y, channelOf(image, "P.Z")));
      EXPECT_NEAR(image.at(x, y, channelOf(image, "Z")), length(p - Vec3d(0, 0, -2)), 1e-5);
    }
  }
}

TEST_P(EachIntegrator, SphereBeforeNothingCoversItsPixels) {
  const std::string text = withAll(pencil(32, 16, quoted(), "LookAt 0 0 -3  0 0 0  0 1 0", 1.25)) +
                           "WorldBegin\n" + kWhiteEnvironment + kMatte + "Shape \"sphere\"\nWorldEnd\n";
  const ZTest test = Renders(text).zTestOf("A", kPi / 6.25);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees()) << test;
  const Image image = renderText(text).image;
  int edges = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const float alpha = image.at(x, y, channelOf(image, "A")), z = image.at(x, y, channelOf(image, "Z"));
      if (alpha == 0) {
        EXPECT_EQ(z, 0) << "no depth of nothing";
      } else {
        EXPECT_GE(z, 2) << "what is seen beside the sphere is no part of its depth";
        EXPECT_LE(z, 3);
      }
      if (alpha > 0 && alpha < 1) ++edges;
      // Behind is the white environment, which is emission.
      EXPECT_NEAR(image.at(x, y, channelOf(image, "emission.G")), 1 - alpha, 1e-6);
    }
  }
  EXPECT_GT(edges, 20);
}

/// Lights, a mirror, glass, something that emits, and a bump of fog where media are rendered.
std::string busyScene(const std::string& integrator, const std::string& sampler = "halton",
                      const std::string& medium = "\"string type\" \"homogeneous\"") {
  return "Film \"image\" \"integer xresolution\" 20 \"integer yresolution\" 16 \"float scale\" 1.5\n"
         "PixelFilter \"mitchell\"\nSampler \"" +
         sampler + "\" \"integer pixelsamples\" 9\nIntegrator " + integrator +
         "\nLookAt 0 1 -6  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 45\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [ .2 .3 .5 ]\n"
         "LightSource \"point\" \"point from\" [ 2 4 -3 ] \"rgb I\" [ 20 18 15 ]\n"
         "MakeNamedMedium \"m\" \"rgb sigma_a\" [ .1 .2 .3 ] \"rgb sigma_s\" [ 2 1 .4 ] " +
         medium + "\nAttributeBegin\nTranslate 0 -1 0\nRotate 90 1 0 0\n" + kMatte + kPlane +
         "AttributeEnd\nAttributeBegin\nTranslate -1.5 0 0\nMaterial \"mirror\"\nShape \"sphere\" \"float "
         "radius\" .8\nAttributeEnd\nAttributeBegin\nTranslate 1.5 0 0\nMaterial \"glass\"\nShape \"sphere\" "
         "\"float radius\" .8\nAttributeEnd\nAttributeBegin\nTranslate 0 1 1\nAreaLightSource \"diffuse\" "
         "\"rgb L\" [ 4 3 2 ]\nMaterial \"plastic\"\nShape \"sphere\" \"float radius\" .4\nAttributeEnd\n"
         "AttributeBegin\nTranslate 0 0 -1.2\nMaterial \"none\"\nMediumInterface \"m\" \"\"\nShape "
         "\"sphere\" "
         "\"float radius\" .9\nAttributeEnd\nWorldEnd\n";
}

const std::vector<std::string> kMediumKinds = {
    "\"string type\" \"homogeneous\"", "\"string type\" \"homogeneous\" \"rgb Le\" [ .3 .2 .1 ]",
    "\"string type\" \"perlin\" \"integer octaves\" 2 \"float frequency\" 3 \"integer supervoxels\" 4 "
    "\"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 1 ]"};

/// The parts of a pixel against the whole, which is the pixel itself but where that is negative. Rounding is
/// that of some dozens of sums in float.
void expectSum(const Image& image, const std::vector<std::string>& layers) {
  double most = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (const char* c : {"R", "G", "B"}) {
        double sum = 0, size = 0;
        for (const std::string& layer : layers) {
          const double part = image.at(x, y, channelOf(image, layer + '.' + c));
          sum += part;
          size += std::abs(part);
        }
        const double whole = image.at(x, y, channelOf(image, c));
        most = std::max(most, size);
        ASSERT_NEAR(std::max(0.0, sum), whole, 1e-5 * size) << x << ' ' << y << ' ' << c;
      }
    }
  }
  EXPECT_GT(most, 0.1);
}

TEST_P(EachIntegrator, PartsAddUpToTheImage) {
  const bool hasMedia = std::string(GetParam()) == "volpath";
  for (const std::string& medium : kMediumKinds) {
    const Image image = renderText(withAll(busyScene(quoted(), "halton", medium))).image;
    expectSum(image, {"emission", "direct", "indirect"});
    if (hasMedia) {
      expectSum(image, {"emission", "surface", "medium"});
    } else {
      expectSum(image, {"emission", "surface"});
    }
    // Each has something to say.
    for (const char* layer : {"emission.G", "direct.G", "indirect.G", "surface.G"})
      EXPECT_GT(meanOf(image, layer), 1e-3) << layer;
    if (!hasMedia) break;
    EXPECT_GT(meanOf(image, "medium.G"), 1e-3);
  }
}

TEST_P(EachIntegrator, LimitedSamplesHaveLimitedParts) {
  std::string text = busyScene(quoted());
  text.insert(text.find(" \"float scale\""), " \"float maxsampleluminance\" 0.2");
  const Image image = renderText(withAll(text)).image;
  expectSum(image, {"emission", "direct", "indirect"});
  EXPECT_LT(meanOf(image, "G"), .8 * meanOf(renderText(busyScene(quoted())).image, "G"));
}

TEST_P(EachIntegrator, LayersChangeNoBitOfTheImage) {
  for (const std::string sampler : {"halton", "random"}) {
    for (const std::string& medium : kMediumKinds) {
      const std::string text = busyScene(quoted(), sampler, medium);
      const Rendered plain = renderText(text, {.seed = 3}), layered = renderText(withAll(text), {.seed = 3});
      for (int y = 0; y < plain.image.height(); ++y) {
        for (int x = 0; x < plain.image.width(); ++x)
          ASSERT_EQ(plain.image.rgb(x, y), layered.image.rgb(x, y));
      }
      EXPECT_EQ(plain.result.counters.rays, layered.result.counters.rays);
      EXPECT_EQ(plain.result.counters.shadowRays, layered.result.counters.shadowRays);
      EXPECT_EQ(plain.result.counters.densityLookups, layered.result.counters.densityLookups);
    }
  }
}

TEST_P(EachIntegrator, LayersDoNotDependOnThreads) {
  const std::string text = withAll(busyScene(quoted(), "random", kMediumKinds[2]));
  const Image one = renderText(text, {.threads = 1}).image,
              many = renderText(text, {.threads = 5, .tileSize = 7}).image;
  for (std::size_t c = 0; c < one.channelCount(); ++c) {
    if (one.channels()[c] == "seconds") continue;
    for (int y = 0; y < one.height(); ++y) {
      for (int x = 0; x < one.width(); ++x) ASSERT_EQ(one.at(x, y, c), many.at(x, y, c)) << one.channels()[c];
    }
  }
}

// ---- Costs

TEST(CostLayers, AddUpToWhatStatisticsSay) {
  std::string text = busyScene("\"volpath\"", "random", kMediumKinds[2]);
  text.replace(text.find("mitchell"), 8, "box");
  const Rendered r = renderText(withAll(text));
  EXPECT_GT(r.result.counters.densityLookups, 100u);
  EXPECT_EQ(sumOf(r.image, "lookups"), static_cast<double>(r.result.counters.densityLookups));
  EXPECT_EQ(sumOf(r.image, "samples"), static_cast<double>(r.result.samplesTaken));
  const double seconds = sumOf(r.image, "seconds");
  EXPECT_GT(seconds, 0);
  EXPECT_LE(seconds, r.result.cpuSeconds);
}

// ---- Fog

/// A slab of thickness 1 at z from 1 to 2, from z = 0 along the axis; nothing behind but `behind`.
std::string slab(Vec3d sigmaA, Vec3d sigmaS, const std::string& channelSampling,
                 const std::string& behind = "",
                 const std::string& type = "\"string type\" \"homogeneous\"") {
  std::ostringstream os;
  os << withAll(pencil(
            8, 64,
            "\"volpath\" \"integer maxdepth\" 1 \"string channelsampling\" \"" + channelSampling + '"'))
     << "WorldBegin\n"
     << kWhiteEnvironment << "MakeNamedMedium \"m\" " << type << " \"rgb sigma_a\" [ " << sigmaA.x << ' '
     << sigmaA.y << ' ' << sigmaA.z << " ] \"rgb sigma_s\" [ " << sigmaS.x << ' ' << sigmaS.y << ' '
     << sigmaS.z << " ]\n"
     << mediumBox("m", {-1, -1, 1}, {1, 1, 2}) << behind << "WorldEnd\n";
  return os.str();
}
const std::string kGrid =
    "\"string type\" \"heterogeneous\" \"string border\" \"clamp\" \"integer nx\" 1 \"integer ny\" 1 "
    "\"integer "
    "nz\" 2 \"point p0\" [ -1 -1 1 ] \"point p1\" [ 1 1 2 ] \"float density\" [ 1 1 ]";

TEST(FogLayers, TransmittanceAlphaAndAlbedoOfASlab) {
  const Vec3d a(.3, .2, .1), s(.5, 1, 2);
  for (const char* sampling : {"shared", "split"}) {
    for (const std::string& type : {std::string("\"string type\" \"homogeneous\""), kGrid}) {
      const Renders renders(slab(a, s, sampling, "", type));
      double meanT = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double sigma = a[c] + s[c], t = std::exp(-sigma);
        meanT += t / 3;
        const std::string name(1, "RGB"[c]);
        const ZTest through = renders.zTestOf("transmittance." + name, t);
        EXPECT_LT(std::abs(through.z()), kMaxAbsZ) << sampling << ' ' << type << ' ' << through;
        const ZTest albedo = renders.zTestOf("albedo." + name, s[c] / sigma * (1 - t));
        EXPECT_LT(std::abs(albedo.z()), kMaxAbsZ) << sampling << ' ' << type << ' ' << albedo;
        // Negative control: the optical depth without absorption.
        const ZTest wrong = renders.zTestOf("transmittance." + name, std::exp(-s[c]));
        EXPECT_GT(std::abs(wrong.z()), kMaxAbsZ) << wrong;
      }
      const ZTest alpha = renders.zTestOf("A", 1 - meanT);
      EXPECT_LT(std::abs(alpha.z()), kMaxAbsZ) << sampling << ' ' << type << ' ' << alpha;
      EXPECT_TRUE(alpha.sees(.03)) << alpha;
    }
  }
}

TEST(FogLayers, MediumDepthIsTheMeanDistanceOfTheFirstScattering) {
  // 1 + E[t | t < 1] = 1 + 1/s - exp(-s) / (1 - exp(-s)) for an extinction s.
  for (const double sigma : {.2, 2.0, 8.0}) {
    const double e = std::exp(-sigma), truth = 1 + 1 / sigma - e / (1 - e);
    for (const std::string& type : {std::string("\"string type\" \"homogeneous\""), kGrid}) {
      const std::string text = slab(Vec3d(sigma / 4, sigma / 4, sigma / 4),
                                    Vec3d(sigma * .75, sigma * .75, sigma * .75), "auto", "", type);
      const Renders renders(text);
      const ZTest test = renders.zTestOf("mediumdepth.Z", truth);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << sigma << ' ' << type << ' ' << test;
      EXPECT_TRUE(test.sees(.02)) << test;
      const ZTest middle = renders.zTestOf("mediumdepth.Z", sigma > 1 ? 1.5 : 1.45);  // negative control
      EXPECT_GT(std::abs(middle.z()), kMaxAbsZ) << middle;
    }
  }
}

TEST(FogLayers, WhatIsBehindFogIsSeenThroughIt) {
  const std::string behind = "Translate 0 0 5\n" + kMatte + kPlane;
  for (const char* sampling : {"shared", "split"}) {
    const std::string text = slab(Vec3d(.1, .1, .1), Vec3d(.4, .9, 1.9), sampling, behind);
    const Renders renders(text);
    const Image image = renderText(text).image;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(image.at(x, y, channelOf(image, "A")), 1) << "nothing of the background is seen";
        EXPECT_FLOAT_EQ(image.at(x, y, channelOf(image, "Z")), 5);
        EXPECT_FLOAT_EQ(image.at(x, y, channelOf(image, "N.Z")), -1);
        EXPECT_FLOAT_EQ(image.at(x, y, channelOf(image, "P.Z")), 5);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double s[] = {.4, .9, 1.9}, kd[] = {.25, .5, .75}, sigma = s[c] + .1, t = std::exp(-sigma);
      const ZTest albedo =
          renders.zTestOf(std::string("albedo.") + "RGB"[c], s[c] / sigma * (1 - t) + kd[c] * t);
      EXPECT_LT(std::abs(albedo.z()), kMaxAbsZ) << sampling << ' ' << albedo;
    }
  }
}

TEST(FogLayers, FogThatOnlyAbsorbsHasNoDepthAndNoAlbedo) {
  const Image image = renderText(slab(Vec3d(2, 2, 2), Vec3d(0, 0, 0), "auto")).image;
  EXPECT_EQ(meanOf(image, "mediumdepth.Z"), 0);
  EXPECT_EQ(meanOf(image, "albedo.G"), 0);
  EXPECT_EQ(meanOf(image, "medium.G"), 0);
  EXPECT_GT(meanOf(image, "A"), .5);
}

// ---- Variance

/// By integrators: that of `bdpt` has what light paths bring to other pixels, too.
class VarianceOfImages : public testing::TestWithParam<const char*> {};

TEST_P(VarianceOfImages, IsThatOfTheMeanOverManySeeds) {
  // Each pixel has an unbiased estimate from every render, and one from all renders together: the mean of the
  // differences over pixels, which are independent under a filter of one pixel, is 0.
  const std::string text =
      withLayers(pencil(16, 5, GetParam(), "", .9), "\"variance\"") + "WorldBegin\n" + kWhiteEnvironment +
      constantMedium(Storage::Homogeneous, .2, 1, .5, {-.7, -.7, 1}, {.7, .7, 2}) +
      mediumBox("m", {-.7, -.7, 1}, {.7, .7, 2}) + "Translate 0 0 3\n" + kMatte + kPlane + "WorldEnd\n";
  constexpr int kSeeds = 64;
  std::vector<RunningStats> values, variances;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Image image = renderText(text, {.seed = seed}).image;
    values.resize(static_cast<std::size_t>(image.width() * image.height()));
    variances.resize(values.size());
    std::size_t i = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x, ++i) {
        values[i].add(image.at(x, y, 1));
        variances[i].add(image.at(x, y, channelOf(image, "variance.G")));
      }
    }
  }
  RunningStats difference, ofSamples, whole;
  for (std::size_t i = 0; i < values.size(); ++i) {
    whole.add(values[i].variance());
    difference.add(variances[i].mean() - values[i].variance());
    ofSamples.add(variances[i].mean() * 5 - values[i].variance());  // of one sample, not of the mean
  }
  const ZTest test = zTest(difference, 0, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test << ", the variance is " << whole.mean();
  EXPECT_LT(kMaxAbsZ * test.standardError, .1 * whole.mean()) << "sees a tenth of it";
  const ZTest wrong = zTest(ofSamples, 0, 1);  // negative control
  EXPECT_GT(std::abs(wrong.z()), kMaxAbsZ) << wrong;
}

INSTANTIATE_TEST_SUITE_P(Integrators, VarianceOfImages, testing::Values("\"volpath\"", "\"bdpt\""),
                         [](const auto& tested) {
                           const std::string name = tested.param;
                           return name.substr(1, name.size() - 2);
                         });

}  // namespace
}  // namespace pbrtmedia::test
