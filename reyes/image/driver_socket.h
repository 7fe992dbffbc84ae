// Private to reyes/image: what DisplayDriver and the program that it starts say to each other, over a socket. Each
// request is answered by whether it went well, and a text: what went wrong, or, of Open, the parameters that were not
// read, each in a line.
#pragma once
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "reyes/base/pack.h"
#include "reyes/state_fields.h"

namespace tomales::driver {

constexpr int kSocket = STDERR_FILENO + 1;  ///< Of the program.

enum class Request : uint32_t { Open, Rows, Close };

/// What is said in the one direction and in the other. `bytes` follow.
struct RequestHead {
  Request request;
  uint64_t bytes;
};
struct AnswerHead {
  uint32_t good;
  uint64_t bytes;
};

/// The bytes of Request::Open.
struct Opening {
  std::string name, mode;
  std::array<int32_t, 6> window;  ///< width, height, x, y, fullWidth, fullHeight
  float pixelAspect;
  std::vector<std::string> channels;
  ParamList params;
  mat4 worldToCamera, worldToScreen;
};
template <class A>
void fields(A& a, Opening& x) {
  auto& [name, mode, window, pixelAspect, channels, params, worldToCamera, worldToScreen] = x;
  each(a, name, mode, window, pixelAspect, channels, params, worldToCamera, worldToScreen);
}

/// The bytes of Request::Rows begin with this; pixels follow. Those of Close are one uint32_t: is the picture complete?
struct RowsHead {
  int32_t x, y, width, height;
};

/// False: the other side has gone.
inline bool sendAll(int socket, const void* data, size_t size) {
  for (const char* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t n = ::send(socket, at, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n, size -= static_cast<size_t>(n);
  }
  return true;
}

inline bool receiveAll(int socket, void* data, size_t size) {
  for (char* at = static_cast<char*>(data); size > 0;) {
    const ssize_t n = ::recv(socket, at, size, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n, size -= static_cast<size_t>(n);
  }
  return true;
}

}  // namespace tomales::driver
