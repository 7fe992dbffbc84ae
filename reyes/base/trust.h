// Whose code may run. A plugin is native code, and a program of the shell may do what its user may, while the scene
// that names them may come from a stranger. docs/security.md has the table. Threads: plain object.
#pragma once
#include <string>

namespace tomales {

struct Trust {
  bool programs = false;        ///< The scene may start programs; then it may load whatever it likes, too.
  bool scenePlugins = false;    ///< Plugins may come from folders that only the scene names, and the working folder.
  std::string pluginPath{};     ///< --plugin-path: folders, separated by colons, that plugins may come from.
  std::string shaderFolders{};  ///< --shaders: likewise, for shaders and displays, before those.
  std::string program{};        ///< --allow-program: RunProgram may start this very command in any case.

  /// pluginPath, then TOMALES_PLUGIN_PATH, then tomales/plugins in the user's configuration (XDG_CONFIG_HOME, else
  /// ~/.config) and in the library folder of the installation.
  std::string pluginFolders() const;

  bool allowsPluginsOfScene() const { return scenePlugins || programs; }
};

/// What follows the name of a plugin that is found in a folder which is not trusted.
extern const char* const kPluginRefusal;

}  // namespace tomales
