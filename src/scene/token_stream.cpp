// SPDX-License-Identifier: BSD-2-Clause
#include "scene/token_stream.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include "base/hash.h"
#include "base/interruption.h"
#include "scene/directives.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kKeptText = std::size_t{1} << 20;      // bytes of standard input kept for excerpts
constexpr std::size_t kReleaseStep = std::size_t{16} << 20;  // bytes read between giving memory back
constexpr std::size_t kLookedAt = 4096;                      // bytes that decide whether a file is text

/// What a file is when it is no 8-bit text; "" when it is.
std::string_view foreignEncoding(std::string_view text) {
  const auto starts = [&](std::string_view magic) { return text.substr(0, magic.size()) == magic; };
  using namespace std::string_view_literals;
  if (starts("\xff\xfe\0\0"sv) || starts("\0\0\xfe\xff"sv)) return "UTF-32 text; save it as UTF-8";
  if (starts("\xff\xfe"sv) || starts("\xfe\xff"sv)) return "UTF-16 text; save it as UTF-8";
  if (starts("ply\n"sv) || starts("ply\r"sv)) return "a PLY mesh; use it with Shape \"plymesh\"";
  if (starts(" BDV\0\0\0\0"sv)) {
    return "an OpenVDB volume, not a scene; run vdb2pbrt on it, which makes an .nvdb file for a medium of "
           "type "
           "\"nanovdb\"";
  }
  if (starts("NanoVDB"sv)) {
    return "a NanoVDB volume, not a scene; name it in MakeNamedMedium: \"string type\" \"nanovdb\" \"string "
           "filename\"";
  }
  if (starts("\x76\x2f\x31\x01"sv)) return "an OpenEXR image, not a scene";
  if (starts("\x89PNG"sv)) return "a PNG image, not a scene";
  const std::string_view head = text.substr(0, kLookedAt);
  std::size_t even = 0, odd = 0;
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (head[i] == '\0') ++(i % 2 == 0 ? even : odd);
  }
  if (even + odd == 0) return {};
  const bool oneSided = std::min(even, odd) == 0 && std::max(even, odd) > head.size() / 4;
  return oneSided ? "UTF-16 text without a byte order mark; save it as UTF-8"
                  : "binary data (it has NUL bytes), not a scene";
}

}  // namespace

void TokenStream::push(std::optional<FileBytes> file, std::string_view text, std::string_view shownName,
                       InputFolders folders, std::filesystem::path canonical,
                       const SourceLocation& includedAt) {
  auto name = std::make_shared<const std::string>(shownName);
  if (const std::string_view foreign = foreignEncoding(text); !foreign.empty()) {
    throw SceneError({name, 0, 0, 1}, "this is " + std::string(foreign));
  }
  addToHash(file ? &*file : nullptr, text);
  if (!canonical.empty()) files_.insert(canonical);
  if (!includedAt.file) open_.clear();
  const std::size_t start = text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;  // UTF-8 byte order mark
  open_.push_back({std::move(file), Lexer(text, start, keepComments_),
                   static_cast<std::uint32_t>(origins_.size()), std::move(canonical), includedAt});
  origins_.push_back({std::move(name), std::make_shared<const InputFolders>(std::move(folders))});
  peeked_.reset();
}

void TokenStream::addToHash(const FileBytes* file, std::string_view text) {
  textHash_ = hashCombine(textHash_, text.size());
  for (std::size_t at = 0; at < text.size(); at += kReleaseStep) {
    leaveIfStopped();
    textHash_ = hashText(text.substr(at, kReleaseStep), textHash_);
    if (file != nullptr && file->isMapped()) file->releaseUpTo(at);
  }
}

void TokenStream::pushText(std::string_view text, std::string_view shownName, InputFolders folders) {
  push(std::nullopt, text, shownName, std::move(folders), {}, {});
}

void TokenStream::pushFile(const std::filesystem::path& path, InputFolders folders,
                           const SourceLocation& includedAt) {
  constexpr const char* kStdin = "<stdin>";
  const bool isStdin = path == "-";
  FileBytes file = isStdin ? FileBytes::readDescriptor(0, kStdin) : FileBytes::open(path);
  const std::string_view text = file.text();
  if (isStdin && text.size() <= kKeptText) diagnostics_.keepText(kStdin, std::string(text));
  std::error_code ignored;
  push(std::move(file), text, isStdin ? kStdin : path.string(), std::move(folders),
       isStdin ? std::filesystem::path() : std::filesystem::weakly_canonical(path, ignored), includedAt);
}

std::optional<std::string> TokenStream::cycleTo(const std::filesystem::path& path) const {
  std::error_code ignored;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, ignored);
  const auto again =
      std::find_if(open_.begin(), open_.end(), [&](const Open& o) { return o.canonical == canonical; });
  if (again == open_.end()) return std::nullopt;
  std::string chain;
  // Each file with the place of its Include, in order of reading.
  for (auto it = again + 1; it != open_.end(); ++it) chain += it->includedAt.toString() + " -> ";
  return chain + *origins_[open_.back().origin].name;
}

