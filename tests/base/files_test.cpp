// SPDX-License-Identifier: BSD-2-Clause
#include "base/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "base/diagnostics.h"
#include "support/gzip.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string openError(const std::filesystem::path& file, std::size_t max = 1 << 30) {
  try {
    FileBytes::open(file, max);
  } catch (const SceneError& e) {
    EXPECT_EQ(e.location().toString(), file.string());
    return e.what();
  }
  return "no error";
}

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

TEST(FileBytes, MayUnpackToWhatRealFilesDo) {
  EXPECT_GT(mostUnpacked(1100000), (std::uint64_t{1} << 30) + 1000) << "an empty grid of a GiB";
  EXPECT_LT(mostUnpacked(std::uint64_t{64} << 20), std::uint64_t{11} << 30) << "no 64 GiB from 64 MiB";
}

TEST(FileBytes, GivesTheBytesOfAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(FileBytes::open(folder.write("a", "hello")).text(), "hello");
  EXPECT_EQ(FileBytes::open(folder.write("empty", "")).text(), "");
  FileBytes a = FileBytes::open(folder.write("a", "one")), b = FileBytes::open(folder.write("b", "two"));
  a = std::move(b);
  EXPECT_EQ(a.text(), "two");
  const FileBytes c(std::move(a));
  EXPECT_EQ(c.text(), "two");
  EXPECT_EQ(c.bytes().size(), 3u);
}

TEST(FileBytes, NamesPathAndReason) {
  const TemporaryFolder folder;
  EXPECT_EQ(openError(folder.path() / "none"),
            "cannot open \"" + (folder.path() / "none").string() + "\": No such file or directory");
  EXPECT_EQ(openError(folder.path()), "cannot open \"" + folder.path().string() + "\": it is a directory");
}

TEST(FileBytes, UnpacksGzipAndJoinedGzip) {
  const TemporaryFolder folder;
  std::string large;
  for (int i = 0; i < 400000; ++i) large += std::to_string(i) + ' ';
  EXPECT_EQ(FileBytes::open(folder.write("a.gz", gzipped(large))).text(), large);
  EXPECT_EQ(FileBytes::open(folder.write("b.gz", gzipped("one") + gzipped("two"))).text(), "onetwo");
  EXPECT_EQ(FileBytes::open(folder.write("c.gz", gzipped(""))).text(), "");
  EXPECT_EQ(FileBytes::open(folder.write("d.gz", gzipped("padded") + std::string(512, '\0'))).text(),
            "padded");
}

TEST(FileBytes, NamesTruncatedCorruptAndTooLargeGzip) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 20000; ++i) text += std::to_string(i * 7919 % 10007) + ' ';
  const std::string packed = gzipped(text);
  for (const std::size_t size : {std::size_t{2}, std::size_t{12}, packed.size() / 2, packed.size() - 1}) {
    EXPECT_NE(openError(folder.write("cut.gz", packed.substr(0, size))).find("truncated"), std::string::npos)
        << size;
  }
  std::string broken = packed;
  broken[broken.size() / 2] = static_cast<char>(broken[broken.size() / 2] ^ 0x55);
  EXPECT_NE(openError(folder.write("bad.gz", broken)).find("corrupt"), std::string::npos);
  std::string checksum = packed;
  checksum[checksum.size() - 6] = static_cast<char>(checksum[checksum.size() - 6] ^ 1);
  EXPECT_NE(openError(folder.write("sum.gz", checksum)).find("corrupt"), std::string::npos);
  EXPECT_NE(openError(folder.write("more.gz", packed + "junk")).find("the file goes on"), std::string::npos);
  EXPECT_NE(
      openError(folder.write("bomb.gz", gzipped(std::string(1 << 22, 'a'))), 1 << 20).find("1048576 bytes"),
      std::string::npos);
}

TEST(FileBytes, ReadsADescriptorToItsEnd) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string packed = gzipped(std::string(3000000, 'x'));
  std::thread writer([&] {
    std::size_t done = 0;
    while (done < packed.size()) {
      const ssize_t n =
          ::write(ends[1], packed.data() + done, std::min<std::size_t>(packed.size() - done, 1000));
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    ::close(ends[1]);
  });
  const FileBytes bytes = FileBytes::readDescriptor(ends[0], "<pipe>");
  writer.join();
  ::close(ends[0]);
  EXPECT_EQ(bytes.text(), std::string(3000000, 'x'));
}

