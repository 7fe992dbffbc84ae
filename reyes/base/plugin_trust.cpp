#include "reyes/base/plugin_trust.h"

#include <algorithm>
#include <filesystem>

#include "reyes/base/search_path.h"

namespace tomales {

namespace fs = std::filesystem;

std::vector<std::string> pluginFiles(const std::string& name, const std::string& searchPath) {
  std::vector<std::string> out;
  for (const fs::path folder : foldersOf(searchPath)) {
    std::error_code none;
    if (const fs::path file = folder / (name + ".so"); fs::is_regular_file(file, none)) out.push_back(file.string());
  }
  return out;
}

bool leavesFolders(const std::string& name) {
  const fs::path path = name;
  return path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
}

PluginFiles findPlugins(const std::string& name, const std::string& searchPath, const PluginTrust& trust) {
  PluginFiles out;
  if (!leavesFolders(name)) out.trusted = pluginFiles(name, trust.folders);
  for (const std::string& file : pluginFiles(name, searchPath.empty() ? "." : searchPath))
    if (trust.sceneFolders)
      out.trusted.push_back(file);
    else if (out.trusted.empty())
      out.refused.push_back(file);
  return out;
}

}  // namespace tomales
