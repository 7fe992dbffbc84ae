#include "reyes/rib/plugin.h"

#include <dlfcn.h>

#include <filesystem>

namespace tomales::rib {
namespace {

// A path without a folder would be searched for among the libraries of the system.
Plugin open(const std::string& path) {
  Plugin p;
  void* library = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
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

const Plugin& PluginPool::load(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto it = plugins_.find(path);
  return it != plugins_.end() ? it->second : plugins_.emplace(path, open(path)).first->second;
}

}  // namespace tomales::rib
