// The plugins that this process has loaded, for the last words of a crash: the code of one of them may be to blame.
// Threads: any, also a signal handler.
#pragma once
#include <string>

namespace tomales {

constexpr int kMostLoadedPlugins = 16;  ///< Later ones are not told.

void noteLoadedPlugin(const std::string& path);
/// Null behind the last one.
const char* loadedPlugin(int number);

}  // namespace tomales
