// SPDX-License-Identifier: BSD-2-Clause
#include "scene/variables.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scene/lexer.h"
#include "scene/parse.h"
#include "scene/print.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

Parsed parseWith(const Variables& variables, std::string_view text,
                 const std::filesystem::path& folder = {}) {
  Parsed p;
  p.scenes = parseText(text, "t.pbrt", folder, p.diagnostics, {.variables = variables});
  return p;
}

Variables with(std::initializer_list<std::pair<std::string, std::string>> values) {
  Variables v;
  for (const auto& [name, value] : values) v.set(name, value);
  return v;
}

constexpr const char* kWorld = "WorldBegin\nWorldEnd\n";

template <class T>
std::vector<T> valuesOf(const Entity& e, ParamKind kind, std::string_view name) {
  const Param* const p = e.params.find(kind, name);
  return p ? std::get<std::vector<T>>(p->values) : std::vector<T>();
}

std::string filenameOf(Parsed p) {
  EXPECT_EQ(p.messages(), "");
  if (p.scenes.empty()) return "";
  return valuesOf<std::string>(p.scene().film, ParamKind::String, "filename").at(0);
}

TEST(Variables, StandForNumbersStringsAndLists) {
  Parsed p = parseWith(with({{"fov", "33.5"}, {"type", "perspective"}, {"window", "[ -1 1 -2 2 ]"}}),
                       std::string("Camera $type \"float fov\" $fov \"float screenwindow\" $window "
                                   "\"float focaldistance\" [ $fov ]\n") +
                           kWorld);
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().camera.type, "perspective");
  EXPECT_EQ(valuesOf<float>(p.scene().camera, ParamKind::Float, "fov"), std::vector<float>{33.5f});
  EXPECT_EQ(valuesOf<float>(p.scene().camera, ParamKind::Float, "focaldistance"), std::vector<float>{33.5f});
  EXPECT_EQ(valuesOf<float>(p.scene().camera, ParamKind::Float, "screenwindow"),
            (std::vector<float>{-1, 1, -2, 2}));
}

/// The quick path for numbers reads on in the values, too.
TEST(Variables, StandBetweenOtherValues) {
  Parsed p = parseWith(with({{"a", "2"}, {"b", "[7]"}}),
                       std::string("Film \"image\" \"float cropwindow\" [ 0 $a 1 $a ]\n"
                                   "Camera \"perspective\" \"float fov\" $b\n") +
                           kWorld);
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(valuesOf<float>(p.scene().film, ParamKind::Float, "cropwindow"),
            (std::vector<float>{0, 2, 1, 2}));
  EXPECT_EQ(valuesOf<float>(p.scene().camera, ParamKind::Float, "fov"), std::vector<float>{7});
}

TEST(Variables, StandForNumbersOfTransformations) {
  Parsed p =
      parseWith(with({{"x", "-3e1"}}), std::string("Translate $x 0 $x\nCamera \"perspective\"\n") + kWorld);
  EXPECT_EQ(p.messages(), "");
  const Vec3d origin = p.scene().camera.worldFromCamera->start.point(Vec3d(0, 0, 0));
  EXPECT_EQ(origin, Vec3d(30, 0, 30));
}

TEST(Variables, TextThatIsNoValueIsAString) {
  EXPECT_EQ(Variables::tokensOf("1.5"), "1.5");
  EXPECT_EQ(Variables::tokensOf("[1 2]"), "[1 2]");
  EXPECT_EQ(Variables::tokensOf("[ \"a\" \"b\" ]"), "[ \"a\" \"b\" ]");
  EXPECT_EQ(Variables::tokensOf("\"a b\""), "\"a b\"");
  for (const std::string text : {"ratio", "a b", "", "true", "[1", "1]", "[[1]]", "a\"b", "3d", "# 1", "$x",
                                 "WorldEnd", "\\", "x\ny"}) {
    EXPECT_EQ(Variables::tokensOf(text), inQuotes(text)) << text;
  }
}

TEST(Variables, DefaultsYieldToTheCommandLineAndToEarlierOnes) {
  const std::string text =
      "Define \"a\" 1\nDefine \"a\" 2\nDefine \"b\" 3\nDefine \"c\" [ $a $b ]\n"
      "Film \"image\" \"float cropwindow\" [ $a $b ] \"float diagonal\" $c\n";
  Parsed p = parseWith(with({{"b", "9"}}), text + kWorld);
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(valuesOf<float>(p.scene().film, ParamKind::Float, "cropwindow"), (std::vector<float>{1, 9}));
  EXPECT_EQ(valuesOf<float>(p.scene().film, ParamKind::Float, "diagonal"), (std::vector<float>{1, 9}));
}

