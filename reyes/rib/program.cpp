#include "reyes/rib/program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "reyes/base/stop.h"

namespace tomales::rib {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPollEvery_s = 0.1;  ///< A request to stop does not wake poll().

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Makes the shell exec the program, so that the signal that kills the child when we are killed (startChild()) ends the
/// program itself. That is not possible if the command is more than a program and its arguments; "exit" is the shell's
/// own.
std::string forShell(const std::string& command) {
  const bool simple = command.find_first_of("|&;()<>`={}!\n") == std::string::npos && !command.starts_with("exit");
  return simple ? "exec " + command : command;
}

}  // namespace

// The program's input is a socket, because writes to a closed socket can be made not to raise SIGPIPE.
Program::Program(const std::string& command) {
  int in[2], out[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in) != 0) {
    startError_ = errno;
    return;
  }
  if (pipe2(out, O_CLOEXEC) != 0) {
    startError_ = errno;
    close(in[0]);
    close(in[1]);
    return;
  }
  toChild_ = in[0];
  fromChild_ = out[0];
  id_ = startChild({"/bin/sh", {"sh", "-c", forShell(command)}, {{in[1], STDIN_FILENO}, {out[1], STDOUT_FILENO}}},
                   startError_);
  if (id_ > 0) guard_.emplace(id_);
  close(in[1]);
  close(out[1]);
}

void Program::ask(std::string text, double patience_s) {
  input_ = std::move(text);
  written_ = 0;
  patience_s_ = patience_s;
}

Program::~Program() {
  closeInput();
  if (fromChild_ >= 0) close(fromChild_);
  if (id_ <= 0) return;
  kill(-id_, SIGKILL);
  guard_.reset();
  while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Program::closeInput() {
  if (toChild_ >= 0) close(toChild_);
  toChild_ = -1;
}

void Program::writeInput() {
  const ssize_t n = send(toChild_, input_.data() + written_, input_.size() - written_, MSG_NOSIGNAL | MSG_DONTWAIT);
  if (n > 0) written_ += static_cast<size_t>(n);
  const bool broken = n < 0 && errno != EAGAIN && errno != EINTR;
  if (broken) closeInput();
}

size_t Program::read(char* buffer, size_t size) {
  while (id_ > 0 && fromChild_ >= 0 && !hung_) {
    pollfd ends[] = {{fromChild_, POLLIN, 0}, {toChild_, POLLOUT, 0}};
    const auto start = Clock::now();
    const bool writing = toChild_ >= 0 && written_ < input_.size();
    const int ready = poll(ends, writing ? 2 : 1, static_cast<int>(1000 * std::min(patience_s_, kPollEvery_s)) + 1);
    patience_s_ -= secondsSince(start);
    hung_ = patience_s_ <= 0 || stopRequested();
    if (ready < 0 && errno != EINTR) break;
    if (ready <= 0) continue;
    if (ends[1].revents != 0) writeInput();
    if (ends[0].revents == 0) continue;
    const ssize_t n = ::read(fromChild_, buffer, size);
    if (n > 0) return static_cast<size_t>(n);
    if (n == 0 || errno != EINTR) break;
  }
  return 0;
}

std::string Program::finish() {
  if (startError_ != 0) return fmt::format("could not be started: {}", std::strerror(startError_));
  closeInput();
  siginfo_t info{};
  for (const auto start = Clock::now(); !hung_ && info.si_pid == 0;) {
    waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (info.si_pid == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    hung_ = info.si_pid == 0 && (secondsSince(start) > patience_s_ || stopRequested());
  }
  if (info.si_pid == 0)
    return stopRequested() ? "was killed, because this program is to end" : "did not answer in time and was killed";
  kill(-id_, SIGKILL);  // kills what it left running; before the wait no other group can have this id
  guard_.reset();
  int status = 0;
  waitpid(id_, &status, 0);
  id_ = -1;
  if (WIFSIGNALED(status)) return fmt::format("died of signal {}", WTERMSIG(status));
  if (WEXITSTATUS(status) == 127) return "does not exist";
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("failed with exit code {}", WEXITSTATUS(status));
}

std::unique_ptr<Program> ProgramPool::take(const std::string& command) {
  {
    const std::lock_guard lock(mutex_);
    auto& idle = idle_[command];
    if (!idle.empty()) {
      auto program = std::move(idle.back());
      idle.pop_back();
      return program;
    }
  }
  return std::make_unique<Program>(command);
}

void ProgramPool::giveBack(const std::string& command, std::unique_ptr<Program> program) {
  const std::lock_guard lock(mutex_);
  idle_[command].push_back(std::move(program));
}

}  // namespace tomales::rib
