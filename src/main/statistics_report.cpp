// SPDX-License-Identifier: BSD-2-Clause
#include "main/statistics_report.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "base/files.h"
#include "main/progress.h"
#include "tools/build_info.h"

namespace pbrtmedia {
namespace {

constexpr std::array<const char*, static_cast<std::size_t>(DropCause::kCount)> kDropNames = {
    "nan", "infinite", "negative"};

nlohmann::ordered_json toJson(const PhaseTime& time) { return {{"wall", time.wall}, {"cpu", time.cpu}}; }

nlohmann::ordered_json toJson(const RenderCounters& c) {
  nlohmann::ordered_json dropped;
  for (std::size_t i = 0; i < kDropNames.size(); ++i) dropped[kDropNames[i]] = c.dropped[i];
  return {{"cameraSamples", c.cameraSamples},
          {"rays", c.rays},
          {"shadowRays", c.shadowRays},
          {"densityLookups", c.densityLookups},
          {"nullCollisions", c.nullCollisions},
          {"mediumScatterings", c.mediumScatterings},
          {"surfaceScatterings", c.surfaceScatterings},
          {"boundViolations", c.boundViolations},
          {"worstBoundRatio", c.worstBoundRatio},
          {"cappedEstimates", c.cappedEstimates},
          {"stuckPaths", c.stuckPaths},
          {"mediumMismatches", c.mediumMismatches},
          {"boundaryRepairs", c.boundaryRepairs},
          {"droppedSamples", dropped}};
}

nlohmann::ordered_json toJson(const BuiltParts& built) {
  nlohmann::ordered_json all;
  for (std::size_t i = 0; i < kPartCount; ++i) {
    const auto part = static_cast<Part>(i);
    all[std::string(nameOf(part))] = built[part];
  }
  return all;
}

/// Share of the cells looked up in so far whose bound the pass found to hold.
double boundingShare(const LearningProgress& p) {
  return p.visited > 0 ? 1 - static_cast<double>(p.raised) / static_cast<double>(p.visited) : 1;
}

nlohmann::ordered_json toJson(const LearningRecord& record) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const LearningProgress& p : record.passes) {
    passes.push_back({{"visitedCells", p.visited},
                      {"raisedCells", p.raised},
                      {"boundingShare", boundingShare(p)},
                      {"violations", p.cut},
                      {"largestBound", p.maximum}});
  }
  return {{"medium", record.medium},
          {"cells", record.passes.empty() ? record.warmUp.cells : record.passes.back().cells},
          {"restored", record.restored},
          {"warmUp",
           {{"passes", record.warmUpPasses},
            {"blockEdge", record.warmUpBlockEdge},
            {"densityLookups", record.warmUpLookups},
            {"largestBound", record.warmUp.maximum}}},
          {"shortfall", record.shortfall},
          {"passes", passes}};
}

nlohmann::ordered_json toJson(const std::vector<LearningRecord>& records) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const LearningRecord& record : records) all.push_back(toJson(record));
  return all;
}

nlohmann::ordered_json toJson(const std::vector<RenderPart>& parts) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const RenderPart& part : parts) {
    all.push_back({{"firstSample", part.first},
                   {"endSample", part.end},
                   {"seconds", toJson(part.time)},
                   {"threads", part.threads},
                   {"version", part.version}});
  }
  return all;
}

double lostPerPass(const RankShare& rank) {
  return (rank.traffic.waiting + rank.traffic.moving) /
         static_cast<double>(std::max<std::uint64_t>(rank.passes, 1));
}

nlohmann::ordered_json toJson(const std::vector<RankShare>& ranks) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const RankShare& rank : ranks) {
    all.push_back({{"threads", rank.threads},
                   {"cpuSeconds", rank.cpu},
                   {"bytesSent", rank.traffic.bytes},
                   {"passes", rank.passes},
                   {"messages", rank.traffic.messages},
                   {"secondsWaiting", rank.traffic.waiting},
                   {"secondsMoving", rank.traffic.moving},
                   {"secondsLost", rank.traffic.waiting + rank.traffic.moving},
                   {"secondsLostPerPass", lostPerPass(rank)}});
  }
  return all;
}

