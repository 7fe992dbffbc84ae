// Display driver "tev": shows a picture in a viewer that listens to the protocol of tev (github.com/Tom94/tev):
//   Display "HOST:PORT" "tev" "rgba" "string title" ["beauty"]
// The viewer gets packets over TCP, each 4 bytes of length, 1 of type, then the fields; numbers are little-endian,
// strings ended by 0. Only CreateImage (4) and UpdateImage with strides (6) are sent.
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "reyes/display_api.h"

namespace {

constexpr const char* kUsualPort = "14158";
constexpr char kCreateImage = 4, kUpdateImage = 6;
constexpr int kPatience_ms = 1000;  ///< The wait for a host that does not answer.

class Packet {
 public:
  explicit Packet(char type) : bytes_(4, '\0') { bytes_ += type; }
  template <class T>
  Packet& operator<<(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  Packet& operator<<(const std::string& text) {
    bytes_.append(text.c_str(), text.size() + 1);
    return *this;
  }
  bool send(int socket) {
    const auto size = static_cast<uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof(size));
    for (size_t at = 0; at < bytes_.size();) {
      const ssize_t n = ::send(socket, bytes_.data() + at, bytes_.size() - at, MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      at += static_cast<size_t>(n);
    }
    return true;
  }

 private:
  std::string bytes_;
};

struct Picture {
  int socket, x, y;
  std::string title;
  std::vector<std::string> channels;
};

/// Returns -1 if nobody listens there.
int connectTo(const std::string& address) {
  const size_t colon = address.rfind(':');
  const std::string host = address.substr(0, colon),
                    port = colon == std::string::npos ? kUsualPort : address.substr(colon + 1);
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (::getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) return -1;
  int out = -1;
  for (const addrinfo* a = found; a && out < 0; a = a->ai_next) {
    out = ::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (out < 0) continue;
    const timeval patience{kPatience_ms / 1000, kPatience_ms % 1000 * 1000}, forever{};
    ::setsockopt(out, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    if (::connect(out, a->ai_addr, a->ai_addrlen) == 0)
      ::setsockopt(out, SOL_SOCKET, SO_SNDTIMEO, &forever, sizeof forever);
    else
      ::close(std::exchange(out, -1));
  }
  ::freeaddrinfo(found);
  return out;
}

void* open(const TmDisplayPicture* p, char* problem) {
  const TmDisplayParam* title = tmDisplayParam(p, "title");
  Picture picture{connectTo(p->name),
                  p->x,
                  p->y,
                  title && title->strings ? title->strings[0] : "tomales",
                  {p->channels, p->channels + p->channelCount}};
  Packet create(kCreateImage);
  create << char{1} << picture.title << p->width << p->height << p->channelCount;
  for (const std::string& channel : picture.channels) create << channel;
  if (picture.socket >= 0 && create.send(picture.socket)) return new Picture(std::move(picture));
  std::snprintf(problem, TM_DISPLAY_PROBLEM_BYTES, "nobody listens at %s", p->name);
  if (picture.socket >= 0) ::close(picture.socket);
  return nullptr;
}

int32_t rows(void* opened, const TmDisplayRows* rows, char* problem) {
  const Picture& picture = *static_cast<Picture*>(opened);
  const auto count = static_cast<int64_t>(picture.channels.size());
  Packet update(kUpdateImage);
  update << char{0} << picture.title << static_cast<int32_t>(count);
  for (const std::string& channel : picture.channels) update << channel;
  update << rows->x - picture.x << rows->y - picture.y << rows->width << rows->height;
  for (int64_t c = 0; c < count; ++c) update << c;      // Offset where each channel begins.
  for (int64_t c = 0; c < count; ++c) update << count;  // Step from pixel to pixel.
  const int64_t floats = count * rows->width * rows->height;
  for (int64_t i = 0; i < floats; ++i) update << rows->pixels[i];
  if (update.send(picture.socket)) return 0;
  std::snprintf(problem, TM_DISPLAY_PROBLEM_BYTES, "the viewer has gone");
  return 1;
}

int32_t close(void* opened, int32_t, char*) {
  ::close(static_cast<Picture*>(opened)->socket);
  delete static_cast<Picture*>(opened);
  return 0;
}

}  // namespace

extern "C" const TmDisplayDriver* tomales_display() {
  static const TmDisplayDriver driver = {
      TM_DISPLAY_ABI, sizeof(TmDisplayDriver), "a viewer of the tev protocol", open, rows, close};
  return &driver;
}
