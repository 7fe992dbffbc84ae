#include "reyes/base/apart.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "reyes/base/child_process.h"

namespace tomales {
namespace {

constexpr char kWhole = '\n';  ///< Ends the text. A process that crashes does not write it.

void writeAll(int file, const std::string& text) {
  for (size_t at = 0; at < text.size();) {
    const ssize_t count = write(file, text.data() + at, text.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) _exit(1);
    at += static_cast<size_t>(count);
  }
}

/// Runs in the child and ends it, so that nothing of the parent's code that follows is run there.
[[noreturn]] void makeAndExit(const std::function<std::string()>& make, int result) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setpgid(0, 0);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
  if (const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC); nothing >= 0) dup2(nothing, STDOUT_FILENO);
  writeAll(result, make() + kWhole);
  _exit(0);
}

/// Reads until the other side is closed. Returns false if it was still open after `mostSeconds`.
bool readAll(int file, int mostSeconds, std::string& out) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(mostSeconds);
  char buffer[4096];
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd wait{file, POLLIN, 0};
    const int ready = left > 0 ? poll(&wait, 1, static_cast<int>(left)) : 0;
    if (ready == 0) return false;
    if (ready < 0) continue;
    const ssize_t count = read(file, buffer, sizeof buffer);
    if (count == 0) return true;
    if (count > 0) out.append(buffer, static_cast<size_t>(count));
  }
}

}  // namespace

std::optional<std::string> runInFork(const std::function<std::string()>& make, int mostSeconds, std::string& fate) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    fate = std::strerror(errno);
    return std::nullopt;
  }
  const pid_t child = fork();
  if (child == 0) makeAndExit(make, ends[1]);
  close(ends[1]);
  std::string out;
  bool ended = true;
  int status = 0;
  if (child > 0) {
    const ChildGuard guard(child);
    ended = readAll(ends[0], mostSeconds, out);
    if (!ended) kill(-child, SIGKILL);
  } else {
    fate = std::strerror(errno);
  }
  close(ends[0]);
  if (child < 0) return std::nullopt;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && ended && out.ends_with(kWhole)) {
    out.pop_back();
    return out;
  }
  if (!ended)
    fate = "does not end within " + std::to_string(mostSeconds) + " s";
  else if (WIFSIGNALED(status))
    fate = std::string("crashes (") + strsignal(WTERMSIG(status)) + ")";
  else
    fate = "ends the program";
  return std::nullopt;
}

}  // namespace tomales
