#include "reyes/base/log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace tomales {
namespace {

SourceLoc at(int line) {
  static const auto file = std::make_shared<const std::string>("a.rib");
  return {file, line};
}

std::string printedBy(const std::function<void(Log&)>& work) {
  testing::internal::CaptureStderr();
  {
    Log log;
    work(log);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Log, OneCauseInManyPlacesIsOneEntryWithACountAndTheFirstPlaces) {
  Log log(Log::Verbosity::Quiet);
  for (int line = 1; line <= 93; ++line)
    log.report(Severity::Missing, "shader-missing", at(line), "\"rock\" is unknown");
  ASSERT_EQ(log.entries().size(), 1u);
  const LogEntry entry = log.entries()[0];
  EXPECT_EQ(entry.count, 93);
  EXPECT_EQ(log.count("shader-missing"), 93);
  EXPECT_EQ(entry.where.line, 1);
  ASSERT_EQ(entry.places.size(), Log::kMostPlaces);
  for (size_t i = 0; i < entry.places.size(); ++i) EXPECT_EQ(entry.places[i].line, static_cast<int>(i) + 1);
}

TEST(Log, NamesOfASceneCannotCommandTheTerminalOrEndAMessage) {
  const std::string name("a\x1B[31m\x7F\xC2\x9B\0b\tu\xC3\x9C", 15);
  const std::string printed = printedBy([&](Log& log) {
    for (int line = 1; line <= 2; ++line) log.report(Severity::Warning, "code", at(line), '"' + name + '"', "name");
  });
  const std::string shown = "\"a\\x1B[31m\\x7F\\x9B\\x00b\tu\xC3\x9C\" [code]";
  EXPECT_EQ(printed, "a.rib:1: warning: " + shown + "\ntomales: 2 times: " + shown + ": a.rib:1, a.rib:2\n");
}

TEST(Log, SevenCausesInOnePlaceAreSevenEntries) {
  Log log(Log::Verbosity::Quiet);
  for (int k = 0; k < 7; ++k)
    log.report(Severity::Missing, "shader-missing", at(1), "\"rock" + std::to_string(k) + "\" is unknown");
  EXPECT_EQ(log.entries().size(), 7u);
}

TEST(Log, ASubjectTellsCausesApartWhereMessagesDiffer) {
  Log log(Log::Verbosity::Quiet);
  for (int k = 0; k < 5; ++k)
    log.report(Severity::Warning, "bound", at(k), "needs " + std::to_string(k), k < 3 ? "ball" : "floor");
  ASSERT_EQ(log.entries().size(), 2u);
  EXPECT_EQ(log.entries()[0].count, 3);
  EXPECT_EQ(log.entries()[0].message, "needs 0");
  EXPECT_EQ(log.entries()[1].count, 2);
}

TEST(Log, TheSameTroubleOfTwoFilesIsTwoEntries) {
  Log log(Log::Verbosity::Quiet);
  for (const char* file : {"a.rib", "b.rib", "a.rib"})
    log.report(Severity::Error, "rib-open", {std::make_shared<const std::string>(file), 0}, "cannot be opened");
  EXPECT_EQ(log.entries().size(), 2u);
}

TEST(Log, TheWorstSeverityIsKnown) {
  Log log(Log::Verbosity::Quiet);
  EXPECT_EQ(log.worst(), Severity::Info);
  log.report(Severity::Missing, "one", at(1), "text");
  log.report(Severity::Warning, "two", at(1), "text");
  EXPECT_EQ(log.worst(), Severity::Missing);
}

TEST(Log, WhatCameFromSeveralPlacesIsCountedOnOneLineAtTheEnd) {
  const std::string printed = printedBy([](Log& log) {
    for (int line = 1; line <= 93; ++line)
      log.report(Severity::Missing, "shader-missing", at(line), "\"rock\" is unknown; a checker is rendered");
    log.report(Severity::Warning, "once", at(5), "text");
    log.report(Severity::Warning, "once", at(5), "text");
  });
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 3) << printed;
  EXPECT_NE(printed.find("93 times: \"rock\" is unknown [shader-missing]: a.rib:1, a.rib:2, a.rib:3, a.rib:4, ..."),
            std::string::npos)
      << printed;
}

TEST(Log, CausesOfManyPlacesAreNotAllListed) {
  const std::string printed = printedBy([](Log& log) {
    for (int k = 0; k < 30; ++k)
      for (int line = 1; line <= 2 + k; ++line) log.report(Severity::Warning, "code", at(line), std::to_string(k));
  });
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 30 + static_cast<int>(Log::kMostRepeated) + 1) << printed;
  EXPECT_NE(printed.find("31 times: 29 [code]"), std::string::npos) << printed;
  EXPECT_EQ(printed.find("2 times: 0 [code]"), std::string::npos) << printed;
}

TEST(Log, AFloodOfOneCodeIsCutOnTheTerminalButNotInTheEntries) {
  const std::string printed = printedBy([](Log& log) {
    for (int k = 1; k <= 5000; ++k) log.report(Severity::Warning, "flood", at(1), std::to_string(k));
    log.report(Severity::Warning, "other", at(1), "text");
    EXPECT_EQ(log.entries().size(), 5001u);
  });
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), Log::kMostLinesOfCode + 2);
  EXPECT_NE(printed.find("more of [flood] is not printed"), std::string::npos);
  EXPECT_NE(printed.find("[other]"), std::string::npos);
}

}  // namespace
}  // namespace tomales
