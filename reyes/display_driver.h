// Display drivers (reyes/display_api.h), seen from the renderer. Each opened picture has a process of its own, the
// program tomales_display_host, which loads the plugin: one that crashes or is stopped takes nothing else with it.
#pragma once
#include <memory>
#include <string>

#include "reyes/image.h"

namespace tomales {

/// Returns the path of a driver that comes with the program, or an empty string if there is none of this type.
std::string suppliedDriver(const std::string& type);

/// The facts that a driver is told when it opens a picture.
struct DriverPicture {
  /// The name and mode that the Display gives.
  std::string name, mode;
  int width = 0, height = 0, x = 0, y = 0, fullWidth = 0, fullHeight = 0;  ///< The fields of TmDisplayPicture.
  float pixelAspect = 1;
  std::vector<std::string> channels;
  ParamList params;
  View view;
};

/// Threads: one at a time may use it, but any may call abandon().
class DisplayDriver {
 public:
  /// Starts the process and opens the picture; failed() says whether that went well. The thread that calls this must
  /// outlive the driver, whose process ends with it.
  DisplayDriver(const std::string& plugin, const DriverPicture& picture);
  ~DisplayDriver();  ///< Tells a driver that is not closed that rows are missing.
  DisplayDriver(const DisplayDriver&) = delete;

  /// Each returns false if it fails, and error() says why. Neither may be called after a failure.
  bool write(const Image& rows);
  bool close();
  /// Kills the process, from any thread: calls that wait for it fail.
  void abandon();

  bool failed() const;
  const std::string& error() const;
  /// Returns the names of parameters that the driver has not read.
  const std::vector<std::string>& unread() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
