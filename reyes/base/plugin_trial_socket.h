// What PluginTrial and the program that it starts say to each other: paths one way, a word before and a word after each
// the other way, over a socket of packets.
#pragma once
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace tomales::trial {

constexpr int kSocket = STDERR_FILENO + 1;  ///< Of the program.
constexpr char kBegins = 'b', kLives = 'l';

inline bool arrives(int socket, int milliseconds) {
  pollfd wait{socket, POLLIN, 0};
  int ready;
  while ((ready = poll(&wait, 1, milliseconds)) < 0 && errno == EINTR) {
  }
  return ready > 0;
}

}  // namespace tomales::trial