const char* nameOf(DifferenceSchedule::Difference difference) {
  return difference == DifferenceSchedule::Difference::Forward ? "forward" : "central";
}

const char* nameOf(DifferenceSchedule::Debias debias) {
  switch (debias) {
    case DifferenceSchedule::Debias::Single:
      return "single";
    case DifferenceSchedule::Debias::Progressive:
      return "progressive";
    case DifferenceSchedule::Debias::None:
      break;
  }
  return "none";
}

nlohmann::ordered_json toJson(const DerivativeRecord& record) {
  const DifferenceSchedule::Params& p = record.options.difference;
  nlohmann::ordered_json json = {{"variable", record.options.variable},
                                 {"value", p.value},
                                 {"step", p.step},
                                 {"difference", nameOf(p.difference)},
                                 {"debias", nameOf(p.debias)}};
  if (p.debias == DifferenceSchedule::Debias::Progressive) json["stepDecay"] = p.decay;
  json["samplesPerPass"] = record.samplesPerPass;
  json["passes"] = record.passes;
  json["scenesBuilt"] = record.scenesBuilt;
  return json;
}

nlohmann::ordered_json toJson(const RenderStatistics& s) {
  nlohmann::ordered_json derivative;
  if (s.derivative) derivative = toJson(*s.derivative);
  return {{"scene", s.scene},
          {"outfile", s.outfile},
          {"seed", s.seed},
          {"samplesPerPixel", s.samplesPerPixel},
          {"samplesTaken", s.samplesTaken},
          {"samplesPlanned", s.samplesPlanned},
          {"threads", s.threads},
          {"interrupted", s.interrupted},
          {"stoppedBy", s.stoppedBy},
          {"seconds",
           {{"parse", toJson(s.parse)},
            {"construct", toJson(s.construct)},
            {"render", toJson(s.render)},
            {"measure", toJson(s.measure)},
            {"write", toJson(s.write)}}},
          {"derivative", derivative},
          {"parts", toJson(s.parts)},
          {"ranks", toJson(s.ranks)},
          {"counters", toJson(s.counters)},
          {"built", toJson(s.built)},
          {"learnedBounds", toJson(s.learning)},
          {"peakMemoryBytes", s.peakMemory}};
}

double perSample(std::uint64_t count, const RenderStatistics& s) {
  return s.samplesTaken > 0 ? static_cast<double>(count) / static_cast<double>(s.samplesTaken) : 0;
}

/// What the ranks lost by being several.
std::string describeRanks(const RenderStatistics& s) {
  double waiting = 0, moving = 0, most = 0;
  std::uint64_t bytes = 0, threads = 0;
  for (const RankShare& rank : s.ranks) {
    threads += rank.threads;
    bytes += rank.traffic.bytes;
    waiting += rank.traffic.waiting;
    moving += rank.traffic.moving;
    most = std::max(most, lostPerPass(rank));
  }
  const auto ofAll = static_cast<double>(s.ranks.size());
  std::ostringstream os;
  os.precision(3);
  os << "  ranks     " << s.ranks.size() << " with " << threads << " threads, "
     << formatCount(static_cast<double>(bytes)) << "B moved";
  if (const std::uint64_t passes = s.ranks.front().passes; passes > 0)
    os << " in " << passes << (passes == 1 ? " pass (" : " passes (")
       << formatCount(static_cast<double>(bytes) / static_cast<double>(passes)) << "B each)";
  os << "; each waited " << formatDuration(waiting / ofAll) << " for others and moved data for "
     << formatDuration(moving / ofAll) << ", at most " << formatDuration(most) << " in a pass\n";
  return os.str();
}

}  // namespace

