#include "reyes/shade/plugin_trial.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <climits>
#include <cstring>

#include "reyes/shader_api.h"

namespace tomales {
namespace {

constexpr int kMostSeconds = 10, kIdleMilliseconds = 200;
constexpr char kBegins = 'b', kLives = 'l';  // said in this order, for each plugin

bool arrives(int socket, int milliseconds) {
  pollfd wait{socket, POLLIN, 0};
  int ready;
  while ((ready = poll(&wait, 1, milliseconds)) < 0 && errno == EINTR) {
  }
  return ready > 0;
}

bool say(int socket, char word) { return send(socket, &word, 1, MSG_NOSIGNAL) == 1; }

enum class Heard { Word, End, Nothing };

Heard hear(int socket) {
  if (!arrives(socket, 1000 * kMostSeconds)) return Heard::Nothing;
  char word;
  return recv(socket, &word, 1, 0) == 1 ? Heard::Word : Heard::End;
}

[[noreturn]] void tryPlugins(int socket) {
  constexpr int kSocket = STDERR_FILENO + 1;
  // What the parent has open is not to stay open here, nor is anything to be said twice.
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, standard);
  dup2(socket, kSocket);
  close_range(kSocket + 1, ~0u, 0);
  char path[PATH_MAX + 1];
  while (arrives(kSocket, kIdleMilliseconds)) {
    const ssize_t length = recv(kSocket, path, PATH_MAX, 0);
    if (length <= 0 || !say(kSocket, kBegins)) break;
    path[length] = 0;
    if (void* handle = dlopen(path, RTLD_NOW | RTLD_LOCAL))
      if (const auto function = reinterpret_cast<TmShadersFunction>(dlsym(handle, TM_SHADERS_SYMBOL))) function();
    say(kSocket, kLives);
  }
  _exit(0);
}

}  // namespace

void PluginTrial::start() {
  end();
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return;
  child_ = fork();
  if (child_ == 0) tryPlugins(ends[1]);
  close(ends[1]);
  if (child_ < 0)
    close(ends[0]);
  else
    socket_ = ends[0];
}

/// Returns the status of the child, which ends as soon as nobody speaks to it.
int PluginTrial::end() {
  if (child_ < 0) return 0;
  close(socket_);
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1, socket_ = -1;
  return status;
}

/// False: there is no child, or it has ended because nothing was asked.
bool PluginTrial::begin(const std::string& path) {
  return child_ > 0 && send(socket_, path.c_str(), path.size(), MSG_NOSIGNAL) > 0 && hear(socket_) == Heard::Word;
}

std::string PluginTrial::fateOf(const std::string& path) {
  if (!begin(path)) {
    start();
    if (!begin(path)) return {};  // no child to be had: untried
  }
  const Heard heard = hear(socket_);
  if (heard == Heard::Word) return {};
  if (heard == Heard::Nothing) kill(child_, SIGKILL);
  const int status = end();
  if (heard == Heard::Nothing) return fmt::format("does not end loading within {} s", kMostSeconds);
  if (WIFSIGNALED(status)) return fmt::format("crashes while it is loaded ({})", strsignal(WTERMSIG(status)));
  return "ends the program while it is loaded";
}

}  // namespace tomales
