// SPDX-License-Identifier: BSD-2-Clause
#include "fields/nano_vdb_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "fields/nano_vdb_field.h"
#include "fields/nano_vdb_samples.h"
#include "support/gzip.h"
#include "support/temporary_folder.h"

// What a file that is not as it should be leads to: always a SceneError that names the file.
namespace pbrtmedia {
namespace {

using test::Ijk;
using test::NanoVdbCodec;
using test::NanoVdbSample;
using test::NanoVdbStorage;
using test::NanoVdbSums;

/// In one octant, so that the file is small.
const NanoVdbSample kBall{.min = {1, 1, 1}, .max = {19, 19, 19}, .valueAt = [](Ijk at) {
                            int r2 = 0;
                            for (const int x : at) r2 += (x - 10) * (x - 10);
                            return r2 > 70 ? 0.0 : 1.0 - r2 / 100.0;
                          }};

class NanoVdbFileTest : public testing::Test {
 protected:
  std::string bytesOf(const NanoVdbSample& sample, NanoVdbCodec codec = NanoVdbCodec::None) {
    test::writeNanoVdb(folder_.path() / "made.nvdb", {sample}, codec);
    return folder_.read("made.nvdb");
  }
  /// What loading the bytes says: "" when it works.
  std::string complaint(const std::string& bytes, const std::string& grid = "") {
    const auto file = folder_.write("t.nvdb", bytes);
    try {
      const NanoVdbField field({file, grid, {}}, Transform());
      // Whatever was accepted must answer.
      static_cast<void>(field.superVoxels());
      static_cast<void>(field.density(field.localBox().centre()));
    } catch (const SceneError& e) {
      if (e.location().file != nullptr) {
        EXPECT_NE(e.location().file->find("t.nvdb"), std::string::npos);
      }
      return e.what();
    }
    return "";
  }
  void expectComplaint(const std::string& bytes, const std::string& part) {
    const std::string said = complaint(bytes);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }

