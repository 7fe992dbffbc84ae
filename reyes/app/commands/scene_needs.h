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
  /// What a Make request writes is there when a later frame asks for it.
  void addMade(const Request& request);
  /// Shaders of the scene and the pictures that their parameters name. Procedurals are opened one after the other.
  void add(const Scene& scene);
  /// An array of kind, name, found, and where it is; of what is missing, where it is named and what helps.
  Json json() const;

 private:
  struct Need {
    bool found = false;
    std::string from;  ///< Where it is, or where it is named.
    std::string hint;
  };
  void add(const Attributes& attributes, const Scene& scene);
  void add(const Scene& scene, const std::vector<Procedural>& procedurals);
  void addShader(const ShaderCall& call, TmKind kind, const Options& options);
  void addPictures(const ShaderCall& call, const TmShader* shader, const Options& options);
  void addPicture(const std::string& name, const Options& options, const SourceLoc& where);

  static constexpr int kMostProcedurals = 10000;  ///< That are opened: a scene may have millions.
  ShaderRegistry registry_;
  std::map<std::pair<std::string, std::string>, Need> needs_;  ///< By kind and name.
  std::set<std::string> made_;                                 ///< Files that the scene itself writes.
  std::set<const ShaderCall*> seen_;
  std::set<const Attributes*> attributes_;
  int opened_ = 0;
};

}  // namespace tomales
