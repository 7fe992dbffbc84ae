// Shows a picture while it is made, in a viewer that listens to the protocol of tev (github.com/Tom94/tev): packets
// over TCP, each 4 bytes of length, 1 of type, then the fields; numbers little-endian, strings ended by 0. Only
// CreateImage (4) and UpdateImage with strides (6) are sent.
#pragma once
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "reyes/base/log.h"
#include "reyes/image.h"

namespace tomales {

class Preview {
 public:
  /// `address`: "host:port". Nobody there: reported once, and the picture is made without.
  Preview(std::string address, std::string name, const DeepFrame& layout, Log& log);
  /// Waits a second at most for a viewer that lags behind.
  ~Preview();
  Preview(const Preview&) = delete;

  /// Some rows, as they go to the Displays. Never waits: what a slow viewer leaves too much of is not shown.
  void show(const Image& rows);

 private:
  void run();
  bool connect();
  bool send(const std::string& packet);

  const std::string address_, name_;
  const PixelRect crop_;
  Log& log_;
  int socket_ = -1;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::string> waiting_;
  size_t waiting_bytes_ = 0;
  bool done_ = false, closed_ = false;
  std::thread thread_;
};

}  // namespace tomales
