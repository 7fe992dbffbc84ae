// Says whose code may run. A plugin is native code, and a program may do whatever its user may, while the scene that
// names them may come from a stranger. docs/security.md has the table. Threads: plain object.
#pragma once
#include <string>

namespace tomales {

struct Trust {
  bool programs = false;      ///< The scene may start programs, and so may load any plugin too.
  bool scenePlugins = false;  ///< Plugins may come from folders that only the scene names, and from the working folder.
  std::string pluginPath{};   ///< --plugin-path: folders, separated by colons, that plugins may come from.
  std::string shaderFolders{};  ///< --shaders: folders for shaders and displays, searched before pluginPath.
  std::string program{};        ///< --allow-program: RunProgram may start this very command in any case.

  /// Returns the folders of plugins: pluginPath, then TOMALES_PLUGIN_PATH, then tomales/plugins in the user's
  /// configuration (XDG_CONFIG_HOME, else ~/.config) and in the library folder of the installation.
  std::string pluginFolders() const;

  bool allowsPluginsOfScene() const { return scenePlugins || programs; }
};

/// The words that follow the name of a plugin found in a folder that is not trusted.
extern const char* const kPluginRefusal;

}  // namespace tomales
