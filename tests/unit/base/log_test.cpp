#include "reyes/base/log.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tomales {
namespace {

SourceLoc at(int line) {
  static const auto file = std::make_shared<const std::string>("a.rib");
  return {file, line};
}

TEST(Log, OneSiteIsOneEntryWithACount) {
  Log log(Log::Verbosity::Quiet);
  for (int i = 0; i < 3; ++i) log.report(Severity::Warning, "code", at(7), "text");
  log.report(Severity::Missing, "code", at(8), "text");
  ASSERT_EQ(log.entries().size(), 2u);
  EXPECT_EQ(log.entries()[0].count, 3);
  EXPECT_EQ(log.count("code"), 4);
  EXPECT_EQ(log.worst(), Severity::Missing);
}

TEST(Log, AFloodOfOneCodeIsCutOnTheTerminalButNotInTheEntries) {
  Log log;
  testing::internal::CaptureStderr();
  for (int line = 1; line <= 5000; ++line) log.report(Severity::Warning, "flood", at(line), "text");
  log.report(Severity::Warning, "other", at(1), "text");
  const std::string printed = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), Log::kMostLinesOfCode + 2);
  EXPECT_NE(printed.find("more of [flood] is not printed"), std::string::npos);
  EXPECT_NE(printed.find("[other]"), std::string::npos);
  EXPECT_EQ(log.entries().size(), 5001u);
}

}  // namespace
}  // namespace tomales
