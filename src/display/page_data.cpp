// SPDX-License-Identifier: BSD-2-Clause
#include "display/page_data.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

namespace pbrtmedia {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json errors(const ErrorHistory& history) {
  Json rows = Json::array();
  for (const std::vector<double>& row : history.rows) {
    Json values = Json::array();
    for (const double value : row) values.push_back(number(value));
    rows.push_back(std::move(values));
  }
  return {{"source", history.source}, {"columns", history.columns}, {"rows", std::move(rows)}};
}

Json bounds(const BoundsStatus& b) {
  return {{"medium", b.medium},           {"restored", b.restored},
          {"passes", b.passes},           {"cells", b.cells},
          {"visited", b.visited},         {"raised", b.raised},
          {"largest", number(b.largest)}, {"shortfall", number(b.shortfall)}};
}

}  // namespace

std::string statusText(const RenderStatus& status) {
  Json media = Json::array();
  for (const BoundsStatus& b : status.bounds) media.push_back(bounds(b));
  const Json all = {{"run", status.run},
                    {"title", status.title},
                    {"outfile", status.outfile},
                    {"version", status.version},
                    {"phase", status.phase},
                    {"message", status.message},
                    {"samplesDone", status.samplesDone},
                    {"samplesTotal", status.samplesTotal},
                    {"samplesPerPixel", status.samplesPerPixel},
                    {"seed", status.seed},
                    {"threads", status.threads},
                    {"seconds", number(status.seconds)},
                    {"secondsLeft", status.secondsLeft ? number(*status.secondsLeft) : Json(nullptr)},
                    {"errors", errors(status.errors)},
                    {"bounds", std::move(media)},
                    {"warnings", status.warnings}};
  // File names may be of any bytes.
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string imageHeader(const Snapshot& snapshot) {
  const Image& image = snapshot.image;
  std::string names;
  for (const std::string& channel : image.channels()) names += channel + '\0';
  names.resize((names.size() + 3) / 4 * 4);
  std::string header = "PMI1";
  for (const std::size_t value :
       {static_cast<std::size_t>(snapshot.sequence), static_cast<std::size_t>(image.width()),
        static_cast<std::size_t>(image.height()), image.channelCount(), names.size()}) {
    const auto word = static_cast<std::uint32_t>(value);
    char bytes[sizeof word];
    std::memcpy(bytes, &word, sizeof word);
    header.append(bytes, sizeof word);
  }
  return header + names;
}

}  // namespace pbrtmedia
