// The plugins that this process has loaded, for the message of a crash: the code of one of them may be to blame.
// Threads: any; a signal handler may call it too.
#pragma once
#include <string>

namespace tomales {

constexpr int kMostLoadedPlugins = 16;  ///< Later plugins are not named.

void noteLoadedPlugin(const std::string& path);
/// Returns null after the last one.
const char* loadedPlugin(int number);

}  // namespace tomales
