// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "scene/graphics_state.h"
#include "scene/messages.h"
#include "scene/statement.h"

namespace pbrtmedia {

/// Carries out statements: keeps the graphics state (reference 5) and collects one description per WorldEnd.
/// Include is not its business.
class DescriptionBuilder {
 public:
  explicit DescriptionBuilder(Diagnostics& diagnostics) : diagnostics_(diagnostics) { reset(); }

  /// Throws SceneError, or adds to the diagnostics where the statement still means something.
  void apply(Statement s);
  /// The end of all input; reports a world without end and a scene without world.
  void finish();
  /// Whether a world is complete and no other has begun.
  bool isBehindWorld() const { return worlds_ > 0 && !inWorld_; }
  std::vector<SceneDescription> take() { return std::move(finished_); }

 private:
  void applyOption(Statement& s);
  void applyTransform(const Statement& s);
  void applyBlock(const Statement& s);
  void applyDefinition(Statement& s);

  void transformTimes(const Statement& s);
  void lookAt(const Statement& s);
  void transformBy(const Statement& s, const Transform& t);
  void setCtm(const Statement& s, TransformPair next);
  /// Whether everything that stands under the CTM is out of sight; said where it came into force.
  bool isOutOfSight() const;
  bool isPressedFlat(const Statement& s) const;
  void coordSysTransform(const Statement& s);
  void activeTransform(const Statement& s);
  void openBlock(const Statement& s);
  void closeBlock(const Statement& s, Directive opener);
  std::string misnested(const Statement& s, Directive opener) const;
  void beginObject(const Statement& s);
  void placeObject(const Statement& s);
  void beginWorld(const Statement& s);
  void endWorld(const Statement& s);
  void reset();

  void camera(Statement& s);
  void makeMedium(Statement& s);
  void mediumInterface(const Statement& s);
  void texture(Statement& s);
  void material(Statement& s, bool isNamed);
  void namedMaterial(const Statement& s);
  void light(Statement& s);
  void areaLight(Statement& s);
  void shape(Statement& s);

  const SharedMedia& mediaHere(const SourceLocation& user);
  void lookUp(MediumUse& use, const SourceLocation& user);
  void reportMissingMedia();
  void warnIfAnimated(const Statement& s);
  bool typeFromParameter(Statement& s, Entity& entity);
  /// The names nearest to `found` among those `names()` lists. Nothing after many of them: a list of all
  /// names for each of a million misspellings would take forever.
  template <class Names>
  std::string suggestFrom(std::string_view found, const Names& names) {
    return suggestions_++ < kMaxSuggestions ? suggest(found, names()) : std::string();
  }

  static constexpr std::size_t kMaxSuggestions = 25;
  Diagnostics& diagnostics_;
  SceneDescription scene_;
  GraphicsState state_;
  std::vector<OpenAttributes> openAttributes_;
  std::vector<OpenTransform> openTransforms_;
  bool inWorld_ = false;
  std::int32_t object_ = kNone;  ///< the object being defined
  std::unordered_map<std::string, std::uint32_t> mediaByName_, objectsByName_;
  std::map<std::string, SharedTransform> coordinateSystems_;
  struct Missing {
    SourceLocation named, user;
  };
  std::map<std::string, Missing> missingMedia_;  ///< by name: the first use of a medium not defined by then
  std::set<std::string> leftOutMedia_;  ///< defined, but where they cannot be; vacuum takes their place
  bool notedNesting_ = false;
  std::size_t worlds_ = 0, suggestions_ = 0;
  std::vector<SceneDescription> finished_;
};

}  // namespace pbrtmedia
