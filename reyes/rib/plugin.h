// Procedural "DynamicLoad": a shared library in the classic form, ConvertParameters, Subdivide and Free (reyes/ri.h).
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "reyes/base/plugin_trial.h"
#include "reyes/ri.h"

namespace tomales::rib {

struct Plugin {
  RtPointer (*convertParameters)(char*) = nullptr;
  void (*subdivide)(RtPointer, RtFloat) = nullptr;
  void (*free)(RtPointer) = nullptr;
  std::string trouble;  ///< Why it cannot be used; empty if it can.
};

/// Libraries are tried in a process of their own, then loaded, and stay in memory: procedurals keep pointers to their
/// functions. Threads: calls may be concurrent.
class PluginPool {
 public:
  const Plugin& load(const std::string& path);

 private:
  std::mutex mutex_;
  std::map<std::string, Plugin> plugins_;
  PluginTrial trial_;
};

}  // namespace tomales::rib
