// Tells which plugins may be loaded. A plugin is native code, while a scene, which names plugins and search paths, may
// come from a stranger.
#pragma once
#include <string>
#include <vector>

namespace tomales {

struct PluginTrust {
  std::string folders{};  ///< Folders that the user named, separated by colons: searched before those of the scene.
  /// Those of `folders` that were chosen for this run; shaders as text beside the scene come after them.
  std::string chosen{};
  bool sceneFolders = false;  ///< If true, folders that the scene names, and the working folder, are trusted too.
};

struct PluginFiles {
  std::vector<std::string> trusted;
  std::vector<std::string> refused;  ///< Plugins in folders that are not trusted, if a trusted one has none.
};

/// Returns the paths of NAME.so in the folders of a search path.
std::vector<std::string> pluginFiles(const std::string& name, const std::string& searchPath);
/// Finds NAME.so in the trusted folders, then along the scene's search path (if empty, in the working folder). A name
/// with ".." or an absolute one leads out of the trusted folders, so they are not searched for it.
PluginFiles findPlugins(const std::string& name, const std::string& searchPath, const PluginTrust& trust);

/// Tells whether the name of a plugin leads out of the folders that are searched for it.
bool leavesFolders(const std::string& name);

}  // namespace tomales
