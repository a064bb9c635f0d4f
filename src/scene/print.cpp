// SPDX-License-Identifier: BSD-2-Clause
#include "scene/print.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <ostream>
#include <utility>

#include "scene/param_parser.h"
#include "scene/ply_output.h"
#include "scene/statement.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::size_t kIndent = 2;

template <class T>
std::string number(T x) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, x).ptr};
}

/// Calls `each` with the words of a value list, as the language writes them.
template <class Each>
void forEachWord(const Param& p, Each&& each) {
  const auto values = [&](const auto& all) {
    using V = typename std::decay_t<decltype(all)>::value_type;
    for (const V& v : all) {
      if constexpr (std::is_same_v<V, std::string>) {
        each(inQuotes(v));
      } else if constexpr (std::is_same_v<V, std::uint8_t>) {
        each(v != 0 ? "\"true\"" : "\"false\"");
      } else if constexpr (std::is_same_v<V, Point2f>) {
        each(number(v.x));
        each(number(v.y));
      } else if constexpr (std::is_same_v<V, Point3f>) {
        each(number(v.x));
        each(number(v.y));
        each(number(v.z));
      } else if constexpr (std::is_same_v<V, Rgb>) {
        each(number(v.r));
        each(number(v.g));
        each(number(v.b));
      } else {
        each(number(v));
      }
    }
  };
  std::visit(values, p.values);
}

class Printer {
 public:
  Printer(std::ostream& out, Diagnostics& diagnostics, const PrintOptions& options)
      : out_(out),
        diagnostics_(diagnostics),
        options_(options),
        tokens_(diagnostics, options.variables, /*keepComments=*/true),
        params_(tokens_, diagnostics, /*readFiles=*/true),
        statements_(tokens_, params_) {}

  template <class Open>
  void print(const Open& open) {
    const std::size_t errors = diagnostics_.errorCount();
    try {
      open(tokens_);
      while (std::optional<Statement> s = statements_.next()) {
        if (diagnostics_.errorCount() > errors) break;
        printComments(tokens_.tokensTaken());
        printStatement(*s);
        if (s->info->id == Directive::Define) tokens_.variables().setDefault(s->strings[0].text, s->value);
        if (s->info->id == Directive::WorldBegin || s->info->id == Directive::WorldEnd)
          isBehindWorld_ = s->info->id == Directive::WorldEnd;
      }
      if (diagnostics_.errorCount() == errors) printComments(tokens_.tokensTaken() + 1);
    } catch (const SceneError& e) {
      if (isBehindWorld_) {
        tokens_.addBehindWorld(e);
      } else {
        diagnostics_.add(e);
      }
    }
    params_.looseNumbers().report();
  }

