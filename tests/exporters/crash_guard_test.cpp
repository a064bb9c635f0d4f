// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/crash_guard.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace pbrtmedia {
namespace {

std::string messageOf(const std::function<int()>& run) {
  try {
    return "status " + std::to_string(runGuarded("smoke.vdb", run));
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

TEST(CrashGuard, AnswersTheStatusOfWhatItRuns) {
  EXPECT_EQ(messageOf([] { return 0; }), "status 0");
  EXPECT_EQ(messageOf([] { return 1; }), "status 1");
}

TEST(CrashGuard, MakesAMessageOfACrash) {
  for (const int number : {SIGSEGV, SIGABRT, SIGFPE}) {
    const std::string message = messageOf([=] {
      std::signal(number, SIG_DFL);
      return std::raise(number);
    });
    EXPECT_NE(message.find("smoke.vdb: OpenVDB crashed ("), std::string::npos) << message;
    EXPECT_NE(message.find("the file is damaged; nothing was written"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace pbrtmedia
