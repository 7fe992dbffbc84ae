// Shows a picture while it is made, by the display driver "tev" (displays/tev.cpp), in a viewer that listens.
#pragma once
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "reyes/base/log.h"
#include "reyes/display_driver.h"

namespace tomales {

class Preview {
 public:
  /// `address`: "host:port". Nobody there: reported once, and the picture is made without.
  Preview(std::string address, const std::string& name, const DeepFrame& layout, Log& log);
  /// Waits a second at most for a viewer that lags behind.
  ~Preview();
  Preview(const Preview&) = delete;

  /// Some rows, as they go to the Displays. Never waits: what a slow viewer leaves too much of is not shown.
  void show(const Image& rows);

 private:
  void run();
  std::optional<Image> next();

  const std::string address_;
  const DriverPicture picture_;
  Log& log_;
  std::mutex mutex_;
  std::condition_variable wake_, ended_;
  std::deque<Image> waiting_;
  size_t waiting_bytes_ = 0;
  bool done_ = false, closed_ = false;
  DisplayDriver* driver_ = nullptr;  ///< That of the thread, while it lives.
  std::thread thread_;
};

}  // namespace tomales
