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
  /// `address` is "host:port". If nothing listens there, this is reported once, and the picture is made all the same.
  Preview(std::string address, const std::string& name, const DeepFrame& layout, Log& log);
  /// Waits at most a second for a viewer that is slow.
  ~Preview();
  Preview(const Preview&) = delete;

  /// Takes some rows, as they go to the Displays. It never waits: rows that a slow viewer cannot take are not shown.
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
  DisplayDriver* driver_ = nullptr;  ///< The driver of the thread, while that runs.
  std::thread thread_;
};

}  // namespace tomales
