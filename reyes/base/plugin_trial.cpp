#include "reyes/base/plugin_trial.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <cstring>

#include "reyes/base/plugin_trial_socket.h"
#include "reyes/base/process.h"

namespace tomales {
namespace {

using trial::arrives;

constexpr int kMostSeconds = 10;

enum class Heard { Word, End, Nothing };

Heard hear(int socket) {
  if (!arrives(socket, 1000 * kMostSeconds)) return Heard::Nothing;
  char word;
  return recv(socket, &word, 1, 0) == 1 ? Heard::Word : Heard::End;
}

}  // namespace

// The child is a program of its own and not a fork, because other threads may hold locks that a fork would wait for.
void PluginTrial::start() {
  end();
  const auto programs = besideProgram("tomales_plugin_trial");
  int ends[2];
  if (programs.empty() || socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return;
  const std::string program = programs.front();
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  const std::pair<int, int> silent[] = {
      {nothing, STDIN_FILENO}, {nothing, STDOUT_FILENO}, {nothing, STDERR_FILENO}};  // its output is dropped
  int problem = 0;
  child_ = startChild({program, {program}, {silent[0], silent[1], silent[2], {ends[1], trial::kSocket}}}, problem);
  if (child_ > 0) guard_.emplace(child_);
  close(nothing);
  close(ends[1]);
  if (child_ < 0) close(ends[0]);
  socket_ = child_ > 0 ? ends[0] : -1;
}

/// Returns the status of the child, which ends as soon as its socket is closed.
int PluginTrial::end() {
  if (child_ < 0) return 0;
  close(socket_);
  guard_.reset();
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  socket_ = -1;
  return status;
}

/// Returns false if there is no child, or if an idle one has ended.
bool PluginTrial::begin(const std::string& path) {
  return child_ > 0 && send(socket_, path.c_str(), path.size(), MSG_NOSIGNAL) > 0 && hear(socket_) == Heard::Word;
}

std::string PluginTrial::fateOf(const std::string& path) {
  works_ = begin(path);
  if (!works_) {
    start();
    works_ = begin(path);
  }
  if (!works_) return {};
  const Heard heard = hear(socket_);
  if (heard == Heard::Word) return {};
  if (heard == Heard::Nothing) kill(child_, SIGKILL);
  const int status = end();
  if (heard == Heard::Nothing) return fmt::format("does not end loading within {} s", kMostSeconds);
  if (WIFSIGNALED(status)) return fmt::format("crashes while it is loaded ({})", strsignal(WTERMSIG(status)));
  return "ends the program while it is loaded";
}

}  // namespace tomales