TEST(Variables, OfTheIncluderReplaceDefaultsOfTheIncluded) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "template.pbrt")
      << "Define \"a\" 1\nDefine \"b\" 2\nFilm \"image\" \"float cropwindow\" [ $a $b ]\n";
  Parsed p =
      parseWith({}, std::string("Define \"b\" 5\nInclude \"template.pbrt\"\n") + kWorld, folder.path());
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(valuesOf<float>(p.scene().film, ParamKind::Float, "cropwindow"), (std::vector<float>{1, 5}));
}

TEST(Variables, StandInStrings) {
  const auto name = [](const std::string& text, Variables v) {
    return filenameOf(parseWith(v, "Film \"image\" \"string filename\" \"" + text + "\"\n" + kWorld));
  };
  EXPECT_EQ(name("a-${n}.exr", with({{"n", "7"}})), "a-7.exr");
  EXPECT_EQ(name("${n:4}${m}", with({{"n", "7"}, {"m", "x y"}})), "0007x y");
  EXPECT_EQ(name("${n:2}", with({{"n", "12345"}})), "12345");
  EXPECT_EQ(name("${m}.exr", with({{"m", "a\"b\\c"}})), "a\"b\\c.exr") << "escapes stay escapes";
  EXPECT_EQ(name("$n ${ n} $ {n} ${", {}), "$n ${ n} $ {n} ${") << "no variables";
}

TEST(Variables, TheFrameFillsItsPlaces) {
  Variables v;
  v.setFrame(12);
  const auto name = [&](const std::string& text) {
    return filenameOf(parseWith(v, "Film \"image\" \"string filename\" \"" + text + "\"\n" + kWorld));
  };
  EXPECT_EQ(name("a-####.exr"), "a-0012.exr");
  EXPECT_EQ(name("##/a.###.exr"), "12/a.012.exr");
  EXPECT_EQ(name("s.$F4.%02d.exr"), "s.0012.12.exr");
  EXPECT_EQ(name("a-%04d.exr"), "a-0012.exr");
  EXPECT_EQ(name("${frame}-${frame:3}"), "12-012");
  Parsed p = parseWith(v, std::string("Translate 0 0 $frame\n") + kWorld);
  EXPECT_EQ(p.messages(), "");
  Parsed without = parse(std::string("Film \"image\" \"string filename\" \"a-####.exr\"\n") + kWorld);
  EXPECT_EQ(filenameOf(std::move(without)), "a-####.exr");
}

TEST(Variables, ErrorsStandWhereTheVariableIs) {
  const auto message = [](const Variables& v, const std::string& text) {
    const Parsed p = parseWith(v, text + kWorld);
    EXPECT_TRUE(p.diagnostics.hasErrors()) << text;
    return p.messages();
  };
  const auto expectIn = [](const std::string& all, const std::string& part) {
    EXPECT_NE(all.find(part), std::string::npos) << "expected " << part << " in\n" << all;
  };
  std::string said = message(with({{"fog", "1"}}), "Define \"tau\" 1\nTranslate 0 0 $tua\nScale $fog 1 1\n");
  expectIn(said, "t.pbrt:2:15: error: no variable \"tua\"; did you mean \"tau\"?");
  expectIn(said, "--define tua=VALUE, or Define \"tua\" VALUE above");
  EXPECT_EQ(said.find("fog: nothing"), said.npos) << "it was used";
  said = message(with({{"fov", "wide"}}), "Translate 1 2 $fov\n");
  expectIn(said, "t.pbrt:1:15: error: Translate: found \"wide\" after 2");
  expectIn(message({}, "Translate 1 2 $\n"), "t.pbrt:1:15: error: found $, expected $ and the name");
  expectIn(message({}, "Translate 1 2 $a-b\n"), "expected $ and the name of a variable");
  expectIn(message({}, "Define \"x\" word\n"),
           "t.pbrt:1:12: error: Define: found word, expected the variable's value");
  expectIn(message({}, "Define \"x\" [ 1 Film ]\n"),
           "t.pbrt:1:16: error: Define: found Film, expected numbers");
  expectIn(message({}, "Define \"x\"\n"), "Define: found WorldBegin");
  expectIn(message({}, "Define \"1x\" 1\n"), "t.pbrt:1:8: error: Define: found \"1x\", expected the name");
  expectIn(message({}, "Film \"image\" \"string filename\" \"${n}\"\n"),
           "t.pbrt:1:32: error: no variable \"n\"");
  expectIn(message(with({{"n", "[1 2]"}}), "Film \"image\" \"string filename\" \"${n}\"\n"),
           "place for one word");
  expectIn(message(with({{"n", "a"}}), "Film \"image\" \"string filename\" \"${n:4}\"\n"),
           "expected a whole number");
  std::string doubling = "Define \"a0\" \"0123456789\"\n";
  for (int i = 1; i < 40; ++i) {
    const std::string of = "${a" + std::to_string(i - 1) + "}";
    doubling += "Define \"a" + std::to_string(i) + "\" \"" + of + of + "\"\n";
  }
  expectIn(message({}, doubling), "longer than 65536 bytes");
  expectIn(message(with({{"n", "1"}}), "Film \"image\" \"string filename\" \"${n:x}\"\n"), "expected digits");
  expectIn(message(with({{"n", "1"}}), "Film \"image\" \"string filename\" \"${n:4000000000}\"\n"),
           "expected digits");
}

