#include "reyes/base/nursery.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

int tell(const std::vector<std::string>& arguments) {
  for (const std::string& a : arguments) std::printf("%s|", a.c_str());
  std::printf("%s\n", fs::current_path().filename().c_str());
  std::fflush(stdout);
  if (arguments.back() == "wait") ::pause();
  return static_cast<int>(arguments.size());
}

std::string writtenTo(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

int statusOf(pid_t child) {
  int status = -1;
  return ::waitpid(child, &status, 0) == child ? status : -1;
}

TEST(Nursery, RunsAFunctionInChildrenOfThisProcess) {
  const TemporaryFolder folder(fs::temp_directory_path());
  const std::string log = folder.path() / "log", here = folder.path().filename();
  EXPECT_EQ(startInNursery(folder.path(), log, {"x"}), -1) << "there is none yet";
  openNursery(tell);
  const pid_t first = startInNursery(folder.path(), log, {"a", "", "with blanks"});
  ASSERT_GT(first, 0);
  const int status = statusOf(first);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_EQ(writtenTo(log), "a||with blanks|" + here + "\n");

  const std::string large(1 << 20, 'x');
  EXPECT_EQ(WEXITSTATUS(statusOf(startInNursery(folder.path(), log, {large}))), 1);
  EXPECT_EQ(writtenTo(log), "a||with blanks|" + here + "\n" + large + "|" + here + "\n") << "the log goes on";

  const pid_t waiting = startInNursery(folder.path(), folder.path() / "other", {"wait"});
  ASSERT_GT(waiting, 0);
  for (int i = 0; i < 10000 && writtenTo(folder.path() / "other").empty(); ++i) ::usleep(1000);
  EXPECT_EQ(::getpgid(waiting), waiting);
  EXPECT_EQ(::kill(-waiting, SIGKILL), 0);
  EXPECT_TRUE(WIFSIGNALED(statusOf(waiting)));
  EXPECT_EQ(WEXITSTATUS(statusOf(startInNursery(folder.path() / "nowhere", log, {"a"}))), 127);
}

}  // namespace
}  // namespace tomales
