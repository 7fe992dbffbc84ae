// Plugins are tried in a child process before they are loaded, because their constructors run before anything about
// them can be checked (docs/decisions/0043). Threads: one at a time may use it.
#pragma once
#include <sys/types.h>

#include <optional>
#include <string>

#include "reyes/base/child_process.h"

namespace tomales {

/// One child, the program tomales_plugin_trial, tries plugin after plugin. A new child replaces one that a plugin has
/// ended, and an idle child ends by itself after a while.
class PluginTrial {
 public:
  PluginTrial() = default;
  ~PluginTrial() { end(); }
  PluginTrial(const PluginTrial&) = delete;

  /// Returns what happens to a process that loads this plugin; empty if it survives, or if no child could be started.
  std::string fateOf(const std::string& path);
  /// Returns false if the child could not be started; the last plugin is then untried.
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
