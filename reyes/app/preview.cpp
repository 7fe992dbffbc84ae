#include "reyes/app/preview.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>

namespace tomales {
namespace {

constexpr size_t kMostWaiting_bytes = size_t{64} << 20;
constexpr int kPatience_ms = 1000;  ///< With a viewer that does not answer, once the picture is done.
constexpr char kCreateImage = 4, kUpdateImage = 6;
constexpr const char* kChannels[] = {"R", "G", "B", "A"};

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
  std::string finish() {
    const auto size = static_cast<uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof(size));
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

Packet& addChannels(Packet& packet) {
  for (const char* channel : kChannels) packet << std::string(channel);
  return packet;
}

}  // namespace

Preview::Preview(std::string address, std::string name, const DeepFrame& layout, Log& log)
    : address_(std::move(address)), name_(std::move(name)), crop_(layout.crop), log_(log), thread_([this] { run(); }) {}

Preview::~Preview() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_all();
  thread_.join();
  if (socket_ >= 0) ::close(socket_);
}

void Preview::show(const Image& rows) {
  constexpr int32_t kCount = std::size(kChannels);
  Packet packet(kUpdateImage);
  packet << char{0} << name_ << kCount;
  addChannels(packet) << int32_t{rows.originX - crop_.x0} << int32_t{rows.originY - crop_.y0} << int32_t{rows.width}
                      << int32_t{rows.height};
  for (int64_t c = 0; c < kCount; ++c) packet << c;                // where each channel begins,
  for (int64_t c = 0; c < kCount; ++c) packet << int64_t{kCount};  // and from pixel to pixel
  for (size_t i = 0; i < rows.pixels.size(); i += rows.channels.size())
    for (int c = 0; c < kCount; ++c) packet << rows.pixels[i + static_cast<size_t>(c)];
  std::string bytes = packet.finish();
  const std::lock_guard lock(mutex_);
  if (closed_ || waiting_bytes_ + bytes.size() > kMostWaiting_bytes) return;
  waiting_bytes_ += bytes.size();
  waiting_.push_back(std::move(bytes));
  wake_.notify_all();
}

void Preview::run() {
  Packet create(kCreateImage);
  create << char{1} << name_ << int32_t{crop_.width()} << int32_t{crop_.height()} << int32_t{std::size(kChannels)};
  bool open = connect() && send(addChannels(create).finish());
  if (!open)
    log_.report(Severity::Warning, "preview", {},
                "--preview: nobody listens at " + address_ + "; the picture is made without");
  while (open) {
    std::string packet;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return done_ || !waiting_.empty(); });
      if (waiting_.empty()) break;
      packet = std::move(waiting_.front());
      waiting_.pop_front();
      waiting_bytes_ -= packet.size();
    }
    open = send(packet);
  }
  const std::lock_guard lock(mutex_);
  closed_ = true;
  waiting_.clear();
}

bool Preview::connect() {
  const size_t colon = address_.rfind(':');
  const std::string host = address_.substr(0, colon),
                    port = colon == std::string::npos ? "14158" : address_.substr(colon + 1);
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (::getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) return false;
  for (const addrinfo* a = found; a && socket_ < 0; a = a->ai_next) {
    socket_ = ::socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol);
    pollfd waits{socket_, POLLOUT, 0};
    int problem = 0;
    socklen_t size = sizeof(problem);
    const bool begun = socket_ >= 0 && (::connect(socket_, a->ai_addr, a->ai_addrlen) == 0 || errno == EINPROGRESS);
    if (begun && ::poll(&waits, 1, kPatience_ms) == 1 &&
        ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &problem, &size) == 0 && problem == 0)
      break;
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }
  ::freeaddrinfo(found);
  return socket_ >= 0;
}

bool Preview::send(const std::string& packet) {
  auto deadline = std::chrono::steady_clock::time_point::max();
  for (size_t at = 0; at < packet.size();) {
    const ssize_t n = ::send(socket_, packet.data() + at, packet.size() - at, MSG_NOSIGNAL);
    if (n > 0) {
      at += static_cast<size_t>(n);
      continue;
    }
    if (n < 0 && errno != EAGAIN && errno != EINTR) return false;
    {
      const std::lock_guard lock(mutex_);
      const auto now = std::chrono::steady_clock::now();
      if (done_ && deadline == std::chrono::steady_clock::time_point::max())
        deadline = now + std::chrono::milliseconds(kPatience_ms);
      if (now > deadline) return false;
    }
    pollfd waits{socket_, POLLOUT, 0};
    ::poll(&waits, 1, 100);
  }
  return true;
}

}  // namespace tomales
