// The members of the registry of shaders. The search for shaders is in registry.cpp; the loading of plugins and the
// checks of their shaders are in registry_plugins.cpp. Private to the registry. Threads: only with `mutex` held.
#pragma once
#include <map>
#include <mutex>
#include <set>
#include <tuple>

#include "reyes/base/plugin_trial.h"
#include "reyes/shade/function_plugins.h"
#include "reyes/shade/rsl_shaders.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Tells whether RISpec 3.2 (appendix A) defines a shader of this name. A scene that names one gets ours, which tests
/// compare with that definition.
bool isOfSpecification(std::string_view name);

struct ShaderRegistry::Impl {
  Log& log;
  const PluginTrust trust;
  const std::optional<bool> standardFromFiles;
  std::mutex mutex;  // over what follows: find() loads plugins while other frames bind
  std::map<std::pair<int, std::string>, const TmShader*> shaders;
  struct Plugin {
    bool loaded = false;
    std::vector<const TmShader*> shaders;
  };
  std::map<std::string, Plugin> plugins;  // by path
  PluginTrial trial;
  bool untriedSaid = false;
  std::set<std::string> distrusted;  // plugins that have been reported as such
  std::set<std::string> toldOf;      // problems of shaders' texts that have been reported
  std::vector<std::shared_ptr<const RslFile>> texts{};
  std::set<const TmShader*> builtIn{};
  std::map<const TmShader*, std::string> origins{};
  std::map<const TmShader*, const TmShader*> displacements{};               ///< by the surfaces that move their points
  using Question = std::tuple<std::string, int, std::string, std::string>;  ///< The arguments of found().
  std::map<Question, const TmShader*> answers{};
  std::map<Question, std::string> broken{};  ///< For each question, the shader file with errors that was found.
  FunctionPlugins functionPlugins{log};

  void forgetAnswers() {
    answers.clear();
    broken.clear();
  }

  /// Reports that the file `origin` is not used.
  void refuse(const std::string& origin, const std::string& problem, const char* code = "shader-plugin") {
    const SourceLoc where{std::make_shared<const std::string>(origin), 0};
    log.report(Severity::Missing, code, where, problem, origin + ": " + problem);
  }
  void refuseText(const std::string& file, const std::string& problem) { refuse(file, problem, "shader-text"); }
  bool add(const TmShaderLibrary* library, const std::string& origin, std::vector<const TmShader*>* added = nullptr);
  bool load(const std::string& path);
  std::vector<std::string> trustedFiles(const std::string& name, const std::string& searchPath);
  std::string heldBy(const std::string& path) const;
  std::vector<std::string> textFolders(const std::string& searchPath, const std::string& beside) const;
  const TmShader* found(const std::string& name, TmKind kind, const std::string& searchPath, const std::string& beside);
  FunctionsOfFolders functionsAlong(const std::string& searchPath);
  const TmShader* search(const std::string& name, TmKind kind, const std::string& searchPath,
                         const std::string& beside);
  const TmShader* findText(const std::string& name, TmKind kind, const std::string& searchPath,
                           const std::string& beside);
  bool comesBeforeTexts(const TmShader& s) const {
    return !builtIn.count(&s) || (!standardFromFiles.value_or(false) && isOfSpecification(s.name));
  }
  const TmShader* standardNameWithFolders(const std::string& name, TmKind kind);
  void tellOfOtherFolder(const std::string& name, const RslFound& found);
  const TmShader* keep(const RslFound& found);
  void tellOfStandardName(const TmShader& used, const std::string& file, const std::string& because = {},
                          bool hasOther = true);
  /// Returns a file with the name of a standard shader of RISpec; empty if there is none, or if `shader` is no standard
  /// one.
  std::string fileOfStandardName(const TmShader& shader, const std::string& searchPath,
                                 const std::string& beside) const;
  /// Returns the shader of that file if it has parameters that ours lacks: then it is another shader, and the scene
  /// beside it means that one. Otherwise returns ours.
  const TmShader* ofStandardName(const TmShader& ours, const std::string& searchPath, const std::string& beside);
  const TmShader* known(const std::string& name, TmKind kind) const {
    const auto it = shaders.find({kind, name});
    return it == shaders.end() ? nullptr : it->second;
  }
};

}  // namespace tomales
