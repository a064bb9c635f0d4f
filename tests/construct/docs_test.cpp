// SPDX-License-Identifier: BSD-2-Clause
// What the documentation says must be so.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "base/variant_names.h"
#include "construct/attempt.h"
#include "freeflight/any_flight.h"
#include "main/statistics_report.h"
#include "singlescattering/medium_light_sampling.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

const std::filesystem::path kRoot = test::sourceDir();

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The ```pbrt blocks of a page.
std::vector<std::string> snippetsOf(const std::string& page) {
  std::vector<std::string> snippets;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```pbrt") {
      inside = true;
      snippets.emplace_back();
    } else if (line == "```") {
      inside = false;
    } else if (inside) {
      snippets.back() += line + '\n';
    }
  }
  return snippets;
}

TEST(Docs, EverySceneSnippetIsAGoodScene) {
  std::vector<std::filesystem::path> pages = {kRoot / "README.md"};
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  std::size_t found = 0;
  for (const auto& page : pages) {
    for (const std::string& snippet : snippetsOf(textOf(page))) {
      ++found;
      const bool isWhole = snippet.find("WorldBegin") != std::string::npos;
      const Attempt a = attempt(isWhole ? snippet : "WorldBegin\n" + snippet + "WorldEnd\n",
                                {.build = {.outfile = "unused.exr"}, .folder = kRoot / "scenes"});
      EXPECT_TRUE(a.made.has_value()) << page << '\n' << snippet << a.messages();
    }
  }
  EXPECT_GE(found, 4u) << "the snippets are no longer found";
}

void collectKeys(const nlohmann::ordered_json& value, const std::string& prefix,
                 std::set<std::string>& keys) {
  for (const auto& [key, inner] : value.items()) {
    const std::string name = prefix.empty() ? key : prefix + '.' + key;
    if (inner.is_object()) {
      collectKeys(inner, name, keys);
    } else {
      keys.insert(name);
    }
  }
}

TEST(Docs, TheKeysOfTheStatisticsAreThoseThatAreWritten) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "s.json";
  writeStatistics(file, {statisticsText(RenderStatistics{})});
  const auto root = nlohmann::ordered_json::parse(textOf(file));
  std::set<std::string> top, written, documented;
  for (const auto& [key, value] : root.items()) top.insert(key);
  EXPECT_EQ(top, (std::set<std::string>{"version", "renders"}));
  collectKeys(root["renders"][0], "", written);

  std::istringstream lines(textOf(kRoot / "docs" / "statistics.md"));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| `", 0) != 0) continue;
    const std::string cell = line.substr(1, line.find('|', 1) - 1);
    const std::regex key("`([^`]+)`");
    for (std::sregex_iterator m(cell.begin(), cell.end(), key), end; m != end; ++m)
      documented.insert((*m)[1]);
  }
  EXPECT_EQ(documented, written);
}

/// Words in backticks of the text.
std::set<std::string> namesIn(const std::string& text) {
  std::set<std::string> names;
  const std::regex word("`([a-z0-9-]+)`");
  for (std::sregex_iterator m(text.begin(), text.end(), word), end; m != end; ++m) names.insert((*m)[1]);
  return names;
}

TEST(Docs, TheNamesOfTheSceneLanguageAreThoseThatAreKnown) {
  std::set<std::string> known;
  const std::regex entry(R"x(\{"([a-z0-9]+)",\s*(read|\[))x");
  for (const auto& file : std::filesystem::directory_iterator(kRoot / "src" / "construct")) {
    if (file.path().extension() != ".cpp") continue;
    const std::string text = textOf(file.path());
    for (std::sregex_iterator m(text.begin(), text.end(), entry), end; m != end; ++m) known.insert((*m)[1]);
  }
  EXPECT_GE(known.size(), 60u) << "the tables are no longer found";
  for (const std::string_view name : flightNames()) known.insert(std::string(name));
  for (const std::string_view name : alternativeNames<MediumLightSampling>()) known.insert(std::string(name));

  const std::string page = textOf(kRoot / "docs" / "scene-language.md");
  const std::size_t begin = page.find("\n## Names of plugins\n"), end = page.find("\n## ", begin + 1);
  ASSERT_NE(begin, page.npos);
  EXPECT_EQ(namesIn(page.substr(begin, end - begin)), known);
}

}  // namespace
}  // namespace pbrtmedia::test