std::string formatStatistics(const RenderStatistics& s) {
  const RenderCounters& c = s.counters;
  std::ostringstream os;
  os.precision(3);
  const auto phase = [](const PhaseTime& t) {
    return formatDuration(t.wall) + " (cpu " + formatDuration(t.cpu) + ")";
  };
  os << "  time      parse " << phase(s.parse) << ", construct " << phase(s.construct) << ", render "
     << phase(s.render);
  if (s.measure.wall > 0) os << ", measure " << phase(s.measure);
  os << ", write " << phase(s.write) << '\n';
  if (s.parts.size() > 1) {
    std::istringstream parts(formatParts(s.parts));
    for (std::string line; std::getline(parts, line);) os << "  part      " << line << '\n';
  }
  if (!s.ranks.empty()) os << describeRanks(s);
  if (s.derivative) {
    os << "  derivative " << s.derivative->passes << (s.derivative->passes == 1 ? " pass of " : " passes of ")
       << s.derivative->samplesPerPass << " samples; " << s.derivative->scenesBuilt << " scenes built\n";
  }
  if (s.samplesTaken > 0) {
    os << "  samples   " << formatCount(static_cast<double>(s.samplesTaken)) << ", "
       << 1e6 * s.render.cpu / static_cast<double>(s.samplesTaken) << " us of CPU each\n";
  }
  os << "  rays      " << formatCount(static_cast<double>(c.rays)) << " (" << perSample(c.rays, s)
     << " per sample), shadow " << formatCount(static_cast<double>(c.shadowRays)) << '\n';
  if (c.densityLookups > 0) {
    os << "  media     " << formatCount(static_cast<double>(c.densityLookups)) << " density lookups ("
       << perSample(c.densityLookups, s) << " per sample), "
       << formatCount(static_cast<double>(c.nullCollisions)) << " null collisions, "
       << formatCount(static_cast<double>(c.mediumScatterings)) << " scatterings\n";
  }
  for (const LearningRecord& record : s.learning) {
    if (record.passes.empty()) continue;
    if (record.warmUpPasses > 0) {
      os << "  bounds    \"" << record.medium << "\": " << record.warmUpPasses << " passes of warm-up took "
         << formatCount(static_cast<double>(record.warmUpLookups)) << " lookups";
      if (const std::int64_t edge = record.warmUpBlockEdge; edge > 1)
        os << ", in blocks of " << edge << " x " << edge << " x " << edge << " super-voxels";
      os << '\n';
    }
    const LearningProgress& last = record.passes.back();
    os << "  bounds    \"" << record.medium << "\": " << last.visited << " of " << last.cells
       << " super-voxels visited, " << 100 * boundingShare(last) << " % of them bounding in the last pass, "
       << last.cut << " lookups cut\n";
  }
  os << "  memory    " << formatCount(static_cast<double>(s.peakMemory)) << "B at most\n";
  return os.str();
}

std::string formatParts(const std::vector<RenderPart>& parts) {
  std::ostringstream text;
  for (const RenderPart& part : parts) {
    text << "samples " << part.first << " to " << part.end << " of each pixel in "
         << formatDuration(part.time.wall) << " (cpu " << formatDuration(part.time.cpu) << ", "
         << part.threads << (part.threads == 1 ? " thread)" : " threads)") << '\n';
  }
  return text.str();
}

std::string statisticsText(const RenderStatistics& statistics) {
  // Names of files may be no text at all.
  return toJson(statistics).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void writeStatistics(const std::filesystem::path& path, const std::vector<std::string>& renders) {
  nlohmann::ordered_json root = {{"version", buildText()}, {"renders", nlohmann::ordered_json::array()}};
  for (const std::string& text : renders) {
    auto one = nlohmann::ordered_json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!one.is_discarded()) root["renders"].push_back(std::move(one));
  }
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary);
    out << root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
    out.close();
    if (!out) throw std::runtime_error("cannot write " + temporary.string());
  });
}

}  // namespace pbrtmedia