const Token& TokenStream::peek() {
  while (!peeked_) {
    Open& top = open_.back();
    Token token = top.lexer.next();
    token.source = top.origin;
    if (top.variable) {
      token.line = top.variable->line;
      token.column = top.variable->column;
    }
    if (token.kind == Token::Kind::Comment) {
      comments_.push_back({std::string(token.raw), taken_ + 1});
    } else if (token.kind == Token::Kind::End && open_.size() > 1) {
      open_.pop_back();
    } else if (token.kind == Token::Kind::Unclosed && open_.size() > 1 && !skipping_) {
      dropRestOfFile(token);
    } else if (token.kind == Token::Kind::Word && token.raw.front() == '$' && !skipping_) {
      pushValue(token);
    } else {
      if (token.kind == Token::Kind::String && !skipping_) expand(token);
      peeked_ = token;
    }
  }
  return *peeked_;
}

void TokenStream::pushValue(const Token& variable) {
  const std::string_view name = variable.raw.substr(1);
  if (!Variables::isName(name)) {
    throw SceneError(locate(variable), "found " + shown(variable.raw) +
                                           ", expected $ and the name of a variable: letters, digits and _");
  }
  const std::string* const value = variables_.find(name);
  if (!value) {
    std::string message = "no variable \"" + shown(name) + '"';
    message += suggestion(name, variables_.names());
    message += "; give it a value: --define " + shown(name) + "=VALUE";
    if (hasDirectives_) message += ", or Define \"" + shown(name) + "\" VALUE above";
    throw SceneError(locate(variable), message);
  }
  const std::uint32_t origin = variable.source;
  open_.push_back({std::nullopt, Lexer(*value, 0, false), origin, {}, locate(variable), 0, variable});
}

void TokenStream::expand(Token& string) {
  if (string.raw.find_first_of("$#%") == string.raw.npos) return;
  try {
    std::optional<std::string> text = variables_.expanded(string.raw);
    if (!text) return;
    expanded_ = *std::move(text);
    string.raw = expanded_;
  } catch (const std::invalid_argument& e) {
    throw SceneError(locate(string), e.what());
  }
}

Token TokenStream::take() {
  leaveIfStopped();
  const Token token = peek();
  peeked_.reset();
  ++taken_;
  return token;
}

SourceLocation TokenStream::locate(const Token& token) const {
  return {origins_[token.source].name, token.line, token.column, token.length()};
}

std::optional<SceneError> TokenStream::missingQuote(const Token& token) const {
  const auto in =
      std::find_if(open_.begin(), open_.end(), [&](const Open& o) { return o.origin == token.source; });
  if (in == open_.end() || token.kind == Token::Kind::End) return std::nullopt;
  if (!in->lexer.holds(token.raw.data())) return std::nullopt;  // it came out of a variable
  const std::string_view line = in->lexer.lineAround(token.raw.data(), MissingQuote::kLongestLine);
  const auto missing = findMissingQuote(line);
  if (!missing) return std::nullopt;
  SourceLocation at = locate(token);
  const auto ofToken = static_cast<std::size_t>(token.raw.data() - line.data());
  at.column = static_cast<std::uint32_t>(at.column + missing->at - ofToken);
  at.length = 1;
  return SceneError(at, missing->message);
}

SceneError TokenStream::unclosed(const Token& token) const {
  if (auto missing = missingQuote(token)) return *missing;
  return {locate(token), "the string has no closing \" on its line"};
}

void TokenStream::throwUnclosed(const Token& token) const { throw unclosed(token); }

void TokenStream::dropRestOfFile(const Token& unclosedString) {
  const SceneError e = unclosed(unclosedString);
  const SourceLocation includedAt = open_.back().includedAt;
  const std::uint32_t first = unclosedString.line, last = open_.back().lexer.lastLine();
  open_.pop_back();
  const std::string dropped = last > first ? "from here on this file, lines " + std::to_string(first) +
                                                 " to " + std::to_string(last) + ", is left out"
                                           : "the rest of this line, the last of the file, is left out";
  diagnostics_.tolerated(e.location(), std::string(e.what()) + "; " + dropped +
                                           ", as in PBRT-v3, which goes on behind the Include at " +
                                           includedAt.toString());
}

std::size_t TokenStream::readFloats(float* out, std::size_t most) {
  if (peeked_) return 0;
  const std::size_t count = open_.back().lexer.readFloats(out, most);
  releaseConsumed();
  return count;
}

std::size_t TokenStream::readInts(int* out, std::size_t most) {
  if (peeked_) return 0;
  const std::size_t count = open_.back().lexer.readInts(out, most);
  releaseConsumed();
  return count;
}

void TokenStream::releaseConsumed() {
  leaveIfStopped();  // once for each block of numbers
  Open& top = open_.back();
  const std::size_t offset = top.lexer.offset();
  if (!top.file || offset - top.released < kReleaseStep) return;
  top.file->releaseUpTo(offset);
  top.released = offset;
}

void TokenStream::skipToDirective() {
  skipping_ = true;
  while (peek().kind != Token::Kind::End &&
         !(peek().kind == Token::Kind::Word && findDirective(peek().raw))) {
    take();
  }
  skipping_ = false;
}

void TokenStream::addBehindWorld(const SceneError& e) {
  for (;; take()) {
    skipToDirective();
    if (peek().kind == Token::Kind::End) break;
    if (findDirective(peek().raw)->id == Directive::WorldBegin) return diagnostics_.add(e);
  }
  diagnostics_.tolerated(
      e.location(), std::string(e.what()) + "; this is behind the last WorldEnd, so the rest is not read");
}

void TokenStream::dropComments(std::size_t count) {
  comments_.erase(comments_.begin(), comments_.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace pbrtmedia
