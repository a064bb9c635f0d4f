// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/journal.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>

#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

const std::string kIdentity = "medialab estimate --trials 7, program 1";

std::string textOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Every member another number, none of which decimals could hold.
TrialStats someStats() {
  TrialStats s;
  for (int i = 1; i < 9; ++i) s.value.add(std::sqrt(i));
  s.nonFinite = 2;
  s.lookups = 0xffff'ffff'ffff'fffeull;
  s.estimates = 4;
  s.violations = 5;
  s.capped = 6;
  s.mostLookups = 7;
  s.least = -1.0 / 3;
  s.most = 0x1p-1074;
  s.largestDeviation = 2.0 / 3;
  s.seconds = 1e-7;
  return s;
}

void expectSame(const TrialStats& a, const TrialStats& b) {
  const Moments::State x = a.value.state(), y = b.value.state();
  EXPECT_EQ(x.count, y.count);
  EXPECT_EQ(x.mean, y.mean);
  EXPECT_EQ(x.m2, y.m2);
  EXPECT_EQ(x.m3, y.m3);
  EXPECT_EQ(x.m4, y.m4);
  EXPECT_EQ(a.nonFinite, b.nonFinite);
  EXPECT_EQ(a.lookups, b.lookups);
  EXPECT_EQ(a.estimates, b.estimates);
  EXPECT_EQ(a.violations, b.violations);
  EXPECT_EQ(a.capped, b.capped);
  EXPECT_EQ(a.mostLookups, b.mostLookups);
  EXPECT_EQ(a.least, b.least);
  EXPECT_EQ(a.most, b.most);
  EXPECT_EQ(a.largestDeviation, b.largestDeviation);
  EXPECT_EQ(a.seconds, b.seconds);
}

class Journal : public testing::Test {
 protected:
  /// What opening the file says is wrong with it.
  std::string complaint(const std::string& identity) const {
    try {
      const TrialJournal journal(file_, identity);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  const std::string file_ = (folder_.path() / "journal").string();
};

TEST_F(Journal, KeepsEveryBitOfAMeasurement) {
  TrialStats none;  // least and most are infinite
  {
    TrialJournal journal(file_, kIdentity);
    journal.add(~0ull, someStats());
    journal.add(0, none);
  }
  const TrialJournal journal(file_, kIdentity);
  ASSERT_TRUE(journal.find(~0ull));
  expectSame(*journal.find(~0ull), someStats());
  ASSERT_TRUE(journal.find(0));
  expectSame(*journal.find(0), none);
  EXPECT_FALSE(journal.find(1));
}

TEST_F(Journal, MeasuresWhatIsMissingAndNothingTwice) {
  std::atomic<bool> stop = false;
  int measured = 0;
  const auto measure = [&] { return ++measured, someStats(); };
  {
    TrialJournal journal(file_, kIdentity);
    journal.recall(1, stop, measure);
    stop = true;
    journal.recall(2, stop, measure);  // cut short: not kept
    stop = false;
    EXPECT_EQ(measured, 2);
  }
  TrialJournal journal(file_, kIdentity);
  journal.recall(1, stop, measure);
  EXPECT_EQ(measured, 2);
  journal.recall(2, stop, measure);
  EXPECT_EQ(measured, 3);
}

TEST_F(Journal, KeepsNothingWithoutAName) {
  std::atomic<bool> stop = false;
  int measured = 0;
  TrialJournal journal("", kIdentity);
  for (int i = 0; i < 2; ++i) journal.recall(1, stop, [&] { return ++measured, someStats(); });
  EXPECT_EQ(measured, 2);
}

/// Wherever a program is killed, the file has whole lines and the beginning of one.
TEST_F(Journal, GoesOnFromEveryCutOffEnd) {
  {
    TrialJournal journal(file_, kIdentity);
    journal.add(1, someStats());
    journal.add(2, someStats());
  }
  const std::string whole = textOf(file_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write(file_, whole.substr(0, size));
    {
      TrialJournal journal(file_, kIdentity);
      for (const std::uint64_t seed : {1, 2}) {
        if (!journal.find(seed)) journal.add(seed, someStats());
      }
    }
    ASSERT_EQ(textOf(file_), whole) << size;
  }
}

TEST_F(Journal, RefusesWhatIsNotItsOwnAndLeavesItAlone) {
  { TrialJournal(file_, kIdentity).add(1, someStats()); }
  const std::string whole = textOf(file_);
  const std::string other = complaint("medialab estimate --trials 8, program 1");
  EXPECT_NE(other.find("belongs to other measurements"), std::string::npos) << other;
  EXPECT_NE(other.find(kIdentity), std::string::npos) << other;
  EXPECT_EQ(textOf(file_), whole);
  for (const std::string text : {"estimator,depth\nratio,1\n", "precious", "\n"}) {
    write(file_, text);
    EXPECT_NE(complaint(kIdentity).find("no journal of medialab"), std::string::npos) << text;
    EXPECT_EQ(textOf(file_), text);
  }
  for (const char* line : {"1 2 3\n", "x\n", "\n", "1,2\n"}) {
    write(file_, whole + line);
    EXPECT_NE(complaint(kIdentity).find("damaged"), std::string::npos) << line;
    EXPECT_EQ(textOf(file_), whole + line);
  }
}

}  // namespace
}  // namespace pbrtmedia
