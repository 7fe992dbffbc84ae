// Functions of plugins for shaders in the shading language (reyes/shader/functions.h). All plugins of the trusted
// folders are opened when a shader first calls a function that the language does not have. Threads: any.
#pragma once
#include <map>
#include <mutex>

#include "reyes/base/log.h"
#include "reyes/base/plugin_trial.h"
#include "reyes/rsl.h"

namespace tomales {

class FunctionPlugins {
 public:
  explicit FunctionPlugins(Log& log) : log_(log) {}
  FunctionPlugins(const FunctionPlugins&) = delete;

  /// Returns the functions of that name in these folders, ordered by folder, then by the plugin's file name, then as
  /// the plugin lists them.
  std::vector<const TmFunction*> named(const std::string& name, const std::vector<std::string>& folders);

 private:
  using Functions = std::map<std::string, std::vector<const TmFunction*>>;  ///< Indexed by the name that shaders call.
  void open(const std::string& folder, Functions& out);
  void load(const std::string& path, Functions& out);
  void refuse(const std::string& path, const std::string& problem);

  Log& log_;
  std::mutex mutex_;
  PluginTrial trial_;
  std::map<std::string, Functions> folders_;
};

/// The functions of some folders, as the compiler asks for them.
class FunctionsOfFolders final : public RslFunctions {
 public:
  FunctionsOfFolders(FunctionPlugins& plugins, std::vector<std::string> folders)
      : plugins_(plugins), folders_(std::move(folders)) {}
  std::vector<const TmFunction*> named(const std::string& name) const override {
    return plugins_.named(name, folders_);
  }
  const std::vector<std::string>& folders() const { return folders_; }

 private:
  FunctionPlugins& plugins_;
  const std::vector<std::string> folders_;
};

}  // namespace tomales
