// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/files.h"
#include "scene/input_folders.h"
#include "scene/lexer.h"
#include "scene/variables.h"

namespace pbrtmedia {

/// The tokens of a file with those of included files in place. The end of an included file is not seen:
/// reading goes on in the includer, and so it does, tolerated, at a string of it that is not closed
/// (reference 1). Values stand where variables were, at the places of these. A token's text is valid until
/// the next token is peeked or taken.
class TokenStream {
 public:
  /// `diagnostics` must outlive the stream.
  explicit TokenStream(Diagnostics& diagnostics, Variables variables, bool keepComments = false)
      : diagnostics_(diagnostics), variables_(std::move(variables)), keepComments_(keepComments) {}

  /// Reads on in a file; "-" is standard input. Without `includedAt` it takes the place of the one before.
  /// Throws SceneError when it cannot be read or is no text.
  /// A stream that cannot be read twice is kept in the diagnostics for excerpts, if it is small.
  void pushFile(const std::filesystem::path& path, InputFolders folders, const SourceLocation& includedAt);
  /// Reads on in a text that outlives the stream.
  void pushText(std::string_view text, std::string_view shownName, InputFolders folders);
  /// What is read holds parameters alone: messages recommend no directive.
  void expectNoDirectives() { hasDirectives_ = false; }

  /// Throws SceneError at a variable without a value.
  const Token& peek();
  Token take();
  SourceLocation locate(const Token& token) const;
  const std::shared_ptr<const InputFolders>& folders(const Token& token) const {
    return origins_[token.source].folders;
  }
  /// Numbers that follow, see Lexer::readFloats; none when a token has been peeked.
  std::size_t readFloats(float* out, std::size_t most);
  std::size_t readInts(int* out, std::size_t most);
  /// What to say when a quote is missing on the line of the token, whose file is still open.
  std::optional<SceneError> missingQuote(const Token& token) const;
  /// Throws what `missingQuote` gives, or that the string is not closed.
  [[noreturn]] void throwUnclosed(const Token& token) const;
  /// Skips tokens, also bad ones, up to a directive or the end.
  void skipToDirective();
  /// Reports a problem behind a WorldEnd and skips to the next WorldBegin. Without one it is tolerated:
  /// PBRT-v3 ends there, but has rendered the worlds before it.
  void addBehindWorld(const SceneError& e);

  /// Hash of every text pushed so far, in order, without the values of variables.
  std::uint64_t textHash() const { return textHash_; }
  /// All files pushed so far, without links on their way.
  const std::set<std::filesystem::path>& files() const { return files_; }

  Variables& variables() { return variables_; }
  std::size_t openFiles() const { return open_.size(); }
  /// "a.pbrt:3:1 -> b.pbrt:1:1" when `path` is being read now, which a further Include would do without end.
  std::optional<std::string> cycleTo(const std::filesystem::path& path) const;

  /// A comment and the number of the token it precedes, counted by `tokensTaken`.
  struct Comment {
    std::string text;
    std::size_t beforeToken;
  };
  const std::vector<Comment>& comments() const { return comments_; }
  void dropComments(std::size_t count);
  std::size_t tokensTaken() const { return taken_; }

 private:
  struct Origin {
    std::shared_ptr<const std::string> name;
    std::shared_ptr<const InputFolders> folders;
  };
  struct Open {
    std::optional<FileBytes> file;
    Lexer lexer;
    std::uint32_t origin;
    std::filesystem::path canonical;  ///< empty: not a file
    SourceLocation includedAt;
    std::size_t released = 0;
    std::optional<Token> variable{};  ///< whose value the text is
  };
  void push(std::optional<FileBytes> file, std::string_view text, std::string_view shownName,
            InputFolders folders, std::filesystem::path canonical, const SourceLocation& includedAt);
  /// Reads on in the value of the variable that the token names.
  void pushValue(const Token& variable);
  /// The string with the values of the variables in it.
  void expand(Token& string);
  void releaseConsumed();
  SceneError unclosed(const Token& token) const;
  /// Goes back to the includer, as there is an unclosed string in the included file, and says so.
  void dropRestOfFile(const Token& unclosedString);
  void addToHash(const FileBytes* file, std::string_view text);

  Diagnostics& diagnostics_;
  Variables variables_;
  std::string expanded_;  ///< text of the token that was expanded last
  std::vector<Open> open_;
  std::set<std::filesystem::path> files_;
  std::vector<Origin> origins_;
  std::optional<Token> peeked_;
  std::vector<Comment> comments_;
  std::size_t taken_ = 0;
  std::uint64_t textHash_ = 0;
  bool skipping_ = false;  ///< behind an error: no file is left before its end
  bool keepComments_;
  bool hasDirectives_ = true;
};

}  // namespace pbrtmedia