TEST(Variables, OfTheCommandLineMustBeUsed) {
  const Parsed p =
      parseWith(with({{"tua", "1"}}), std::string("Define \"tau\" 1\nTranslate 0 0 $tau\n") + kWorld);
  EXPECT_NE(p.messages().find("error: --define tua: nothing in the scene uses $tua; did you mean \"tau\"?"),
            std::string::npos)
      << p.messages();
  Variables frame;
  frame.setFrame(1);
  EXPECT_EQ(parseWith(frame, kWorld).messages(), "");
}

/// What is another render has another hash; what is the same scene has the same one.
TEST(Variables, BelongToTheScene) {
  const std::string text = std::string("Define \"a\" 1\nTranslate 0 0 $a\n") + kWorld;
  using Used = std::vector<Variables::Used>;
  const auto used = [&](const Variables& v, const std::string& of) {
    return parseWith(v, of).scenes.at(0).variables;
  };
  EXPECT_EQ(used({}, text), (Used{{"a", "1"}}));
  EXPECT_EQ(used(with({{"a", "1"}}), text), (Used{{"a", "1"}}));
  EXPECT_EQ(used(with({{"a", "2"}}), text), (Used{{"a", "2"}}));
  for (const char* same : {"1.20", "1.2", "+12e-1", "0001.2000"})
    EXPECT_EQ(used(with({{"a", same}}), text), (Used{{"a", "1.2"}})) << same;
  EXPECT_EQ(used(with({{"a", "-0"}}), text), (Used{{"a", "0"}}));
  const std::string list = std::string("Film \"image\" \"float cropwindow\" $a\n") + kWorld;
  EXPECT_EQ(used(with({{"a", "[ 0.0 1. .50 1 ]"}}), list), (Used{{"a", "[ 0 1 0.5 1 ]"}}));
  // In a string it is its letters that count.
  const std::string named = std::string("Film \"image\" \"string filename\" \"${a}\"\n") + kWorld;
  EXPECT_EQ(used(with({{"a", "1.20"}}), named), (Used{{"a", "1.20"}}));
  // The text is the same, whatever they are; and so is one that has the number of a frame in a name.
  const auto hash = [&](const Variables& v) { return parseWith(v, text).scenes.at(0).textHash; };
  EXPECT_EQ(hash({}), hash(with({{"a", "2"}})));
  Variables frame;
  frame.setFrame(7);
  EXPECT_EQ(used(frame, std::string("Film \"image\" \"string filename\" \"a-####\"\n") + kWorld),
            (Used{{"frame", "7"}}));
  EXPECT_EQ(used(frame, kWorld), Used{});
}

TEST(Variables, ArePrintedAsTheirValues) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "t.pbrt") << "Define \"n\" [ 1 2 ]\nDefine \"s\" \"x\"\nFilm \"image\" "
                                             "\"integer a\" $n \"string b\" \"${s}-$s\"\n";
  Diagnostics diagnostics;
  std::ostringstream out;
  printFiles(std::vector<std::filesystem::path>{folder.path() / "t.pbrt"}, out, diagnostics,
             {.variables = with({{"s", "y"}})});
  EXPECT_EQ(diagnostics.format(), "");
  EXPECT_EQ(out.str(),
            "Define \"n\" [ 1 2 ]\nDefine \"s\" \"x\"\nFilm \"image\"\n    \"integer a\" [ 1 2 ]\n"
            "    \"string b\" [ \"y-$s\" ]\n");
}

}  // namespace
}  // namespace pbrtmedia
