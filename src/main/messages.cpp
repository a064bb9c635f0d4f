// SPDX-License-Identifier: BSD-2-Clause
#include "main/messages.h"

#include <iostream>
#include <sstream>
#include <string>

namespace pbrtmedia {
namespace {

std::string named(const std::string& messages) {
  std::string text;
  std::istringstream lines(messages);
  for (std::string line; std::getline(lines, line);) {
    for (const char* severity : {"error: ", "warning: ", "note: "}) {
      if (line.starts_with(severity)) text += "pbrt: ";
    }
    text += line + '\n';
  }
  return text;
}

}  // namespace

void show(const Diagnostics& diagnostics, bool quiet) {
  if (!quiet) {
    std::cerr << named(diagnostics.format());
    return;
  }
  Diagnostics errors;
  for (const Diagnostic& d : diagnostics.all()) {
    if (d.severity == Severity::Error) errors.add(d.severity, d.location, d.message);
  }
  std::cerr << named(errors.format());
}

}  // namespace pbrtmedia
