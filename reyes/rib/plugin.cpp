#include "reyes/rib/plugin.h"

#include <dlfcn.h>

#include <filesystem>

#include "reyes/base/crash_note.h"
#include "reyes/base/loaded_plugins.h"

namespace tomales::rib {
namespace {

Plugin open(const std::string& path, PluginTrial& trial) {
  Plugin p;
  p.trouble = trial.fateOf(path);
  if (!p.trouble.empty()) return p;
  noteLoadedPlugin(path);
  const CrashNote note({"procedural plugin", path.c_str(), "while plugins are loaded", nullptr, nullptr, 0});
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    const char* why = dlerror();
    p.trouble = std::string("cannot be loaded: ") + (why ? why : "no reason is given");
    return p;
  }
  const auto find = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    if (!function) p.trouble += (p.trouble.empty() ? "has no function " : ", ") + std::string(name);
  };
  find(p.convertParameters, "ConvertParameters");
  find(p.subdivide, "Subdivide");
  find(p.free, "Free");
  return p;
}

}  // namespace

// A path without a folder would be searched for among the libraries of the system.
const Plugin& PluginPool::load(const std::string& written) {
  const std::string path = std::filesystem::absolute(written).string();
  const std::lock_guard lock(mutex_);
  const auto it = plugins_.find(path);
  return it != plugins_.end() ? it->second : plugins_.emplace(path, open(path, trial_)).first->second;
}

}  // namespace tomales::rib