  TemporaryFolder folder_;
};

TEST_F(NanoVdbFileTest, ListsGridsWithAllThatTheDirectoryTells) {
  test::writeNanoVdbWithVectors(folder_.path() / "v.nvdb");
  const NanoVdbFile file(folder_.path() / "v.nvdb");
  ASSERT_EQ(file.grids().size(), 2u);
  EXPECT_EQ(file.grids()[0].name, "velocity");
  EXPECT_EQ(file.grids()[0].type, "Vec3f");
  EXPECT_FALSE(file.grids()[0].isDensity);
  EXPECT_EQ(file.grids()[0].indexMin, (Vec3<std::int32_t>(1, 2, 3)));
  EXPECT_EQ(file.grids()[1].gridClass, "fog volume");
  EXPECT_EQ(file.grids()[1].activeVoxels, 1u);
  EXPECT_EQ(file.grids()[1].codec, "none");
  const std::string miss = complaint(folder_.read("v.nvdb"), "smoke");
  EXPECT_NE(miss.find("0: \"velocity\" (Vec3f, "), std::string::npos) << miss;
  EXPECT_NE(complaint(folder_.read("v.nvdb"), "velocity").find("holds values of type Vec3f"),
            std::string::npos);
  EXPECT_EQ(complaint(folder_.read("v.nvdb")), "") << "the only density needs no name";
}

TEST_F(NanoVdbFileTest, ReadsSegmentsOneAfterTheOtherAndGzippedFiles) {
  const std::string once = bytesOf(kBall);
  NanoVdbSample second = kBall;
  second.name = "second";
  const std::string twice = once + bytesOf(second, NanoVdbCodec::Zip);
  EXPECT_EQ(complaint(twice, "second"), "");
  EXPECT_EQ(complaint(gzipped(once)), "");
}

TEST_F(NanoVdbFileTest, ReadsNamesOfAnyKind) {
  for (const std::string name : {"", "with \"quotes\" and\nlines", "\xc3\xa4", "3"}) {
    NanoVdbSample sample = kBall;
    sample.name = name;
    EXPECT_EQ(complaint(bytesOf(sample), name), "") << name;
  }
}

TEST_F(NanoVdbFileTest, NamesWhatTheFileIsInstead) {
  expectComplaint("", "the file is empty");
  expectComplaint("WorldBegin WorldEnd", "this is not a NanoVDB file");
  expectComplaint(std::string(" BDV\0\0\0\0\xe0\0\0\0", 12),
                  "this is an OpenVDB file; convert it with: vdb2pbrt");
  expectComplaint("0BDVonaN________", "other byte order");
  std::string newer = bytesOf(kBall);
  const std::uint32_t version = 33u << 21 | 1u << 10;
  std::memcpy(newer.data() + 8, &version, 4);
  expectComplaint(newer, "the file has NanoVDB version 33.1.0, this program reads 32.x");
  std::string codec = bytesOf(kBall);
  codec[14] = 9;
  expectComplaint(codec, "unknown codec number 9");
}

TEST_F(NanoVdbFileTest, RefusesEveryTruncation) {
  for (const NanoVdbCodec codec : {NanoVdbCodec::None, NanoVdbCodec::Zip}) {
    const std::string whole = bytesOf(kBall, codec);
    for (std::size_t size = 1; size < whole.size(); size += size < 250 ? 1 : 4321) {
      ASSERT_NE(complaint(whole.substr(0, size)), "") << size << " of " << whole.size();
    }
    EXPECT_NE(complaint(whole + "NanoVDB0").find("truncated"), std::string::npos);
    EXPECT_NE(complaint(whole + "more and more").find("no NanoVDB segment begins at byte"),
              std::string::npos);
  }
}

TEST_F(NanoVdbFileTest, ChecksumsFindChangedBytes) {
  NanoVdbSample sample = kBall;
  const std::string whole = bytesOf(sample);
  const std::size_t data = 16 + 176 + sample.name.size() + 1;
  std::string head = whole;
  head[data + 680] = static_cast<char>(head[data + 680] ^ 1);  // a node offset
  EXPECT_NE(complaint(head), "");
  std::string name = whole;
  name[data + 60] = 'x';  // in the name, which nothing else looks at
  expectComplaint(name, "the checksum of its head is wrong");
  std::string leaf = whole;
  leaf[leaf.size() - 2] = static_cast<char>(leaf[leaf.size() - 2] ^ 8);  // a value of the last leaf
  expectComplaint(leaf, "the checksum of its nodes is wrong");
  sample.sums = NanoVdbSums::Partial;
  std::string partial = bytesOf(sample);
  EXPECT_EQ(complaint(partial), "");
  partial[data + 60] = 'x';
  expectComplaint(partial, "the checksum of its head is wrong");
}

TEST_F(NanoVdbFileTest, AcceptsTheChecksumsOfEveryStorage) {
  for (const NanoVdbStorage storage : {NanoVdbStorage::Float, NanoVdbStorage::Double, NanoVdbStorage::Fp4,
                                       NanoVdbStorage::Fp8, NanoVdbStorage::Fp16, NanoVdbStorage::FpN}) {
    for (const NanoVdbSums sums : {NanoVdbSums::None, NanoVdbSums::Partial, NanoVdbSums::Full}) {
      NanoVdbSample sample = kBall;
      sample.storage = storage;
      sample.sums = sums;
      EXPECT_EQ(complaint(bytesOf(sample)), "") << static_cast<int>(storage);
    }
  }
}

TEST_F(NanoVdbFileTest, SurvivesAnyBytes) {
  // Without checksums, so that the structure itself is tried; the head and the tables most of all.
  Rng rng(1);
  int accepted = 0, refused = 0;
  for (const NanoVdbStorage storage : {NanoVdbStorage::Float, NanoVdbStorage::FpN}) {
    NanoVdbSample sample = kBall;
    sample.storage = storage;
    sample.sums = NanoVdbSums::None;
    const std::string whole = bytesOf(sample);
    for (int n = 0; n < 250; ++n) {
      std::string bytes = whole;
      const std::size_t range = n % 2 == 0 ? 1100 : bytes.size();
      for (int flips = 0; flips < 1 + n % 3; ++flips) {
        bytes[rng.uniformInt(static_cast<std::uint32_t>(range))] = static_cast<char>(rng.uniformInt(256));
      }
      (complaint(bytes).empty() ? accepted : refused)++;
    }
  }
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

TEST_F(NanoVdbFileTest, RefusesNodesOutsideTheGridAndMoreThanAnnounced) {
  NanoVdbSample sample = kBall;
  sample.sums = NanoVdbSums::None;
  const std::string whole = bytesOf(sample);
  const std::size_t tree = 16 + 176 + sample.name.size() + 1 + 672;
  const auto with = [&](std::size_t at, auto value) {
    std::string bytes = whole;
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return bytes;
  };
  expectComplaint(with(tree + 24, std::int64_t{-64}), "a root lies outside of it");
  expectComplaint(with(tree + 24, std::int64_t{1} << 60), "a root lies outside of it");
  expectComplaint(with(tree + 64 + 24, std::uint32_t{0xffffffff}), "its root announces 4294967295 tiles");
  expectComplaint(with(tree + 32, std::uint32_t{1}), "it has more nodes of level 0 than it announces");
  expectComplaint(with(tree + 32, std::uint32_t{0x7fffffff}), "more than fit");
  // The root of 64 bytes is followed by its tiles: key, child, …
  expectComplaint(with(tree + 64 + 64 + 8, std::int64_t{1} << 40), "a node lies outside of it");
  expectComplaint(with(tree + 64 + 64 + 8, std::int64_t{-1} << 40), "a node lies outside of it");
  // The size a grid unpacks to.
  std::string zip = bytesOf(sample, NanoVdbCodec::Zip);
  const std::uint64_t huge = std::uint64_t{1} << 50;
  std::memcpy(zip.data() + 16, &huge, sizeof huge);
  expectComplaint(zip, "cannot unpack to");
}

TEST_F(NanoVdbFileTest, TakesMemoryInProportionToTheFile) {
  const std::string plain = bytesOf(kBall);
  const auto claiming = [&](std::uint16_t codec, std::uint64_t unpacked, int bloscFlags) {
    std::string bytes = plain;
    std::memcpy(bytes.data() + 14, &codec, sizeof codec);
    std::memcpy(bytes.data() + 16, &unpacked, sizeof unpacked);
    const std::size_t stored = 16 + 176 + kBall.name.size() + 1;
    const std::uint64_t packed = bytes.size() - stored - 8;
    std::memcpy(bytes.data() + stored, &packed, sizeof packed);
    bytes[stored + 8 + 2] = static_cast<char>(bloscFlags);
    return bytes;
  };
  constexpr std::uint64_t kGigabytes = std::uint64_t{3211264000};
  if (test::hasBlosc()) {
    expectComplaint(claiming(2, kGigabytes, 1 << 5), "bytes cannot unpack to 3211264000");  // LZ4
    expectComplaint(claiming(2, kGigabytes, 4 << 5), "expected at most 21");                // zstd could
    expectComplaint(claiming(2, 20000000, 1 << 5), "its blosc data cannot be unpacked");
  }
  expectComplaint(claiming(1, kGigabytes, 0), "cannot unpack to");
  expectComplaint(claiming(1, 20000000, 0), "zip data cannot be unpacked");
}

}  // namespace
}  // namespace pbrtmedia
