// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "construct/texturable.h"
#include "construct/textures.h"
#include "materials/material.h"
#include "scene/description.h"

namespace pbrtmedia {

class FourierTable;
class SubsurfaceTable;

/// All materials of a scene: read and checked at once, built when first used. A shape that overrides
/// parameters gets a material of its own, every other shape shares the one of its Material directive.
class Materials {
 public:
  /// How a material is made once its textures exist; empty for "no material".
  using Make = std::function<std::unique_ptr<Material>(Materials&)>;

  /// Reads every material; problems go to `diagnostics`. Both and `scene` must outlive this object.
  Materials(SceneDescription& scene, Textures& textures, Diagnostics& diagnostics);

  /// What a shape is made of: the material's number, or a plan of the shape's own.
  struct Use {
    std::int32_t material = kNone;  ///< into SceneDescription::materials; kNone: the default matte
    Make own;                       ///< set when the shape overrides parameters
    bool isNone = false;            ///< no material at all
  };
  /// Reads the material parameters that stand in a shape's list. `in` has been read by the shape already.
  Use readForShape(const ShapeDescription& shape, ParamReader& in, Diagnostics& diagnostics);

  /// Null for no material.
  const Material* build(const Use& use);
  const Material* buildShared(std::int32_t index);
  Textures& textures() { return textures_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  /// Tables that materials share.
  std::shared_ptr<const SubsurfaceTable> subsurfaceTable(float g, float eta);
  /// Throws SceneError for a file that is none.
  std::shared_ptr<const FourierTable> fourierTable(const std::filesystem::path& file);
  /// Keeps a material made by a plan.
  const Material* keep(std::unique_ptr<Material> material);

  std::size_t definedCount() const { return plans_.size(); }
  /// Whether some that was built has a BSSRDF.
  bool hasBssrdfs() const { return hasBssrdfs_; }
  /// Of those defined; the default and those of single shapes do not count.
  std::size_t builtCount() const;
  std::vector<std::unique_ptr<Material>> takeBuilt() { return std::move(built_); }

 private:
  SceneDescription& scene_;
  Textures& textures_;
  Diagnostics& diagnostics_;
  std::map<std::pair<float, float>, std::shared_ptr<const SubsurfaceTable>> subsurfaceTables_;
  std::map<std::filesystem::path, std::shared_ptr<const FourierTable>> fourierTables_;
  std::vector<Make> plans_;
  std::vector<const Material*> shared_;
  const Material* default_ = nullptr;
  bool hasBssrdfs_ = false;
  int nesting_ = 0;  ///< materials that are being built, each for the next
  std::vector<std::unique_ptr<Material>> built_;
};

}  // namespace pbrtmedia
