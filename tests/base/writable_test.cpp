// SPDX-License-Identifier: BSD-2-Clause
#include "base/writable.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

TEST(UnwritableReason, IsEmptyForWhatCanBeWrittenAndLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("old.exr", "old");
  EXPECT_EQ(unwritableReason(folder.path() / "new.exr"), "");
  EXPECT_EQ(unwritableReason(folder.path() / "old.exr"), "");
  EXPECT_EQ(folder.read("old.exr"), "old");
  EXPECT_EQ(folder.fileCount(), 1u);
  EXPECT_EQ(unwritableReason("/dev/null"), "");
}

TEST(UnwritableReason, TellsWhatIsInTheWay) {
  const TemporaryFolder folder;
  EXPECT_EQ(unwritableReason(folder.path()), "it is a folder");
  EXPECT_EQ(unwritableReason(folder.path() / "no" / "a.exr"),
            "folder \"" + (folder.path() / "no").string() + "\" does not exist");
  EXPECT_EQ(unwritableReason(folder.path() / (std::string(300, 'x') + ".exr")), "File name too long");
  if (std::filesystem::exists("/proc/self")) {
    EXPECT_NE(unwritableReason("/proc/self/a.exr"), "") << "a folder that takes no files";
  }
}

TEST(UnwritableReason, IsNeverEmptyWhereWritingFails) {
  const TemporaryFolder folder;
  // Names that fit, but not with the letters a temporary name adds: neither may pass for good.
  int failures = 0;
  for (std::size_t length = 200; length <= 255; ++length) {
    const std::filesystem::path file = folder.path() / (std::string(length - 4, 'x') + ".exr");
    bool isWritten = true;
    try {
      writeFileAtomically(file, [](const std::filesystem::path& temporary) {
        if (!std::ofstream(temporary)) throw std::runtime_error("cannot open");
      });
    } catch (const std::exception&) {
      isWritten = false;
    }
    EXPECT_TRUE(isWritten || !unwritableReason(file).empty()) << length;
    failures += isWritten ? 0 : 1;
  }
  EXPECT_GT(failures, 0);
}

}  // namespace
}  // namespace pbrtmedia