TEST(FileBytes, ReleasedMemoryLeavesTheRestReadable) {
  const TemporaryFolder folder;
  std::string text(5000000, 'a');
  text += "end";
  for (const auto& file : {folder.write("plain", text), folder.write("packed", gzipped(text))}) {
    const FileBytes bytes = FileBytes::open(file);
    bytes.releaseUpTo(5000000);
    bytes.releaseUpTo(1);
    EXPECT_EQ(bytes.text().substr(5000000), "end");
  }
}

TEST(WriteFileAtomically, ReplacesTheFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const auto file = folder.write("image.exr", "old");
  writeFileAtomically(file, [&](const std::filesystem::path& temporary) {
    EXPECT_EQ(temporary.extension(), ".exr");
    EXPECT_EQ(temporary.parent_path(), folder.path());
    EXPECT_EQ(contents(file), "old");
    std::ofstream(temporary) << "new";
  });
  EXPECT_EQ(contents(file), "new");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(WriteFileAtomically, KeepsTheOldFileWhenWritingFails) {
  const TemporaryFolder folder;
  const auto file = folder.write("a", "old");
  EXPECT_THROW(writeFileAtomically(file,
                                   [](const std::filesystem::path& temporary) {
                                     std::ofstream(temporary) << "half";
                                     throw std::logic_error("stop");
                                   }),
               std::logic_error);
  EXPECT_EQ(contents(file), "old");
  EXPECT_EQ(entries(folder.path()), 1u);
  try {
    writeFileAtomically(file, [](const std::filesystem::path&) {});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(std::string(e.what()), "cannot write \"" + file.string() + "\": No such file or directory");
  }
}

TEST(WriteFileAtomically, NamesAMissingFolder) {
  const TemporaryFolder folder;
  try {
    writeFileAtomically(folder.path() / "no" / "x", [](const std::filesystem::path&) { FAIL(); });
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("there is no folder " + (folder.path() / "no").string()),
              std::string::npos);
  }
}

TEST(WriteFileAtomically, RemovesWhatKilledProcessesLeft) {
  const TemporaryFolder folder;
  const pid_t killed = ::fork();
  if (killed == 0) {
    writeFileAtomically(folder.path() / "a.out", [](const std::filesystem::path& temporary) {
      std::ofstream(temporary) << "half";
      ::kill(::getpid(), SIGKILL);
    });
  }
  ::waitpid(killed, nullptr, 0);
  ASSERT_EQ(folder.fileCount(), 1u);
  const std::string left = std::filesystem::directory_iterator(folder.path())->path().filename().string();
  // Of one that is still at work, of another file, of another kind, of none of ours.
  const std::string alive = ".a.part" + std::to_string(::getpid()) + "-0.out",
                    dead = ".a.part" + std::to_string(killed);
  for (const std::string& stays :
       {alive, ".b" + left.substr(2), dead + "-0.png", dead + ".out", dead, std::string(".a.part-1.out"),
        std::string(".a.partner-0.out"), std::string("a.out")})
    folder.write(stays, "");
  // What asks whether a file can be written may be killed too.
  const std::string probe = ".a.out.part" + std::to_string(killed) + "-0000",
                    aliveProbe = ".a.out.part" + std::to_string(::getpid()) + "-0000";
  folder.write(probe, "");
  folder.write(aliveProbe, "");
  removeLeftParts(folder.path() / "a.out");
  EXPECT_FALSE(folder.has(probe));
  EXPECT_TRUE(folder.has(aliveProbe));
  EXPECT_FALSE(folder.has(left)) << left;
  EXPECT_EQ(folder.fileCount(), 9u);
  removeLeftParts(folder.path() / "no" / "folder" / "a.out");
}

TEST(WriteFileAtomically, FollowsASymbolicLinkAndWritesDevicesInPlace) {
  const TemporaryFolder folder;
  const auto file = folder.write("real", "old");
  std::filesystem::create_symlink(file, folder.path() / "link");
  writeFileAtomically(folder.path() / "link",
                      [](const auto& temporary) { std::ofstream(temporary) << "new"; });
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(contents(file), "new");
  writeFileAtomically("/dev/null",
                      [](const std::filesystem::path& target) { EXPECT_EQ(target, "/dev/null"); });
}

}  // namespace
}  // namespace pbrtmedia
