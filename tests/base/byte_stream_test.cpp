// SPDX-License-Identifier: BSD-2-Clause
#include "base/byte_stream.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace pbrtmedia {
namespace {

TEST(ByteStream, WritesTheLowestByteFirst) {
  ByteWriter out;
  out.add(std::uint32_t{0x01020304});
  out.add(1.5f);
  out.add(std::string("ab"));
  EXPECT_EQ(out.text(), std::string("\4\3\2\1\0\0\xc0\x3f\2\0\0\0ab", 14));
}

TEST(ByteStream, ReadsWhatWasWritten) {
  const std::vector<double> doubles = {1, -0.0, 1e308, std::numeric_limits<double>::infinity()};
  ByteWriter out;
  out.add(std::uint8_t{7});
  out.add(~std::uint64_t{0});
  out.add(-2.25);
  out.add(std::string());
  out.addArray(std::span(doubles));
  out.addArray(std::span<const float>());
  ByteReader in(out.text());
  EXPECT_EQ(in.number<std::uint8_t>(), 7);
  EXPECT_EQ(in.number<std::uint64_t>(), ~std::uint64_t{0});
  EXPECT_EQ(in.number<double>(), -2.25);
  EXPECT_EQ(in.text(), "");
  EXPECT_EQ(in.array<double>(), doubles);
  EXPECT_TRUE(in.array<float>().empty());
  EXPECT_EQ(in.left(), 0u);
}

TEST(ByteStream, HandsOnBlocksOfOneSize) {
  std::vector<std::size_t> sizes;
  std::string all;
  ByteWriter out([&](std::string_view bytes) {
    sizes.push_back(bytes.size());
    all += bytes;
  });
  ByteWriter kept;
  const std::vector<double> numbers(300'000, .5);  // 2.4 MB
  for (ByteWriter* writer : {&out, &kept}) {
    writer->add(std::uint32_t{9});
    writer->addArray(std::span(numbers));
    writer->add(std::string(ByteWriter::kBlock, 'x'));
  }
  out.finish();
  ASSERT_EQ(sizes.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(sizes[i], ByteWriter::kBlock);
  EXPECT_EQ(all, kept.text());
}

TEST(ByteStream, TakesNoMemoryForWhatIsNotThere) {
  for (const std::uint64_t claimed : {std::uint64_t{3}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    ByteWriter out;
    out.add(claimed);
    out.add(std::uint64_t{1});
    out.add(std::uint64_t{2});
    EXPECT_THROW((void)ByteReader(out.text()).array<double>(), std::length_error) << claimed;
    EXPECT_THROW((void)ByteReader(out.text()).count(8), std::length_error) << claimed;
  }
  ByteWriter out;
  out.add(std::uint32_t{5});
  out.addPlain("four");
  EXPECT_THROW((void)ByteReader(out.text()).text(), std::length_error);
  EXPECT_THROW((void)ByteReader("1234567").number<std::uint64_t>(), std::length_error);
}

}  // namespace
}  // namespace pbrtmedia
