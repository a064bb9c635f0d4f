// SPDX-License-Identifier: BSD-2-Clause
#include "scene/input_folders.h"

#include <fstream>
#include <system_error>

namespace pbrtmedia {

bool InputFolders::Found::canBeOpened() const {
  std::error_code ignored;
  return !std::filesystem::is_directory(path, ignored) && std::ifstream(path).is_open();
}

std::filesystem::path InputFolders::underBase(std::string_view name) const { return base / name; }

std::optional<InputFolders::Found> InputFolders::locate(std::string_view name) const {
  std::error_code ignored;
  if (std::filesystem::path path = base / name; std::filesystem::exists(path, ignored)) {
    return Found{std::move(path), false};
  }
  if (own != base) {
    if (std::filesystem::path path = own / name; std::filesystem::exists(path, ignored)) {
      return Found{std::move(path), true};
    }
  }
  return std::nullopt;
}

}  // namespace pbrtmedia
