// SPDX-License-Identifier: BSD-2-Clause
#include "scene/spectrum_values.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "scene/lexer.h"
#include "spectrum/spectrum.h"

namespace pbrtmedia {

bool SpectrumValues::fromNumbers(Param& param, const ParamType& type, std::span<const float> n,
                                 const std::string& what, const Tolerate& tolerate) {
  auto& colours = param.values.emplace<std::vector<Rgb>>();
  param.isConverted = type.spectral != ParamType::Spectral::Rgb;
  const std::size_t per = type.perElement;
  std::size_t i = 0;
  try {
    if (type.spectral == ParamType::Spectral::Samples) {
      std::vector<SpectralSample> samples;
      for (; i + 1 < n.size(); i += 2) samples.push_back({n[i], n[i + 1]});
      i = 0;
      param.tokensPerElement = static_cast<std::uint32_t>(
          std::clamp<std::size_t>(n.size(), 1, std::numeric_limits<std::uint32_t>::max()));
      if (!samples.empty()) colours.push_back(sampledSpectrumToRgb(std::move(samples)));
    } else {
      for (; i + per <= n.size(); i += per) {
        switch (type.spectral) {
          case ParamType::Spectral::BlackBody:
            if (n[i] > 0) {
              colours.push_back(blackbodyToRgb(n[i], n[i + 1]));
            } else {
              tolerate(param.locationOf(i / per), "a black body without temperature",
                       " is black here; PBRT-v3 makes NaN of it");
              colours.emplace_back();
            }
            break;
          case ParamType::Spectral::Xyz:
            colours.push_back(xyzToRgb({n[i], n[i + 1], n[i + 2]}));
            break;
          default:
            colours.emplace_back(n[i], n[i + 1], n[i + 2]);
            break;
        }
      }
    }
  } catch (const std::invalid_argument& e) {
    diagnostics_.error(param.locationOf(i / per), what + e.what());
    return false;
  }
  for (std::size_t k = 0; k < colours.size(); ++k) {
    if (colours[k].isFinite()) continue;
    diagnostics_.error(param.locationOf(k), what + "the spectrum has no finite RGB value");
    return false;
  }
  return true;
}

bool SpectrumValues::fromFiles(Param& param, const InputFolders& folders, const std::string& what,
                               const Tolerate& tolerate) {
  constexpr std::string_view kBlack = "; black is taken, as in PBRT-v3";
  const auto names = std::get<std::vector<std::string>>(std::move(param.values));
  auto& colours = param.values.emplace<std::vector<Rgb>>();
  param.tokensPerElement = 1;
  param.isConverted = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!readFiles_) {
      colours.emplace_back();
      continue;
    }
    const SourceLocation at = param.locationOf(i);
    const auto found = folders.locate(names[i]);
    if (!found || !found->canBeOpened()) {
      tolerate(at, "there is no file \"" + shown(folders.underBase(names[i]).string()) + '"', kBlack);
      colours.emplace_back();
      continue;
    }
    if (found->besideIncluder) {
      diagnostics_.warning(at, "using \"" + found->path.string() + "\"; PBRT-v3 looks for \"" +
                                   folders.underBase(names[i]).string() + '"');
    }
    const auto [cached, isNew] = spectra_.try_emplace(found->path);
    try {
      if (isNew) cached->second = sampledSpectrumToRgb(readSpectrumFile(found->path, &diagnostics_));
    } catch (const SceneError& e) {
      const std::string place = e.location().line > 0 ? e.location().toString() + ": " : "";
      tolerate(at, place + e.what(), kBlack);
      cached->second = Rgb();
    } catch (const std::invalid_argument& e) {
      diagnostics_.error(at, what + '"' + found->path.string() + "\": " + e.what());
    }
    if (!cached->second) return false;
    colours.push_back(*cached->second);
  }
  return true;
}

}  // namespace pbrtmedia
