// Pictures of a model as textures beside the RIB. Threads: plain object.
#pragma once
#include <assimp/scene.h>

#include <map>
#include <string>

#include "reyes/base/log.h"
#include "reyes/bindings/assimp/parts.h"

namespace tomales::model {

class Textures {
 public:
  Textures(const aiScene& scene, const Settings& settings, Parts& parts, Log& log)
      : scene_(scene), settings_(settings), parts_(parts), log_(log) {}

  /// Returns the name in the RIB of the picture that a material calls `name`, which is in the model file itself or
  /// beside it. The picture is converted here, because untiled pictures do not wrap (docs/shader_writing.md). Returns
  /// an empty name if it is missing or unreadable, which is reported.
  std::string file(const std::string& name, aiTextureMapMode sWrap, aiTextureMapMode tWrap);

 private:
  std::string convert(const std::string& name, const char* sWrap, const char* tWrap);
  std::string pictureOf(const std::string& name) const;

  const aiScene& scene_;
  const Settings& settings_;
  Parts& parts_;
  Log& log_;
  std::map<std::string, std::string> made_;
};

}  // namespace tomales::model
