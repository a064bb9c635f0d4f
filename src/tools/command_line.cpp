// SPDX-License-Identifier: BSD-2-Clause
#include "tools/command_line.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <span>
#include <string_view>

#include "base/diagnostics.h"
#include "tools/build_info.h"

namespace pbrtmedia {
namespace {

std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string withNearest(const std::string& found, const std::vector<std::string>& known) {
  const std::vector<std::string_view> views(known.begin(), known.end());
  return '"' + found + '"' + suggestion(found, views);
}

/// What stands before "=".
std::string nameOf(const std::string& word) { return word.substr(0, word.find('=')); }

std::string inSmallLetters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> optionsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// What is wrong with the words, and whose help tells more.
struct Complaint {
  std::string what, helper;
};

Complaint complaintOf(const CLI::App& app, const std::vector<std::string>& words,
                      const CLI::ParseError& error) {
  const CLI::App* asked = &app;
  std::string helper = app.get_name();
  if (const std::vector<std::string> commands = commandsOf(app); !commands.empty()) {
    const auto word =
        std::find_if(words.begin(), words.end(), [](const std::string& w) { return w.substr(0, 1) != "-"; });
    const bool isKnown = word != words.end() && std::count(commands.begin(), commands.end(), *word) > 0;
    if (word != words.end() && !isKnown) return {"unknown command " + withNearest(*word, commands), helper};
    if (isKnown) {
      asked = app.get_subcommand(*word);
      helper += ' ' + *word;
    } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
      std::string known;
      for (const std::string& command : commands) known += (known.empty() ? "" : ", ") + command;
      return {"expected a command; known: " + known, helper};
    }
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    std::vector<std::string> known = optionsOf(*asked);
    for (const std::string& name : optionsOf(app)) {
      if (std::count(known.begin(), known.end(), name) == 0) known.push_back(name);
    }
    for (const std::string& word : words) {
      if (word.size() < 2 || word[0] != '-' || word == "--") continue;
      const std::string name = nameOf(word);
      const bool isShort = name[1] != '-';
      if (isShort && (name[1] == '.' || (name[1] >= '0' && name[1] <= '9'))) continue;  // a number
      const bool isKnown = std::any_of(known.begin(), known.end(), [&](const std::string& one) {
        return one == (isShort ? name.substr(0, 2) : name);
      });
      if (!isKnown) return {"unknown option " + withNearest(name, known), helper};
    }
    if (const std::vector<std::string> rest = app.remaining(/*recurse=*/true); !rest.empty())
      return {"unexpected argument \"" + rest.front() + '"', helper};
  }
  return {error.what(), helper};
}

}  // namespace

bool NumberRange::holds(double x) const {
  return std::isfinite(x) && (excludesLeast ? x > least : x >= least) && x <= most;
}

std::string NumberRange::describe() const {
  const bool below = std::isfinite(least), above = std::isfinite(most);
  const std::string lower = (excludesLeast ? "above " : "from ") + shortest(least);
  if (below && above) return "a number " + lower + (excludesLeast ? ", at most " : " to ") + shortest(most);
  if (below)
    return excludesLeast ? "a finite number " + lower : "a finite number of at least " + shortest(least);
  return above ? "a finite number of at most " + shortest(most) : "a finite number";
}

CLI::Validator number(NumberRange range) {
  const auto check = [range](std::string& text) -> std::string {
    double value = 0;
    const char *begin = text.data(), *const end = begin + text.size();
    if (text.size() > 1 && *begin == '+') ++begin;
    const auto [at, status] = std::from_chars(begin, end, value);
    if (status == std::errc() && at == end && range.holds(value)) return {};
    return "found " + text + ", expected " + range.describe();
  };
  return CLI::Validator(check, "");
}

CLI::Validator oneOf(const std::map<std::string, std::string>& textOf) {
  const auto change = [textOf](std::string& text) -> std::string {
    if (const auto found = textOf.find(inSmallLetters(text)); found != textOf.end()) {
      text = found->second;
      return {};
    }
    std::vector<std::string> known;
    for (const auto& [word, value] : textOf) known.push_back(word);
    return "found " + withNearest(text, known);
  };
  return CLI::Validator(change, "");
}

CLI::Validator oneOf(std::initializer_list<const char*> words) {
  std::map<std::string, std::string> textOf;
  for (const char* word : words) textOf[word] = word;
  return oneOf(textOf);
}

std::string shellWord(std::string_view word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=,.:/+%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::optional<int> parseCommandLine(CLI::App& app, const std::vector<std::string>& words) {
  if (app.get_version_ptr() == nullptr) {
    app.set_version_flag("--version", buildText())
        ->description("print version, commit, compiler, build type and instruction set");
  }
  try {
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    app.parse(std::move(reversed));
    return std::nullopt;
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
  } catch (const CLI::CallForVersion&) {
    std::cout << buildText() << '\n';
  } catch (const CLI::ParseError& e) {
    const auto [what, helper] = complaintOf(app, words, e);
    std::cerr << app.get_name() << ": error: " << what << "\nRun '" << helper
              << " --help' for all options.\n";
    return 1;
  }
  return 0;
}

}  // namespace pbrtmedia
