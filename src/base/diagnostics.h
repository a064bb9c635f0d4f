// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pbrtmedia {

/// A stretch of text in a file. A plain value that travels with each token; file names are shared.
struct SourceLocation {
  std::shared_ptr<const std::string> file;  ///< as shown to the user; null: not from a file
  std::uint32_t line = 0;                   ///< 1-based; 0: the file as a whole
  std::uint32_t column = 0;                 ///< 1-based, in bytes
  std::uint32_t length = 1;                 ///< bytes underlined by the caret line

  /// "file:line:column", "file", or "" where nothing is known.
  std::string toString() const;
};

enum class Severity { Note, Warning, Error };

struct Diagnostic {
  Severity severity = Severity::Error;
  SourceLocation location;
  std::string message;  ///< what is wrong, what was found, what was expected; no trailing newline
  std::string excerpt;  ///< the source line, or "" (then no caret is drawn)
};

/// Thrown by library code for broken input that ends the operation at hand. `main` catches and prints.
class SceneError : public std::runtime_error {
 public:
  SceneError(SourceLocation location, const std::string& message)
      : std::runtime_error(message), location_(std::move(location)) {}
  const SourceLocation& location() const { return location_; }

 private:
  SourceLocation location_;
};

/// Collects problems so that all of them are shown together. Not thread-safe.
class Diagnostics {
 public:
  void note(const SourceLocation& at, std::string message) { add(Severity::Note, at, std::move(message)); }
  void warning(const SourceLocation& at, std::string message) {
    add(Severity::Warning, at, std::move(message));
  }
  void error(const SourceLocation& at, std::string message) { add(Severity::Error, at, std::move(message)); }
  void add(Severity severity, const SourceLocation& at, std::string message);
  void add(const SceneError& e) { error(e.location(), e.what()); }

  /// --strict: what `tolerated` reports is an error.
  bool strict = false;
  /// A problem that PBRT-v3 renders in spite of: a warning, an error when `strict`; the message says that
  /// --strict decides.
  void tolerated(const SourceLocation& at, std::string message);

  /// Keeps the text of an input that cannot be read again (standard input), for excerpts.
  void keepText(const std::string& shownName, std::string text) { kept_[shownName] = std::move(text); }

  bool hasErrors() const { return errors_ > 0; }
  std::size_t errorCount() const { return errors_; }
  const std::vector<Diagnostic>& all() const { return items_; }
  /// All messages, in order of report, each as "file:line:column: error: message" with the source line and a
  /// caret under the stretch; excerpts are read from the files now. Identical repeats are shown once. At most
  /// `kMaxShown` errors and as many other messages are shown, then the numbers left out.
  std::string format() const;
  static constexpr std::size_t kMaxShown = 50;
  /// Later items are counted only, so that a hostile file cannot fill the memory with complaints.
  static constexpr std::size_t kMaxKept = 10000;
  /// Texts are no longer kept, so a costly one need not be made.
  bool isFull() const { return items_.size() >= kMaxKept; }

 private:
  std::vector<Diagnostic> items_;
  std::map<std::string, std::string> kept_;  ///< shown name to text
  std::size_t errors_ = 0, notKept_ = 0;
};

/// "; did you mean \"x\"? known: …" when one name is close enough, else "; known: …"; "" without names.
std::string suggestion(std::string_view found, std::span<const std::string_view> known);

}  // namespace pbrtmedia
