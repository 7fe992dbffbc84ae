// Replays every shader of the corpus: texts written to be ugly, and what fuzzing has found.
#include <gtest/gtest.h>

#include <filesystem>

#include "places.h"
#include "reyes/rsl/parse.h"

namespace tomales::compiler {
namespace {

TEST(RslCorpus, IsReadWithoutCrashAndEveryComplaintIsLocated) {
  const std::string folder = TOMALES_SOURCE_DIR "/tests/corpus/rsl";
  int files = 0, wrong = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    SCOPED_TRACE(entry.path().filename().string());
    PreprocessOptions options;
    options.includeFolders = {folder + "/include"};
    Sources sources;
    Messages messages;
    const auto tokens = preprocess(entry.path().string(), options, sources, messages);
    const File file = parse(tokens, messages);
    for (const Message& m : messages.all()) {
      EXPECT_GE(m.place.line, 1) << m.text;
      EXPECT_GE(m.place.column, 1) << m.text;
      EXPECT_GE(m.place.file, 0) << m.text;
    }
    EXPECT_EQ(messages.rendered(sources).empty(), messages.all().empty());
    if (!messages.hasErrors()) {
      EXPECT_FALSE(dump(file).empty());
    }
    ++files;
    wrong += messages.hasErrors() ? 1 : 0;
  }
  EXPECT_GE(files, 6);
  EXPECT_EQ(files - wrong, 2) << "all.sl and lights.sl are right";
}

}  // namespace
}  // namespace tomales::compiler
