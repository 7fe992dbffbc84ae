#include "reyes/base/trust.h"

#include <cstdlib>
#include <filesystem>

#include "reyes/base/process.h"
#include "reyes/base/standard_folders.h"

namespace tomales {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

std::string Trust::pluginFolders() const {
  std::string out = pluginPath;
  for (const std::string& more : {environment("TOMALES_PLUGIN_PATH"), userFolder("plugins")}) out += ":" + more;
  for (const std::filesystem::path& installed : besideProgram("../lib/tomales/plugins"))
    out += ":" + installed.string();
  return out;
}

const char* const kPluginRefusal =
    "is native code in a folder that only the scene names, and is not loaded; --plugin-path FOLDER names a folder "
    "whose "
    "plugins you trust, --allow-plugins trusts those of the scene";

}  // namespace tomales
