// Replays every file of the corpus: inputs written to be ugly, and what fuzzing has found.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "places.h"
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

const std::string kSmall[] = {"WorldBegin Color 1 0.5 0.25 Sphere 1 -1 1 360 Translate 1 2 3 WorldEnd\n",
                              "Declare \"a\" \"uniform color\" WorldBegin PointsPolygons [3 3] [0 1 2 2 1 3] \"P\" [0 "
                              "0 0 1 0 0 0 1 0 1 1 0] \"a\" [1 0 0 0 1 0] WorldEnd\n",
                              "MotionBegin [0 1] Rotate 0 0 0 1 Rotate 9 0 0 1 MotionEnd WorldBegin Surface \"matte\" "
                              "\"Kd\" [1] Curves \"linear\" [2] \"nonperiodic\" "
                              "\"P\" [0 0 0 1 1 1] \"constantwidth\" [0.1] WorldEnd\n"};

std::string binaryOf(const std::string& text) {
  std::string out;
  Log log(Log::Verbosity::Quiet);
  const auto writer = makeRibWriter({true, false, [&](std::string_view more) { out += more; }});
  EXPECT_TRUE(parseRibText(text, "small.rib", *writer, log));
  return out;
}

/// Expects that every complaint has a place. What the reader makes of the bytes does not matter here.
void expectRead(const std::string& bytes) {
  Log log(Log::Verbosity::Quiet);
  RibSettings settings;
  settings.archivePath.clear();
  settings.onScene = [](Scene&&) {};
  const bool good = readRibText(bytes, "small.rib", settings, log);
  EXPECT_EQ(good, log.worst() != Severity::Error);
  for (const LogEntry& e : log.entries()) EXPECT_TRUE(e.where.file) << e.message;
}

TEST(BinaryRibCorpus, IsReadWithAnyOfItsBytesChangedOrMissing) {
  for (const std::string& text : kSmall) {
    const std::string whole = binaryOf(text);
    ASSERT_GT(whole.size(), 30u);
    for (size_t at = 0; at < whole.size(); ++at) {
      SCOPED_TRACE(at);
      expectRead(whole.substr(0, at));
      for (const int change : {0x01, 0x10, 0x80, 0xff}) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ change);
        expectRead(bytes);
      }
    }
  }
}

}  // namespace
}  // namespace tomales
