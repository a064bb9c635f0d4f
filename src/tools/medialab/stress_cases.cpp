// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/stress_cases.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/parameters.h"

namespace pbrtmedia {
namespace {

CanonicalFunction named(std::string_view name) { return findCanonicalFunction(name).value(); }

CanonicalFunction made(const char* name, std::vector<CanonicalFunction::Stretch> stretches) {
  return {{name, name, "stress test"}, std::move(stretches)};
}

/// Half of the depth lies in `width` of the length.
CanonicalFunction spikeOf(const char* name, double width) {
  return made(name, {{.end = 0.4, .constant = 0.5},
                     {.end = 0.4 + width, .constant = 0.5 + 0.5 / width},
                     {.end = 1, .constant = 0.5}});
}

CanonicalFunction holeOf(const char* name, double width) {
  return made(name, {{.end = 0.4, .constant = 1}, {.end = 0.4 + width}, {.end = 1, .constant = 1}});
}

CanonicalFunction contrastOf(double least) {
  return made("contrast", {{.end = 0.5, .constant = least}, {.end = 1, .constant = 1}});
}

class Cases {
 public:
  void add(std::string name, CanonicalFunction function, double depth, const CanonicalLine::Setup& setup,
           bool isQuick = true) {
    cases.push_back({std::move(name), std::move(function), depth, setup, isQuick, false, 0});
  }
  std::vector<StressCase> cases;
};

void addDepths(Cases& all) {
  const std::array quick{1e-8, 1.0, 50.0, 1e4, 1e6};
  for (const double depth : {1e-8, 1e-4, 1e-2, 1.0, 10.0, 50.0, 1e2, 1e3, 1e4, 1e5, 1e6}) {
    const bool isQuick = std::find(quick.begin(), quick.end(), depth) != quick.end();
    all.add("depth-" + formatNumber(depth), named("cosine"), depth, {}, isQuick);
  }
  for (const double depth : {1e-8, 1e2, 1e6}) {
    all.add("minorant-depth-" + formatNumber(depth), named("composite-sine"), depth, {.lower = 1}, false);
  }
}

void addControls(Cases& all) {
  const std::array quick{1e-3, 0.6, 1e4, 1e9};
  for (const double control : {1e-3, 1e-2, 0.1, 0.3, 0.6, 0.9, 2.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e9}) {
    const bool isQuick = std::find(quick.begin(), quick.end(), control) != quick.end();
    all.add("control-" + formatNumber(control), named("cosine"), 1, {.control = control}, isQuick);
  }
  all.add("thick-low-control", named("cosine"), 1e3, {.control = 0.1});
  all.add("thin-loose-control", named("cosine"), 1e-6, {.control = 1e6}, false);
}

void addShapes(Cases& all) {
  all.add("contrast-1e12", contrastOf(1e-12), 1, {});
  all.add("contrast-1e12-supervoxels", contrastOf(1e-12), 1, {.lower = 1, .superVoxels = 4}, false);
  all.add("jump", named("step"), 2, {});
  all.add("jumps", named("piecewise-random"), 2, {}, false);
  all.add("jumps-supervoxels", named("piecewise-random"), 2, {.lower = 1, .superVoxels = 32});
  all.add("spike-1e-3", spikeOf("spike-1e-3", 1e-3), 2, {});
  all.add("spike-1e-6", spikeOf("spike-1e-6", 1e-6), 2, {}, false);
  all.add("spike-1e-6-supervoxels", spikeOf("spike-1e-6", 1e-6), 2, {.superVoxels = 8}, false);
  all.add("hole-1e-3", holeOf("hole-1e-3", 1e-3), 2, {}, false);
  all.add("hole-1e-15", holeOf("hole-1e-15", 1e-15), 2, {.lower = 1});
  all.add("fractal", named("fractal-a"), 2, {});
  all.add("fractal-supervoxels", named("fractal-a"), 2, {.lower = 1, .superVoxels = 64}, false);
  all.add("many-supervoxels", named("cosine"), 2, {.superVoxels = 1000}, false);
}

void addUnits(Cases& all, std::string_view smooth) {
  all.add("tiny-density", named("constant"), 1, {.scale = 0x1p-140});
  all.add("tiny-density-step", made("powers", {{.end = 0.5, .constant = 0.5}, {.end = 1, .constant = 2}}), 1,
          {.scale = 0x1p-140}, false);
  all.add("huge-density", named(smooth), 1, {.scale = 1e37}, false);
  all.add("length-1e-30", named(smooth), 1, {.length = 1e-30});
  all.add("length-1e30", named(smooth), 1, {.length = 1e30});
  all.add("offset-1e6", named(smooth), 1, {.offset = 1e6});
  all.add("offset-1e6-supervoxels", named(smooth), 1, {.offset = 1e6, .superVoxels = 64}, false);
}

void addNothing(Cases& all) {
  const CanonicalFunction nothing = made("nothing", {{.end = 1}});
  all.add("depth-0", named("cosine"), 0, {});
  all.add("length-0", named("cosine"), 1, {.length = 0});
  all.cases.back().sigmaOfNothing = 1;
  all.add("no-density", nothing, 0, {});
  all.cases.back().sigmaOfNothing = 1;
  all.add("no-density-under-a-control", nothing, 0, {.leastUpper = 3});
  all.cases.back().sigmaOfNothing = 1;
  all.add("blind-bound", named("cosine"), 2, {.blind = 0});
  all.cases.back().isBlind = true;
  all.add("blind-supervoxel", named("cosine"), 2, {.superVoxels = 8, .blind = 3});
  all.cases.back().isBlind = true;
}

void addReciprocals(Cases& all) {
  const std::array quick{1e-100, 0.999999, 1e100};
  for (const double depth : {1e-100, 1e-8, 0.999999, 1.0, 1e8, 1e100}) {
    const bool isQuick = std::find(quick.begin(), quick.end(), depth) != quick.end();
    all.add("depth-" + formatNumber(depth), named("composite-sine"), depth, {}, isQuick);
  }
  all.add("control-is-F", named("constant"), 1, {});
  all.add("control-near-F", named("constant"), 1, {.control = 1 + 1e-9}, false);
  for (const double control : {0.3, 0.4, 0.6, 0.9, 2.0, 10.0, 1e3, 1e9}) {
    const bool isQuick = control == 0.3 || control == 0.6 || control == 1e9;
    all.add("control-" + formatNumber(control), named("composite-sine"), 1, {.control = control}, isQuick);
  }
  all.add("touches-0", named("cosine"), 1, {});
  all.add("hole-1e-3", holeOf("hole-1e-3", 1e-3), 2, {}, false);
  all.add("contrast-1e12", contrastOf(1e-12), 1, {});
  all.add("contrast-1e12-supervoxels", contrastOf(1e-12), 1, {.superVoxels = 4}, false);
  all.add("jump", named("step"), 2, {});
  all.add("spike-1e-3", spikeOf("spike-1e-3", 1e-3), 2, {});
  all.add("spike-1e-6-supervoxels", spikeOf("spike-1e-6", 1e-6), 2, {.superVoxels = 8}, false);
  all.add("fractal", named("fractal-a"), 2, {}, false);
  all.add("many-supervoxels", named("composite-sine"), 2, {.superVoxels = 1000}, false);
}

}  // namespace

std::vector<StressCase> stressCases() {
  Cases all;
  addDepths(all);
  addControls(all);
  addShapes(all);
  addUnits(all, "cosine");
  addNothing(all);
  return std::move(all.cases);
}

std::vector<StressCase> reciprocalStressCases() {
  Cases all;
  addReciprocals(all);
  addUnits(all, "composite-sine");
  addNothing(all);
  return std::move(all.cases);
}

}  // namespace pbrtmedia
