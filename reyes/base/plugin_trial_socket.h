// The protocol between PluginTrial and the program that it starts, over a packet socket: paths go to the program, which
// answers one byte before and one after it loads each.
#pragma once
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace tomales::trial {

constexpr int kSocket = STDERR_FILENO + 1;  ///< The socket's descriptor in the child.
constexpr char kBegins = 'b', kLives = 'l';

inline bool arrives(int socket, int milliseconds) {
  pollfd wait{socket, POLLIN, 0};
  int ready;
  while ((ready = poll(&wait, 1, milliseconds)) < 0 && errno == EINTR) {
  }
  return ready > 0;
}

}  // namespace tomales::trial
