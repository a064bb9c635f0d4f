// SPDX-License-Identifier: BSD-2-Clause
#include "construct/layers.h"
#include "image/codecs.h"

#include <span>
#include <string_view>
#include <vector>

namespace pbrtmedia {
namespace {

constexpr std::string_view kAll = "all";

std::string listOf(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

}  // namespace

LayerRequest readLayers(ParamReader& film, const ConstructOptions& options,
                        const std::filesystem::path& outfile, Diagnostics& diagnostics) {
  LayerRequest request;
  const std::span<const std::string> ofScene = film.strings("layers");
  std::vector<std::string> names(ofScene.begin(), ofScene.end());
  if (options.layers) {
    names = *options.layers;
    request.context = "--layers";
  } else if (!names.empty()) {
    request.at = film.locationOf(ParamKind::String, "layers");
    request.context = film.context() + ": parameter \"layers\"";
  }
  for (const std::string& name : names) {
    const std::optional<Layer> layer = layerOfName(name);
    if (layer) {
      request.mask.set(static_cast<std::size_t>(*layer));
    } else if (name == kAll) {
      request.all = true;
    } else {
      std::vector<std::string_view> known = layerNames();
      known.push_back(kAll);
      diagnostics.error(request.at,
                        request.context + ": unknown layer \"" + name + '"' + suggestion(name, known));
    }
  }
  if (!names.empty() && formatByExtension(outfile) != ImageFormat::Exr) {
    diagnostics.error(request.at, request.context +
                                      ": layers are channels of an OpenEXR file, and the image is \"" +
                                      outfile.string() +
                                      "\"; expected a name that ends in .exr (--png "
                                      "writes the colours as a PNG beside it)");
  }
  return request;
}

LayerSet chooseLayers(const LayerRequest& request, const Integrator& integrator, Diagnostics& diagnostics) {
  const LayerMask there = integrator.layers();
  const LayerMask missing = request.mask & ~there;
  if (missing.any()) {
    const std::string names = listOf(layerNames(missing));
    diagnostics.error(request.at, request.context + ": Integrator \"" + std::string(integrator.typeName()) +
                                      "\" cannot fill " + names + "; it fills " +
                                      (there.any() ? listOf(layerNames(there)) : "no layers"));
  }
  return LayerSet(request.all ? there : request.mask & there);
}

}  // namespace pbrtmedia
