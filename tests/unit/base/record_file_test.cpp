#include "reyes/base/record_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace tomales {
namespace {

namespace fs = std::filesystem;

const RecordFileKind kKind{"TestFILE", 3, 42};

Bytes bytesOf(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

class RecordFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("tomales_records_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    path_ = (folder_ / "file").string();
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::unique_ptr<RecordWriter> writer(Unfinished unfinished = Unfinished::Kept) {
    return RecordWriter::create(path_, kKind, unfinished, error_);
  }
  std::string content() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void replace(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }
  /// Whether the file opens and every record in it reads as it was written.
  bool intact() {
    const auto file = RecordFile::open(path_, kKind, error_);
    if (!file) return false;
    for (const uint32_t i : {0u, 1u, 2u})
      if (file->read({7, i}, error_) != bytesOf(std::string(40, static_cast<char>('a' + i)))) return false;
    return true;
  }
  void writeThree() {
    const auto w = writer();
    ASSERT_TRUE(w) << error_;
    for (const uint32_t i : {2u, 0u, 1u})
      ASSERT_TRUE(w->write({7, i}, bytesOf(std::string(40, static_cast<char>('a' + i)))));
    ASSERT_TRUE(w->finish());
  }

  fs::path folder_;
  std::string path_, error_;
};

TEST_F(RecordFiles, GiveBackWhatWasWrittenAndLeaveNoTemporaryFile) {
  writeThree();
  EXPECT_TRUE(intact()) << error_;
  EXPECT_FALSE(fs::exists(path_ + ".part"));
}

TEST_F(RecordFiles, HaveTheSameBytesInWhateverOrderRecordsWereWritten) {
  writeThree();
  const std::string written = content();
  {
    const auto w = writer(Unfinished::Removed);
    for (const uint32_t i : {0u, 1u, 2u}) w->write({7, i}, bytesOf(std::string(40, static_cast<char>('a' + i))));
    ASSERT_TRUE(w->finish());
  }
  EXPECT_EQ(content(), written);
  fs::remove(path_);
  { writer()->write({7, 1}, bytesOf(std::string(40, 'b'))); }
  {
    const auto resumed = writer(Unfinished::Resumed);
    ASSERT_TRUE(resumed->has({7, 1}));
    for (const uint32_t i : {2u, 0u}) resumed->write({7, i}, bytesOf(std::string(40, static_cast<char>('a' + i))));
    ASSERT_TRUE(resumed->finish());
  }
  EXPECT_EQ(content(), written);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(RecordFiles, NoticeEveryFlippedByte) {
  writeThree();
  const std::string good = content();
  for (size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    replace(bad);
    error_.clear();
    EXPECT_FALSE(intact()) << "byte " << i;
    EXPECT_FALSE(error_.empty()) << "byte " << i;
  }
}

TEST_F(RecordFiles, NoticeEveryTruncation) {
  writeThree();
  const std::string good = content();
  for (size_t size = 0; size < good.size(); ++size) {
    replace(good.substr(0, size));
    EXPECT_FALSE(RecordFile::open(path_, kKind, error_)) << size;
  }
}

TEST_F(RecordFiles, NameTheVersionThatTheyCannotRead) {
  writeThree();
  EXPECT_FALSE(RecordFile::open(path_, {"TestFILE", 4, 42}, error_));
  EXPECT_NE(error_.find("version 3"), std::string::npos) << error_;
  EXPECT_FALSE(RecordFile::open(path_, {"TestFILE", 3, 43}, error_));
  EXPECT_FALSE(RecordFile::open(path_, {"OtherONE", 3, 42}, error_));
}

TEST_F(RecordFiles, ResumeWithTheWholeChunksOfAKilledRun) {
  {
    const auto w = writer();
    w->write({7, 0}, bytesOf(std::string(40, 'a')));
    w->write({7, 1}, bytesOf(std::string(40, 'b')));
  }
  const std::string part = path_ + ".part";
  fs::resize_file(part, fs::file_size(part) - 1);  // killed in the middle of the second record
  const auto w = writer(Unfinished::Resumed);
  ASSERT_TRUE(w);
  EXPECT_TRUE(w->has({7, 0}));
  EXPECT_FALSE(w->has({7, 1}));
  EXPECT_EQ(w->read({7, 0}), bytesOf(std::string(40, 'a')));
  w->write({7, 1}, bytesOf(std::string(40, 'b')));
  w->write({7, 2}, bytesOf(std::string(40, 'c')));
  EXPECT_TRUE(w->finish());
  EXPECT_TRUE(intact()) << error_;
}

TEST_F(RecordFiles, StartAnewWithoutResume) {
  writer()->write({7, 0}, bytesOf("old"));
  EXPECT_FALSE(writer()->has({7, 0}));
}

TEST_F(RecordFiles, AreNotWrittenByTwoAtOnce) {
  const auto first = writer();
  EXPECT_FALSE(writer());
  EXPECT_NE(error_.find("another program"), std::string::npos);
}

}  // namespace
}  // namespace tomales
