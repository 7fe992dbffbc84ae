#include "reyes/base/loaded_plugins.h"

#include <atomic>
#include <cstdlib>
#include <cstring>

namespace tomales {
namespace {

std::atomic<const char*> paths[kMostLoadedPlugins];  // the texts are never freed

}  // namespace

void noteLoadedPlugin(const std::string& path) {
  char* text = strdup(path.c_str());
  for (std::atomic<const char*>& place : paths)
    if (const char* none = nullptr; place.compare_exchange_strong(none, text)) return;
  free(text);
}

const char* loadedPlugin(int number) { return number < kMostLoadedPlugins ? paths[number].load() : nullptr; }

}  // namespace tomales
