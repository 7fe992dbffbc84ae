// Replays every file of the corpus: inputs written to be ugly, and what fuzzing has found.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "reyes/rib.h"

namespace tomales {
namespace {

TEST(RibCorpus, IsReadWithoutCrashAndEveryComplaintIsLocated) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TOMALES_SOURCE_DIR "/tests/corpus/rib")) {
    SCOPED_TRACE(entry.path().filename().string());
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    Log log(Log::Verbosity::Quiet);
    RibSettings settings;
    settings.onScene = [](Scene&& scene) {
      for (const Object& o : scene.objects) {
        EXPECT_FALSE(o.shapes.empty());
        EXPECT_EQ(o.shapes.size(), o.shapeTimes.size());
        EXPECT_GE(o.group, 0);
      }
    };
    const bool good = readRibText(text, entry.path().string(), settings, log);
    EXPECT_EQ(good, log.worst() != Severity::Error);
    EXPECT_FALSE(log.entries().empty()) << "nothing was found wrong";
    for (const LogEntry& e : log.entries()) EXPECT_TRUE(e.where.file) << e.message;
    ++files;
  }
  EXPECT_GE(files, 15);
}

}  // namespace
}  // namespace tomales
