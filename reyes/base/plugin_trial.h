// Plugins are tried in a child process before they are loaded, because their constructors run before anything about
// them can be checked (docs/decisions/0043). Threads: one at a time may use it.
#pragma once
#include <sys/types.h>

#include <optional>
#include <string>

#include "reyes/base/child_process.h"

namespace tomales {

/// One child, the program tomales_plugin_trial, tries plugin after plugin. It is replaced when one has ended it, and
/// ends by itself when nothing is asked for a while.
class PluginTrial {
 public:
  PluginTrial() = default;
  ~PluginTrial() { end(); }
  PluginTrial(const PluginTrial&) = delete;

  /// Says what becomes of a process that loads this plugin; empty if it lives, or if there is no such child.
  std::string fateOf(const std::string& path);
  /// Returns false if the child could not be started, so that the last plugin is untried.
  bool works() const { return works_; }

 private:
  bool begin(const std::string& path);
  void start();
  int end();

  bool works_ = true;
  pid_t child_ = -1;
  std::optional<ChildGuard> guard_;
  int socket_ = -1;
};

}  // namespace tomales
