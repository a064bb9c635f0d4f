// SPDX-License-Identifier: BSD-2-Clause
#include "scene/parser.h"

#include <functional>
#include <memory>
#include <set>
#include <system_error>

#include "base/hash.h"
#include "base/interruption.h"
#include "scene/description_builder.h"

namespace pbrtmedia {
namespace {

class Parser {
 public:
  Parser(Diagnostics& diagnostics, const ParseOptions& options)
      : diagnostics_(diagnostics),
        options_(options),
        tokens_(diagnostics, options.variables),
        params_(tokens_, diagnostics, options.readFiles),
        statements_(tokens_, params_),
        builder_(diagnostics),
        errorLimit_(diagnostics.errorCount() + options.maxErrors) {}

  /// Reads what `open` pushes on the tokens; false: stopped for too many errors.
  bool read(const std::function<void(TokenStream&)>& open) {
    try {
      open(tokens_);
    } catch (const SceneError& e) {
      diagnostics_.add(e);
      return true;
    }
    while (diagnostics_.errorCount() < errorLimit_) {
      leaveIfStopped();
      try {
        std::optional<Statement> s = statements_.next();
        if (!s) return true;
        carryOut(std::move(*s));
      } catch (const SceneError& e) {
        if (builder_.isBehindWorld()) {
          tokens_.addBehindWorld(e);
        } else {
          diagnostics_.add(e);
          tokens_.skipToDirective();
        }
      }
    }
    diagnostics_.error({}, "too many errors; the rest is not read");
    stopped_ = true;
    return false;
  }

  std::vector<SceneDescription> finish() {
    params_.looseNumbers().report();
    if (!stopped_) builder_.finish();
    if (diagnostics_.errorCount() == 0) reportUnused();
    if (options_.variablesAfter) *options_.variablesAfter = tokens_.variables();
    std::vector<SceneDescription> worlds = builder_.take();
    const std::vector<Variables::Used> variables = tokens_.variables().used();
    const auto files = std::make_shared<const std::set<std::filesystem::path>>(filesRead());
    for (std::size_t i = 0; i < worlds.size(); ++i) {
      worlds[i].textHash = hashCombine(tokens_.textHash(), i);
      worlds[i].variables = variables;
      worlds[i].files = files;
    }
    return worlds;
  }

 private:
  /// The statement has been read to its end, so nothing is skipped when it fails.
  void carryOut(Statement s) {
    try {
      if (s.info->id == Directive::Include) {
        include(s);
      } else if (s.info->id == Directive::Define) {
        define(s);
      } else {
        builder_.apply(std::move(s));
      }
    } catch (const SceneError& e) {
      diagnostics_.add(e);
    }
  }

  void define(Statement& s) {
    Statement::Text& name = s.strings[0];
    if (!Variables::isName(name.text)) {
      throw SceneError(name.at,
                       "Define: found \"" + shown(name.text) +
                           "\", expected the name of a variable: a letter, then letters, digits and _");
    }
    tokens_.variables().setDefault(name.text, std::move(s.value));
  }

  std::set<std::filesystem::path> filesRead() const {
    std::set<std::filesystem::path> files = tokens_.files();
    std::error_code ignored;
    for (const auto& [file, colour] : params_.spectra().files())
      files.insert(std::filesystem::weakly_canonical(file, ignored));
    return files;
  }

  /// A name that was mistyped would leave the image as it was.
  void reportUnused() {
    Variables& variables = tokens_.variables();
    for (const std::string_view name : variables.unused()) {
      std::vector<std::string_view> others = variables.names();
      std::erase(others, name);
      std::string message = "--define " + std::string(name) + ": nothing in the scene uses $";
      message += name;
      diagnostics_.error({}, message + suggestion(name, others));
    }
  }

  void include(const Statement& s) {
    const Statement::Text& name = s.strings[0];
    if (!options_.readFiles) return;
    if (++includes_ > options_.maxIncludes) {
      throw SceneError(s.at, "more than " + std::to_string(options_.maxIncludes) + " Include directives");
    }
    if (tokens_.openFiles() >= options_.maxIncludeDepth) {
      throw SceneError(s.at,
                       "Include goes deeper than " + std::to_string(options_.maxIncludeDepth) + " files");
    }
    const auto found = s.folders->locate(name.text);
    if (!found) {
      std::string looked = "there is no file \"" + shown(s.folders->underBase(name.text).string()) + '"';
      if (s.folders->own != s.folders->base) {
        looked += ", nor \"" + shown((s.folders->own / name.text).string()) + '"';
      }
      return diagnostics_.tolerated(name.at, looked + "; the Include is left out, as in PBRT-v3");
    }
    if (!found->canBeOpened()) {
      return diagnostics_.tolerated(name.at, "cannot read the file \"" + shown(found->path.string()) +
                                                 "\"; the Include is left out, as in PBRT-v3");
    }
    if (const auto cycle = tokens_.cycleTo(found->path)) {
      throw SceneError(name.at, "Include would never end: " + *cycle + ':' + std::to_string(s.at.line) + ':' +
                                    std::to_string(s.at.column) + " -> " + found->path.string());
    }
    if (found->besideIncluder) {
      diagnostics_.warning(name.at, "using \"" + found->path.string() + "\"; PBRT-v3 looks for \"" +
                                        s.folders->underBase(name.text).string() + '"');
    }
    try {
      tokens_.pushFile(found->path, {s.folders->base, found->path.parent_path()}, s.at);
    } catch (const SceneError& e) {
      diagnostics_.add(e);
      diagnostics_.note(name.at, "the file is named here");
    }
  }

  Diagnostics& diagnostics_;
  const ParseOptions& options_;
  TokenStream tokens_;
  ParamParser params_;
  StatementReader statements_;
  DescriptionBuilder builder_;
  std::size_t errorLimit_, includes_ = 0;
  bool stopped_ = false;
};

}  // namespace

std::vector<SceneDescription> parseFiles(std::span<const std::filesystem::path> files,
                                         Diagnostics& diagnostics, const ParseOptions& options) {
  Parser parser(diagnostics, options);
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path folder = file == "-" ? std::filesystem::path() : file.parent_path();
    const bool goOn = parser.read([&](TokenStream& tokens) { tokens.pushFile(file, {folder, folder}, {}); });
    if (!goOn) break;
  }
  return parser.finish();
}

std::vector<SceneDescription> parseText(std::string_view text, std::string_view shownName,
                                        const std::filesystem::path& folder, Diagnostics& diagnostics,
                                        const ParseOptions& options) {
  diagnostics.keepText(std::string(shownName), std::string(text));
  Parser parser(diagnostics, options);
  parser.read([&](TokenStream& tokens) { tokens.pushText(text, shownName, {folder, folder}); });
  return parser.finish();
}

}  // namespace pbrtmedia
