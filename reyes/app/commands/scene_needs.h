// The files and shaders that a scene needs.
#pragma once
#include <map>
#include <set>

#include "reyes/app/commands/shader_info.h"
#include "reyes/rib.h"

namespace tomales {

class SceneNeeds {
 public:
  SceneNeeds(const PluginTrust& trust, Log& log);

  void add(const FileUse& file);
  /// Adds the file that a Make request writes, which is found when a later frame asks for it.
  void addMade(const Request& request);
  /// Adds shaders of the scene and the pictures that their parameters name. Procedurals are opened one after the other.
  void add(const Scene& scene);
  /// Returns an array of objects with kind, name, found, and path; a missing one has the place that names it and a
  /// hint.
  Json json() const;

 private:
  struct Need {
    bool found = false;
    std::string from;  ///< The path or, if it is missing, the place that names it.
    std::string hint;
  };
  void add(const Attributes& attributes, const Scene& scene);
  void add(const Scene& scene, const std::vector<Procedural>& procedurals);
  void addShader(const ShaderCall& call, TmKind kind, const Options& options);
  void addPictures(const ShaderCall& call, const TmShader* shader, const Options& options);
  void addPicture(const std::string& name, const Options& options, const SourceLoc& where);

  static constexpr int kMostProcedurals = 10000;  ///< Further ones stay closed: a scene may have millions.
  ShaderRegistry registry_;
  std::map<std::pair<std::string, std::string>, Need> needs_;  ///< Indexed by kind and name.
  std::set<std::string> made_;                                 ///< Files that the scene itself writes.
  std::set<const ShaderCall*> seen_;
  std::set<const Attributes*> attributes_;
  int opened_ = 0;
};

}  // namespace tomales
