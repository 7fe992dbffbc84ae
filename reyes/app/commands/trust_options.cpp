// Options that say whose code may run, and where files are looked for.
#include <fmt/format.h>

#include <algorithm>

#include "reyes/app/commands/options.h"
#include "reyes/base/standard_folders.h"

namespace tomales {
namespace {

/// Puts the folders into the environment, which is read wherever files are looked for.
void addSearchPath(CLI::App& app) {
  std::string kinds, places;
  for (const StandardPlace& p : standardPlaces()) {
    kinds += (kinds.empty() ? "" : "|") + std::string(p.kind);
    places += fmt::format("{}{} and ~/.config/tomales/{}", places.empty() ? "" : ", ", p.variable, p.folder);
  }
  app.add_option_function<std::vector<std::string>>(
         "--searchpath",
         [kinds](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const size_t equals = std::min(text.find('='), text.size());
             const std::string kind = text.substr(0, equals);
             const auto known = standardPlaces();
             if (equals == text.size() ||
                 std::none_of(known.begin(), known.end(), [&](const StandardPlace& p) { return p.kind == kind; }))
               throw CLI::ValidationError("--searchpath", "\"" + text + "\" is not of the form " + kinds + "=FOLDERS");
             addToStandardPath(kind, text.substr(equals + 1));
           }
         },
         "Folders, separated by colons, where files of a kind are looked for after those that the RIB names; may be "
         "given again (also: " +
             places + "). Plugins in folders of shaders are trusted")
      ->expected(1)
      ->take_all()
      ->type_name(kinds + "=FOLDERS");
}

}  // namespace

void addTrust(CLI::App& app, Trust& trust) {
  app.add_flag("--allow-system", trust.programs,
               "The RIB may start programs (System, Procedural \"RunProgram\"), and all that --allow-plugins allows");
  app.add_flag("--allow-plugins", trust.scenePlugins,
               "The RIB may load plugins, which can do whatever you can, from the working folder and its search paths");
  app.add_option("--plugin-path", trust.pluginPath,
                 "Folders of plugins that you trust, separated by colons; they are searched before those of the RIB, "
                 "and followed by TOMALES_PLUGIN_PATH and ~/.config/tomales/plugins")
      ->type_name("FOLDERS");
  addShaderFolders(app, trust.shaderFolders);
}

void addShaderFolders(CLI::App& app, std::string& folders) {
  app.add_option("--shaders", folders, "Folders (A:B) of shaders to search first; their plugins are trusted")
      ->type_name("FOLDERS");
  addSearchPath(app);
}

}  // namespace tomales
