#include "reyes/base/trust.h"

#include <cstdlib>
#include <filesystem>

#include "reyes/base/process.h"

namespace tomales {
namespace {

constexpr const char* kFolder = "tomales/plugins";

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Ignores a relative XDG_CONFIG_HOME, as the XDG Base Directory Specification demands.
std::string configurationFolder() {
  const std::filesystem::path given = environment("XDG_CONFIG_HOME"), home = environment("HOME");
  if (given.is_absolute()) return (given / kFolder).string();
  return home.is_absolute() ? (home / ".config" / kFolder).string() : "";
}

}  // namespace

std::string Trust::pluginFolders() const {
  std::string out = pluginPath;
  for (const std::string& more : {environment("TOMALES_PLUGIN_PATH"), configurationFolder()}) out += ":" + more;
  for (const std::filesystem::path& installed : besideProgram(kFolder)) out += ":" + installed.string();
  return out;
}

const char* const kPluginRefusal =
    "is native code in a folder that only the scene names, and is not loaded; --plugin-path FOLDER names a folder "
    "whose "
    "plugins you trust, --allow-plugins trusts those of the scene";

}  // namespace tomales
