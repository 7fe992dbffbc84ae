#include "reyes/base/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tomales {
namespace {

/// Both ends of a pipe: who has the second one open lives.
struct Pipe {
  Pipe() { EXPECT_EQ(::pipe2(ends, O_CLOEXEC), 0); }
  ~Pipe() { ::close(ends[0]); }
  bool closes() const {
    ::close(ends[1]);
    pollfd wait{ends[0], POLLIN, 0};
    char byte;
    return ::poll(&wait, 1, 20000) == 1 && ::read(ends[0], &byte, 1) == 0;
  }
  int ends[2];
};

pid_t startSleeper(const Pipe& pipe) {
  int problem = 0;
  return startChild({"/bin/sleep", {"sleep", "1000"}, {{pipe.ends[1], STDOUT_FILENO}}}, problem);
}

TEST(ChildProcesses, ThatCannotBeStartedAreToldWithTheReason) {
  int problem = 0;
  EXPECT_EQ(startChild({"/no/such/program", {"program"}, {}}, problem), -1);
  EXPECT_EQ(problem, ENOENT);
}

TEST(ChildProcesses, ReactToSignalsThatThisProcessIgnoresOrBlocks) {
  const auto before = ::signal(SIGPIPE, SIG_IGN);
  sigset_t set, old;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  ::sigprocmask(SIG_BLOCK, &set, &old);
  for (const char* text : {"kill -PIPE $$", "kill -TERM $$"}) {
    int problem = 0, status = 0;
    const pid_t child = startChild({"/bin/sh", {"sh", "-c", text}, {}}, problem);
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status)) << text;
  }
  ::sigprocmask(SIG_SETMASK, &old, nullptr);
  ::signal(SIGPIPE, before);
}

TEST(ChildProcesses, EndWhenThisProcessIsKilled) {
  const Pipe pipe;
  const pid_t parent = ::fork();
  if (parent == 0) {
    startSleeper(pipe);
    ::raise(SIGKILL);
  }
  ::waitpid(parent, nullptr, 0);
  EXPECT_TRUE(pipe.closes());
}

TEST(ChildProcesses, EndWithAllThatTheyHaveStartedAtAnAbruptEnd) {
  const Pipe pipe;
  const pid_t parent = ::fork();
  if (parent == 0) {
    int problem = 0;
    const pid_t shell =
        startChild({"/bin/sh", {"sh", "-c", "sleep 1000 & wait"}, {{pipe.ends[1], STDOUT_FILENO}}}, problem);
    const ChildGuard guard(shell);
    ::usleep(100000);  // the shell starts the other one
    endAbruptly(0);
  }
  ::waitpid(parent, nullptr, 0);
  EXPECT_TRUE(pipe.closes());
}

}  // namespace
}  // namespace tomales
