#include "reyes/base/chunk_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "reyes/base/pack.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

struct ChunkFile : ::testing::Test {
  const fs::path folder = fs::temp_directory_path() / "tomales_chunks";
  const std::string path = (folder / "a.chunks").string();
  ChunkFile() { fs::create_directories(folder); }
  ~ChunkFile() override { fs::remove_all(folder); }

  static Bytes bytesOf(const std::string& text) { return pack(text); }
  static std::string textOf(const Bytes& bytes) { return Unpacker{bytes}.get<std::string>(); }

  void write() const {
    ChunkWriter w(path, "TESTFILE", 3);
    EXPECT_EQ(w.add(bytesOf("first")), 0u);
    EXPECT_EQ(w.add(bytesOf(std::string(5000, 'x'))), 1u);
    EXPECT_EQ(w.add({}), 2u);
    w.finish(bytesOf("the header"));
  }
};

TEST_F(ChunkFile, ChunksComeBackInAnyOrder) {
  write();
  ChunkReader r(path, "TESTFILE", 3);
  ASSERT_EQ(r.count(), 3u);
  EXPECT_EQ(textOf(r.takeHeader()), "the header");
  EXPECT_EQ(r.read(2).size(), 0u);
  EXPECT_EQ(textOf(r.read(1)), std::string(5000, 'x'));
  EXPECT_EQ(textOf(r.read(0)), "first");
  EXPECT_THROW(r.read(3), FileError);
}

TEST_F(ChunkFile, NothingLiesUnderTheFinalNameBeforeTheEnd) {
  {
    ChunkWriter w(path, "TESTFILE", 3);
    w.add(bytesOf("first"));
    EXPECT_FALSE(fs::exists(path));
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(ChunkFile, OtherKindsAndVersionsAreRefused) {
  write();
  EXPECT_THROW(ChunkReader(path, "OTHERONE", 3), FileError);
  EXPECT_THROW(ChunkReader(path, "TESTFILE", 4), FileError);
  EXPECT_THROW(ChunkReader(path + "x", "TESTFILE", 3), FileError);
  EXPECT_THROW(ChunkReader(folder.string(), "TESTFILE", 3), FileError);
}

/// All that is in the file; nothing if reading it is an error.
std::vector<Bytes> contents(const std::string& path) {
  try {
    ChunkReader r(path, "TESTFILE", 3);
    std::vector<Bytes> all{r.takeHeader()};
    for (uint32_t i = 0; i < r.count(); ++i) all.push_back(r.read(i));
    return all;
  } catch (const FileError&) {
    return {};
  }
}

TEST_F(ChunkFile, NoFlippedBitAndNoTruncationGivesOtherContents) {
  write();
  const std::vector<Bytes> expected = contents(path);
  std::ifstream in(path, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  const auto readBack = [&](const std::string& file) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << file;
    return contents(path);
  };
  size_t found = 0;
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    const std::vector<Bytes> got = readBack(flipped);
    EXPECT_TRUE(got.empty() || got == expected) << "byte " << i;
    found += got.empty();
    EXPECT_TRUE(readBack(whole.substr(0, i)).empty()) << "cut at " << i;
  }
  EXPECT_GT(found, whole.size() * 9 / 10);  // zstd's frames have a few bits that mean nothing
}

TEST_F(ChunkFile, WhatIsDamagedWheneverItIsMadeIsMadeTwiceAndNoMore) {
  Log log(Log::Verbosity::Quiet);
  int made = 0;
  const auto make = [&] {
    write();
    ++made;
    throw DamageError(path, "it was made so");
  };
  EXPECT_THROW(makeAnewWhatIsDamaged(make, log), DamageError);
  EXPECT_EQ(made, 2);
}

TEST_F(ChunkFile, AFolderThatIsMissingIsAnError) {
  EXPECT_THROW(ChunkWriter((folder / "missing" / "a").string(), "TESTFILE", 3), FileError);
}

TEST_F(ChunkFile, OfAnotherVersionIsNotTakenForDamaged) {
  write();
  try {
    const ChunkReader r(path, "TESTFILE", 4);
    FAIL();
  } catch (const DamageError&) {
    FAIL() << "files that are damaged are removed and made anew";
  } catch (const FileError& e) {
    EXPECT_NE(std::string(e.what()).find("version 3"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace tomales
