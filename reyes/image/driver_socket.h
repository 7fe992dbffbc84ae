// Private to reyes/image: the protocol between DisplayDriver and the program that it starts, over a socket. The answer
// to each request says whether it succeeded, and has a text: what went wrong or, for Open, the unread parameters, one
// per line.
#pragma once
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "reyes/base/pack.h"
#include "reyes/state_fields.h"

namespace tomales::driver {

constexpr int kSocket = STDERR_FILENO + 1;  ///< The socket's descriptor in the program.

enum class Request : uint32_t { Open, Rows, Close };

/// The heads of messages in the two directions. `bytes` bytes follow.
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

/// Request::Rows has these bytes, then pixels. Request::Close has one uint32_t, which is 1 if the picture is complete.
struct RowsHead {
  int32_t x, y, width, height;
};

/// Returns false if the other side has gone.
inline bool sendAll(int socket, const void* data, size_t size) {
  for (const char* at = static_cast<const char*>(data); size > 0;) {
    const ssize_t n = ::send(socket, at, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<size_t>(n);
  }
  return true;
}

inline bool receiveAll(int socket, void* data, size_t size) {
  for (char* at = static_cast<char*>(data); size > 0;) {
    const ssize_t n = ::recv(socket, at, size, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<size_t>(n);
  }
  return true;
}

}  // namespace tomales::driver
