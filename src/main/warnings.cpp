// SPDX-License-Identifier: BSD-2-Clause
#include "main/warnings.h"

#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <vector>

#include "base/stop_signal.h"
#include "media/homogeneous.h"
#include "media/medium.h"
#include "world/media_faults.h"

namespace pbrtmedia {
namespace {

constexpr std::array<const char*, static_cast<std::size_t>(DropCause::kCount)> kCauses = {
    "not a number", "infinite", "of negative luminance"};

void describeDropped(const RenderResult& result, const Options& options, std::ostream& os) {
  const RenderCounters& c = result.counters;
  if (c.droppedTotal() == 0) return;
  os << "pbrt: WARNING: " << c.droppedTotal() << " of " << result.samplesTaken << " samples were dropped:";
  for (std::size_t i = 0; i < kCauses.size(); ++i) {
    if (c.dropped[i] > 0) os << ' ' << c.dropped[i] << ' ' << kCauses[i];
  }
  os << ".\n";
  for (const DroppedSample& d : result.dropped) {
    os << "  pixel " << d.pixel.x << ' ' << d.pixel.y << ", sample " << d.sample << ", seed " << options.seed
       << ": " << kCauses[static_cast<std::size_t>(d.cause)] << '\n';
  }
}

/// What the boundaries of the mismatches have in common with others that went wrong, once each; what is
/// without fault overlaps something.
void adviseOnBoundaries(const std::vector<MediumMismatch>& mismatches, const Scene* scene, std::ostream& os) {
  std::set<const Primitive*> told;
  bool overlaps = false;
  for (const MediumMismatch& m : mismatches) {
    const auto fault = scene && m.boundary ? scene->boundaries().faultOf(*m.boundary) : std::nullopt;
    if (!fault) {
      overlaps = true;
    } else if (told.insert(m.boundary).second) {
      os << "  " << m.boundary->location.toString() << ": " << describeFault(*m.boundary, *fault) << ".\n";
    }
  }
  if (!overlaps || !told.empty()) return;
  os << "  Where one boundary lies inside of another, name the medium around it (MediumInterface \"inner\" "
        "\"outer\");\n  where boundaries cut each other, give their media \"string overlap\" \"add\".\n";
}

}  // namespace

std::string describeFaults(const RenderResult& result, const Options& options, const Scene* scene) {
  std::ostringstream os;
  describeDropped(result, options, os);
  const RenderCounters& c = result.counters;
  if (c.boundViolations > 0) {
    os << "pbrt: WARNING: " << c.boundViolations
       << " density lookups exceeded their bound, the worst by a factor of " << c.worstBoundRatio << ".\n";
    for (const ViolationRecord& v : result.violations) {
      os << "  pixel " << v.pixel.x << ' ' << v.pixel.y << ", sample " << v.sample << ", seed "
         << options.seed << ": medium \"" << v.medium << "\" has density " << v.violation.density
         << " above its bound " << v.violation.bound << " at t = " << v.violation.t << " of the ray from "
         << v.violation.o << " along " << v.violation.d << '\n';
    }
  }
  if (c.cappedEstimates > 0 && !options.quiet) {
    os << "pbrt: warning: " << c.cappedEstimates
       << " transmittance estimates were cut short by maxlookups.\n";
  }
  if (c.stuckPaths > 0 && !options.quiet) {
    os << "pbrt: warning: " << c.stuckPaths
       << " paths were ended in media so dense that coordinates cannot tell one scattering from the next, "
          "after many in one place: what they would still have found is missing, so the image is too dark "
          "there.\n";
  }
  if (c.mediumMismatches > 0 && !options.quiet) {
    os << "pbrt: warning: " << c.mediumMismatches
       << " boundary crossings name another medium than the ray was in; the boundary is believed, as in "
          "PBRT-v3.\n";
    for (const MediumMismatch& m : result.mismatches) os << "  " << m.toString() << '\n';
    adviseOnBoundaries(result.mismatches, scene, os);
  }
  return os.str();
}

std::string boundsState(const std::vector<LearningRecord>& learning) {
  if (learning.empty()) return "";
  bool cached = true, rising = false;
  for (const LearningRecord& record : learning) {
    cached &= record.restored;
    rising |= record.isRising();
  }
  return cached ? "cached" : rising ? "rising" : "settled";
}

std::string describeRisingBounds(const std::vector<LearningRecord>& learning) {
  std::ostringstream os;
  os.precision(2);
  for (const LearningRecord& record : learning) {
    if (!record.isRising()) continue;
    os << "pbrt: warning: the progressive bounds of medium \"" << record.medium << "\" ";
    if (record.passes.empty()) {
      os << "are not known yet: the image has no samples";
    } else {
      os << "were still rising: about " << 100 * record.shortfall
         << " % of its extinction is missing in the image. More samples, "
         << "more passes of \"integer warmup\""
         << (record.warmUpIsLimited ? " within more \"integer warmuplookups\"" : "")
         << " or a second run with --bounds-cache come closer";
    }
    os << ".\n";
  }
  return os.str();
}

std::string describeStop(const RenderResult& result) {
  if (!result.interrupted) return {};
  std::ostringstream os;
  if (result.pixelsSampled < result.pixelsTotal) {
    os << "pbrt: warning: stopped in the first pass: " << result.pixelsTotal - result.pixelsSampled << " of "
       << result.pixelsTotal << " pixels have no sample of their own; they are black or show what the filter "
       << "spreads from their neighbours\n";
  }
  if (result.samplesAbandoned > 0) {
    os << "pbrt: warning: " << result.samplesAbandoned << " paths did not end within " << StopSignal::kGrace
       << " s of the stop and were left; their samples are not in the image\n";
  }
  return os.str();
}

namespace {

/// What is wrong with a medium that scatters on a smaller scale than coordinates can tell; empty: nothing.
std::string describeUntold(const Medium& medium, const Scene& scene) {
  // Distances along a ray are told to these shares of the coordinates. A medium with a density has a box of
  // its own, which differs from its boundary by the rounding of hits (ScatterPoint knows the boundary).
  constexpr double kTold = 0x1p-47, kToldInBox = 0x1p-23, kMostOfPath = 0.1;
  const double share = medium.typeName() == HomogeneousMedium::kTypeName ? kTold : kToldInBox;
  const double told = share * double{scene.largestCoordinate()}, sigma = medium.densestScattering();
  if (!(sigma * told > kMostOfPath) || !std::isfinite(told)) return "";
  std::ostringstream text;
  text.precision(3);
  text << "its mean free path, " << static_cast<float>(1 / sigma)
       << ", is less than ten times what coordinates can tell in a scene of this size, "
       << static_cast<float>(told) << ": what comes back out of it is not right; an extinction of at most "
       << static_cast<float>(kMostOfPath / told) << " looks the same and comes out right";
  return text.str();
}

}  // namespace

std::string describeComplaints(const Scene& scene) {
  std::string text;
  for (const Medium* medium : scene.media()) {
    for (const std::string& complaint : {medium->complaint(), describeUntold(*medium, scene)}) {
      if (complaint.empty()) continue;
      text += "pbrt: warning: medium \"";
      text += medium->name();
      text += "\": ";
      text += complaint;
      text += ".\n";
    }
  }
  return text;
}

}  // namespace pbrtmedia
