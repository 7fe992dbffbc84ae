#include "reyes/base/unfinished_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

class UnfinishedFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "unfinished_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::unique_ptr<UnfinishedFile> create(const char* name, UnfinishedKind kind = UnfinishedKind::Scratch) {
    return UnfinishedFile::create(path(name), kind, error_);
  }
  void write(const char* name, const std::string& text) const { std::ofstream(path(name)) << text; }
  std::string read(const char* name) const {
    std::ifstream file(path(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void put(UnfinishedFile& file, const std::string& text) { std::fputs(text.c_str(), file.stream()); }
  int count() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  /// The exit code of another process that does this and then ends without destructors.
  static int inAnotherProcess(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
      work();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path folder_;
  std::string error_;
};

TEST_F(UnfinishedFiles, GetTheirNameWhenTheyAreFinishedWithTheUsualPermissions) {
  const mode_t before = ::umask(027);
  const auto file = create("a");
  ::umask(before);
  ASSERT_TRUE(file) << error_;
  put(*file, "new");
  EXPECT_FALSE(fs::exists(path("a")));
  ASSERT_TRUE(file->finish(error_)) << error_;
  EXPECT_EQ(read("a"), "new");
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
  EXPECT_EQ(count(), 1);
}

TEST_F(UnfinishedFiles, LeaveTheOldFileAndNothingElseIfTheyAreNotFinished) {
  write("a", "old");
  create("a").reset();
  EXPECT_EQ(read("a"), "old");
  EXPECT_EQ(count(), 1);
}

TEST_F(UnfinishedFiles, OfOneTargetDoNotMixAndTheLastToFinishWins) {
  const auto first = create("a"), second = create("a");
  ASSERT_TRUE(first && second);
  put(*first, "first");
  put(*second, "2nd");
  EXPECT_TRUE(second->finish(error_)) << error_;
  EXPECT_TRUE(first->finish(error_)) << error_;
  EXPECT_EQ(read("a"), "first");
  EXPECT_EQ(count(), 1);
}

TEST_F(UnfinishedFiles, ReplaceWhatALinkLeadsTo) {
  fs::create_directory(folder_ / "elsewhere");
  write("elsewhere/a", "old");
  fs::create_symlink("elsewhere/a", path("link"));
  fs::create_symlink("elsewhere/b", path("dangling"));
  for (const char* name : {"link", "dangling"}) ASSERT_TRUE(writeFile(path(name), "new", error_)) << error_;
  EXPECT_TRUE(fs::is_symlink(path("link")) && fs::is_symlink(path("dangling")));
  EXPECT_EQ(read("elsewhere/a") + read("elsewhere/b"), "newnew");
}

TEST_F(UnfinishedFiles, OfLinksInARingAreRefused) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  EXPECT_FALSE(create("a"));
  EXPECT_EQ(error_, "it is a link that leads nowhere");
}

TEST_F(UnfinishedFiles, OfNamesAsLongAsNamesMayBeAreWritten) {
  const std::string name(255, 'n');
  EXPECT_TRUE(writeFile(path(name.c_str()), "new", error_)) << error_;
  EXPECT_EQ(read(name.c_str()), "new");
}

TEST_F(UnfinishedFiles, ArePipesAndDevicesOnlyForStreams) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_FALSE(create("pipe"));
  EXPECT_FALSE(create("pipe", UnfinishedKind::Resumable));
  const int reader = ::open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  EXPECT_TRUE(writeFile(path("pipe"), "through", error_)) << error_;
  char text[8] = {};
  EXPECT_EQ(::read(reader, text, 7), 7);
  ::close(reader);
  EXPECT_STREQ(text, "through");
  write("made", "made");
  EXPECT_FALSE(moveFinished(path("made"), path("pipe"), error_));
  EXPECT_TRUE(writeFile("/dev/null", "nothing", error_)) << error_;
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(UnfinishedFiles, OfKilledProcessesGoWhenTheTargetIsWrittenAgainAndThoseInUseStay) {
  const auto inUse = create("a");
  inAnotherProcess([&] { create("a").release(); });
  inAnotherProcess([&] { create("b").release(); });
  write(".a.something.part", "of the user");
  ASSERT_EQ(count(), 4);
  create("a").reset();
  EXPECT_EQ(count(), 3);
  EXPECT_TRUE(inUse->finish(error_)) << error_;
  EXPECT_TRUE(fs::exists(path(".a.something.part")));
}

TEST_F(UnfinishedFiles, AndFoldersGoAtAnAbruptEnd) {
  const int code = inAnotherProcess([&] {
    const auto file = create("a");
    const TemporaryFolder folder(folder_);
    std::ofstream(folder.path() / "in it") << "text";
    endAbruptly(7);
  });
  EXPECT_EQ(code, 7);
  EXPECT_EQ(count(), 0);
}

TEST_F(UnfinishedFiles, TemporaryFoldersOfKilledProcessesGoWithTheNext) {
  inAnotherProcess([&] {
    const auto* folder = new TemporaryFolder(folder_);
    std::ofstream(folder->path() / "in it") << "text";
  });
  ASSERT_EQ(count(), 1);
  { const TemporaryFolder next(folder_); }
  EXPECT_EQ(count(), 0);
}

TEST_F(UnfinishedFiles, ThatAreResumableStayAndAreWrittenByOneProcessAtATime) {
  const auto first = create("a", UnfinishedKind::Resumable);
  put(*first, "half");
  std::fflush(first->stream());
  EXPECT_FALSE(create("a", UnfinishedKind::Resumable));
  EXPECT_EQ(error_, "another program is writing \"" + path("a.part") + "\"");
  ASSERT_TRUE(first->finish(error_));
  const auto second = create("a", UnfinishedKind::Resumable);  // while the first still has its file open
  ASSERT_TRUE(second) << error_;
  put(*second, "other");
  std::fflush(second->stream());
  EXPECT_EQ(read("a") + read("a.part"), "halfother");
}

TEST_F(UnfinishedFiles, ThatAreResumableDoNotFollowALink) {
  write("precious", "precious");
  fs::create_symlink("precious", path("a.part"));
  EXPECT_FALSE(create("a", UnfinishedKind::Resumable));
  EXPECT_EQ(read("precious"), "precious");
}

TEST_F(UnfinishedFiles, CanLoseTheirNameAndStillBeWrittenAndRead) {
  const auto file = create("a");
  file->discard();
  EXPECT_EQ(count(), 0);
  EXPECT_EQ(::pwrite(file->descriptor(), "x", 1, 0), 1);
}

}  // namespace
}  // namespace tomales
