// SPDX-License-Identifier: BSD-2-Clause
#include "base/writable.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace pbrtmedia {
namespace {

std::string lastReason() { return std::generic_category().message(errno); }

}  // namespace

std::string unwritableReason(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path target = fs::is_symlink(path, error) ? fs::weakly_canonical(path, error) : path;
  const fs::file_status old = fs::status(target, error);
  if (fs::is_directory(old)) return "it is a folder";
  if (fs::exists(old) && !fs::is_regular_file(old)) {
    return ::access(target.c_str(), W_OK) == 0 ? std::string() : lastReason();
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) return "folder \"" + folder.string() + "\" does not exist";
  // Files are written under a temporary name beside the final one, with a number; the probe is at least as
  // long.
  std::string name = ".";
  name.append(target.filename().string()).append(".part").append(std::to_string(::getpid())).append("-0000");
  const fs::path probe = folder / name;
  const int file = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  // Another machine's process of the same number probes at this moment.
  if (file < 0) return errno == EEXIST ? std::string() : lastReason();
  ::close(file);
  ::unlink(probe.c_str());
  return {};
}

void checkWritable(const std::filesystem::path& path) {
  const std::string reason = unwritableReason(path);
  if (!reason.empty()) throw std::runtime_error("cannot write \"" + path.string() + "\": " + reason);
}

}  // namespace pbrtmedia
