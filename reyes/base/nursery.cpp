#include "reyes/base/nursery.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

namespace tomales {
namespace {

using Body = int (*)(const std::vector<std::string>& arguments);

int nursery = -1;  ///< The socket to it; -1: there is none.

bool sendAll(int socket, const void* data, size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(socket, at, size, MSG_NOSIGNAL);
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<size_t>(sent);
  }
  return true;
}

bool receiveAll(int socket, void* data, size_t size) {
  return size == 0 || ::recv(socket, data, size, MSG_WAITALL) == static_cast<ssize_t>(size);
}

/// Sends texts one after the other, each with its terminating zero.
bool sendTexts(int socket, const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all.append(text.c_str(), text.size() + 1);
  const uint64_t size = all.size();
  return sendAll(socket, &size, sizeof size) && sendAll(socket, all.data(), all.size());
}

bool receiveTexts(int socket, std::vector<std::string>& texts) {
  uint64_t size = 0;
  if (!receiveAll(socket, &size, sizeof size)) return false;
  std::string all(size, '\0');
  if (!receiveAll(socket, all.data(), all.size())) return false;
  texts.clear();
  for (size_t at = 0; at < all.size(); at += texts.back().size() + 1) texts.emplace_back(all.c_str() + at);
  return true;
}

bool redirect(const char* file, int flags, std::initializer_list<int> to) {
  const int from = ::open(file, flags | O_CLOEXEC, 0666);
  bool good = from >= 0;
  for (const int number : to) good = good && ::dup2(from, number) >= 0;
  if (from > STDERR_FILENO) ::close(from);
  return good;
}

/// `texts`: the folder, the log, and the arguments. The child begins when it reads a byte from `go`.
[[noreturn]] void runChild(std::vector<std::string> texts, pid_t owner, pid_t middle, int go, Body body) {
  while (::getppid() == middle) ::sched_yield();  // until the middle process has ended and the owner is the parent
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::setpgid(0, 0);
  char byte = 0;
  const bool isKnown = receiveAll(go, &byte, 1);
  ::close(go);
  const bool ready = isKnown && ::getppid() == owner && ::chdir(texts[0].c_str()) == 0 &&
                     redirect("/dev/null", O_RDONLY, {STDIN_FILENO}) &&
                     redirect(texts[1].c_str(), O_WRONLY | O_CREAT | O_APPEND, {STDOUT_FILENO, STDERR_FILENO});
  if (!ready) ::_exit(kNotBegun);
  texts.erase(texts.begin(), texts.begin() + 2);
  std::exit(body(texts));
}

/// Starts a child by way of a middle process, which ends at once, so that the owner, which adopts orphans, can wait for
/// the child. The child begins only when the owner knows of it: an unknown one would run beside its replacement.
/// Returns false if the owner is gone, or if no process or pipe can be made.
bool begin(int socket, const std::vector<std::string>& texts, pid_t owner, Body body) {
  int ends[2], go[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return false;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, go) != 0) return false;
  pid_t child = -1;
  const pid_t middle = ::fork();
  if (middle == 0) {
    const pid_t self = ::getpid();
    child = ::fork();
    if (child == 0) {
      for (const int file : {socket, ends[0], ends[1], go[1]}) ::close(file);
      runChild(texts, owner, self, go[0], body);
    }
    ::_exit(::write(ends[1], &child, sizeof child) == sizeof child ? 0 : kNotBegun);
  }
  ::close(ends[1]);
  ::close(go[0]);
  if (middle > 0 && ::read(ends[0], &child, sizeof child) != sizeof child) child = -1;
  ::close(ends[0]);
  if (middle > 0) ::waitpid(middle, nullptr, 0);
  const bool isTold = sendAll(socket, &child, sizeof child);
  if (isTold && child > 0) sendAll(go[1], "", 1);
  ::close(go[1]);
  return isTold;
}

[[noreturn]] void serve(int socket, pid_t owner, Body body) {
  for (std::vector<std::string> texts; receiveTexts(socket, texts) && begin(socket, texts, owner, body);) continue;
  ::_exit(0);
}

}  // namespace

void openNursery(Body body) {
  int ends[2];
  ::signal(SIGCHLD, SIG_DFL);  // if a parent left it ignored, exit codes of children would be lost
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
  const pid_t owner = ::getpid(), child = ::prctl(PR_SET_CHILD_SUBREAPER, 1) == 0 ? ::fork() : -1;
  if (child == 0) {
    ::close(ends[0]);
    serve(ends[1], owner, body);
  }
  ::close(ends[1]);
  if (child > 0)
    nursery = ends[0];
  else
    ::close(ends[0]);
}

pid_t startInNursery(const std::string& folder, const std::string& log, const std::vector<std::string>& arguments) {
  if (nursery < 0) return -1;
  std::vector<std::string> texts{folder, log};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  pid_t child = -1;
  if (sendTexts(nursery, texts) && receiveAll(nursery, &child, sizeof child)) return child;
  ::close(nursery);
  nursery = -1;
  return -1;
}

}  // namespace tomales