 private:
  /// Those before the given token; a comment inside a statement comes out before it.
  void printComments(std::size_t lastToken) {
    const auto& all = tokens_.comments();
    const auto end =
        std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.beforeToken > lastToken; });
    for (auto it = all.begin(); it != end; ++it) out_ << std::string(indent_, ' ') << it->text << '\n';
    tokens_.dropComments(static_cast<std::size_t>(end - all.begin()));
  }

  void printStatement(Statement& s) {
    const std::string_view name = s.info->name;
    const bool ends = name.ends_with("End"), begins = name.ends_with("Begin");
    if (ends && indent_ >= kIndent) indent_ -= kIndent;
    if (name == "WorldBegin") out_ << '\n';
    if (options_.meshesToPly && s.info->id == Directive::Shape) toPly(s);
    out_ << std::string(indent_, ' ') << name;
    if (s.info->word) out_ << ' ' << s.word;
    if (s.info->numbers == 16) out_ << " [";
    for (std::size_t i = 0; i < s.info->numbers; ++i) out_ << ' ' << number(s.numbers[i]);
    if (s.info->numbers == 16) out_ << " ]";
    for (const Statement::Text& text : s.strings) out_ << ' ' << inQuotes(text.text);
    if (s.info->value) out_ << ' ' << s.value;
    out_ << '\n';
    for (const Param& p : s.params.all()) printParam(p);
    if (begins) indent_ += kIndent;
  }

  void printParam(const Param& p) {
    const std::string indent(indent_ + 2 * kIndent, ' ');
    out_ << indent << inQuotes(std::string(keyword(p.kind)) + ' ' + p.name) << " [";
    std::size_t column = indent.size() + p.name.size() + 12;
    forEachWord(p, [&](std::string_view word) {
      if (column + word.size() + 1 > kLineWidth) {
        out_ << '\n' << indent << ' ';
        column = indent.size();
      }
      out_ << ' ' << word;
      column += word.size() + 1;
    });
    out_ << " ]\n";
  }

  /// Replaces a big triangle mesh by a PLY file. Meshes with tangents or face numbers, which a plymesh cannot
  /// have, and those that are no valid mesh stay as they are.
  void toPly(Statement& s) {
    if (s.strings[0].text != "trianglemesh") return;
    const ParamList& in = s.params;
    const auto ints = [&](std::string_view name) { return values<int>(in.find(ParamKind::Integer, name)); };
    PlyMesh mesh;
    mesh.indices = ints("indices");
    mesh.points = values<Point3f>(in.find(ParamKind::Point3, "P"));
    mesh.normals = values<Normal3f>(in.find(ParamKind::Normal, "N"));
    if (mesh.indices.size() < options_.minPlyIndices || mesh.indices.size() % 3 != 0) return;
    if (in.find(ParamKind::Vector3, "S") || in.find(ParamKind::Integer, "faceIndices")) return;
    const auto count = static_cast<int>(std::min<std::size_t>(mesh.points.size(), INT32_MAX));
    if (std::any_of(mesh.indices.begin(), mesh.indices.end(), [&](int i) { return i < 0 || i >= count; }))
      return;
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.points.size()) return;
    const std::vector<Point2f> uv = textureCoordinates(in);
    if (!uv.empty() && uv.size() != mesh.points.size()) return;
    mesh.uv = uv;

    std::string digits = std::to_string(++meshes_);
    digits.insert(0, 5 - std::min<std::size_t>(digits.size(), 5), '0');
    const std::string file = options_.plyPrefix + '_' + digits + ".ply";
    writePly(options_.plyFolder / file, mesh);

    ParamList rest;
    Param name;
    name.kind = ParamKind::String;
    name.name = "filename";
    name.values = std::vector<std::string>{file};
    rest.add(std::move(name));
    constexpr std::array<std::string_view, 5> kInFile{"indices", "P", "N", "uv", "st"};
    for (const Param& p : in.all()) {
      if (std::find(kInFile.begin(), kInFile.end(), p.name) == kInFile.end()) rest.add(p);
    }
    s.strings[0].text = "plymesh";
    s.params = std::move(rest);
  }

  template <class T>
  static std::span<const T> values(const Param* p) {
    if (!p) return {};
    return std::get<std::vector<T>>(p->values);
  }

  /// In the order PBRT-v3 looks for them: point2 uv, point2 st, float uv, float st.
  static std::vector<Point2f> textureCoordinates(const ParamList& in) {
    for (const std::string_view name : {"uv", "st"}) {
      if (const auto v = values<Point2f>(in.find(ParamKind::Point2, name)); !v.empty())
        return {v.begin(), v.end()};
    }
    std::vector<Point2f> uv;
    for (const std::string_view name : {"uv", "st"}) {
      const auto v = values<float>(in.find(ParamKind::Float, name));
      for (std::size_t i = 0; i + 1 < v.size(); i += 2) uv.push_back({v[i], v[i + 1]});
      if (!uv.empty()) break;
    }
    return uv;
  }

  std::ostream& out_;
  Diagnostics& diagnostics_;
  const PrintOptions& options_;
  TokenStream tokens_;
  ParamParser params_;
  StatementReader statements_;
  std::size_t indent_ = 0, meshes_ = 0;
  bool isBehindWorld_ = false;
};

}  // namespace

std::string textOf(const ParamList& params) {
  std::vector<std::string> entries;
  for (const Param& p : params.all()) {
    std::string words;
    forEachWord(p, [&](std::string_view word) { words.append(" ").append(word); });
    std::string entry = inQuotes(std::string(keyword(p.kind)) + ' ' + p.name);
    const bool isOneWord = p.size() == 1 && words.find(' ', 1) == words.npos;
    entry.append(isOneWord ? "" : " [").append(words).append(isOneWord ? "" : " ]");
    entries.push_back(std::move(entry));
  }
  std::sort(entries.begin(), entries.end());
  std::string text;
  for (const std::string& entry : entries) text += (text.empty() ? "" : " ") + entry;
  return text;
}

void printFiles(std::span<const std::filesystem::path> files, std::ostream& out, Diagnostics& diagnostics,
                const PrintOptions& options) {
  Printer printer(out, diagnostics, options);
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path folder = file == "-" ? std::filesystem::path() : file.parent_path();
    printer.print([&](TokenStream& tokens) { tokens.pushFile(file, {folder, folder}, {}); });
  }
}

void printText(std::string_view text, std::string_view shownName, const std::filesystem::path& folder,
               std::ostream& out, Diagnostics& diagnostics, const PrintOptions& options) {
  diagnostics.keepText(std::string(shownName), std::string(text));
  Printer printer(out, diagnostics, options);
  printer.print([&](TokenStream& tokens) { tokens.pushText(text, shownName, {folder, folder}); });
}

}  // namespace pbrtmedia
