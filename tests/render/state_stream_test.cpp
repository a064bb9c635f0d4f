// SPDX-License-Identifier: BSD-2-Clause
// Whole states of renders as bytes.
#include "render/state_stream.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "base/byte_stream.h"
#include "support/fake_render.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// A result with a number of its own in every place.
RenderResult numberedResult() {
  std::uint64_t next = 1;
  const auto number = [&] { return next++; };
  const auto real = [&] { return static_cast<double>(next++) + .125; };
  RenderResult r;
  r.samplesTaken = number();
  r.samplesTotal = number();
  r.completedSamplesPerPixel = static_cast<std::int64_t>(number());
  RenderCounters& c = r.counters;
  for (std::uint64_t* count :
       {&c.cameraSamples, &c.rays, &c.shadowRays, &c.densityLookups, &c.nullCollisions, &c.mediumScatterings,
        &c.surfaceScatterings, &c.boundViolations, &c.cappedEstimates, &c.stuckPaths, &c.mediumMismatches,
        &c.boundaryRepairs, &c.dropped[0], &c.dropped[1], &c.dropped[2]})
    *count = number();
  c.worstBoundRatio = real();
  r.seconds = real();
  r.cpuSeconds = real();
  r.samplesAbandoned = number();
  r.pixelsTotal = number();
  r.pixelsSampled = number();
  r.dropped = {{{-3, 4}, 5, DropCause::Infinite}, {{6, 7}, 8, DropCause::Negative}};
  r.mismatches = {{{1, 2}, 3, Point3f(4, 5, 6), "fog", "smoke", nullptr}};
  ViolationRecord violation{{9, 8}, 7, {}, "cloud"};
  violation.violation.o = {1.5f, 2.5f, 3.5f};
  violation.violation.d = {0, 0, -1};
  violation.violation.t = real();
  violation.violation.density = real();
  violation.violation.bound = real();
  r.violations = {violation};
  LearningRecord learning;
  learning.medium = "fog";
  learning.restored = learning.warmUpIsLimited = true;
  learning.warmUpPasses = 3;
  learning.warmUpBlockEdge = 4;
  learning.warmUpLookups = number();
  learning.passes = {{1, 2, 3, 4, 5, .5, 6.5f}, {7, 8, 9, 10, 11, .75, 12.5f}};
  learning.warmUp.raised = 99;
  learning.shortfallOfSamples = real();
  learning.shortfall = real();
  r.learning = {learning};
  r.carried = {real(), real()};
  return r;
}

std::string bytesOf(const Film& film, const RenderResult& result) {
  ByteWriter out;
  writeState(out, emptyScene(), film, result);
  return out.text();
}

Film filmWithSplats() {
  Film film = smallFilm({5, 4});
  const RandomSampler sampler({.pixelSamples = 2, .seed = 1});
  FakeIntegrator(
      [](const RayDifferential&, SampleContext& context) {
        context.splats->add({2.5f, 1.5f}, Rgb(context.rng.uniform()));
        return Rgb(context.rng.uniform());
      },
      /*makesSplats=*/true)
      .render(FlatCamera(), sampler, film, {});
  return film;
}

TEST(StateStream, BringsBackEveryNumber) {
  const Film film = filmWithSplats();
  const RenderResult result = numberedResult();
  const std::string bytes = bytesOf(film, result);
  ByteReader in(bytes);
  const RenderState state = readState(in, emptyScene());
  EXPECT_EQ(in.left(), 0u);
  EXPECT_EQ(state.film, film.state());
  EXPECT_TRUE(state.bounds.empty());
  EXPECT_EQ(state.result.samplesTotal, 2u);
  EXPECT_EQ(state.result.completedSamplesPerPixel, 3);
  EXPECT_EQ(state.result.counters.dropped, result.counters.dropped);
  EXPECT_EQ(state.result.dropped, result.dropped);
  EXPECT_EQ(state.result.mismatches.at(0).toString(), result.mismatches[0].toString());
  EXPECT_EQ(state.result.violations.at(0).medium, "cloud");
  EXPECT_EQ(state.result.learning.at(0).passes.at(1).maximum, 12.5f);
  // All others: numbers differ from each other, so what is exchanged or lost shows in the bytes of a copy.
  EXPECT_EQ(bytesOf(film, state.result), bytes);
  RenderResult other = result;
  other.counters.boundaryRepairs += 1;
  EXPECT_NE(bytesOf(film, other), bytes);
}

TEST(StateStream, KnowsBoundariesByTheirNumber) {
  const auto build = [] {
    SceneKit kit;
    for (const float at : {0.f, 5.f, 9.f})
      kit.builder.addPrimitive({.shape = kit.sphere({at, 0, 0}, 1), .material = kit.black()});
    return kit.finish();
  };
  const auto first = build(), second = build();
  RenderResult result;
  result.mismatches.resize(2);
  result.mismatches[1].boundary = first->primitiveGroups()[0][2];
  ByteWriter out;
  writeState(out, *first, smallFilm(), result);
  ByteReader in(out.text());
  const RenderState state = readState(in, *second);
  EXPECT_EQ(state.result.mismatches.at(0).boundary, nullptr);
  EXPECT_EQ(state.result.mismatches.at(1).boundary, second->primitiveGroups()[0][2]);
  ByteReader again(out.text());
  EXPECT_THROW((void)readState(again, emptyScene()), std::length_error) << "a scene with fewer of them";
}

TEST(StateStream, RefusesEveryShorterText) {
  const std::string bytes = bytesOf(filmWithSplats(), numberedResult());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader in(std::string_view(bytes).substr(0, size));
    EXPECT_THROW((void)readState(in, emptyScene()), std::length_error) << size;
  }
}

TEST(StateStream, SurvivesEveryWrongByte) {
  const std::string bytes = bytesOf(filmWithSplats(), numberedResult());
  int refused = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const char wrong : {'\0', '\xff', static_cast<char>(bytes[at] ^ 1)}) {
      std::string other = bytes;
      other[at] = wrong;
      ByteReader in(other);
      try {
        const RenderState state = readState(in, emptyScene());
        Film film = smallFilm({5, 4});
        (void)restoreState(state, emptyScene(), film);
      } catch (const std::length_error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace pbrtmedia
