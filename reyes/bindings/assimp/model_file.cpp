#include "reyes/bindings/assimp/model_file.h"

#include <assimp/postprocess.h>

#include <assimp/Importer.hpp>

#include "reyes/bindings/assimp/scene_file.h"

namespace tomales::model {

void importModel(const Settings& settings, Log& log) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = importer.ReadFile(settings.model, aiProcess_ValidateDataStructure);
  if (scene && scene->mRootNode) return writeScene(*scene, settings, log);
  log.report(Severity::Error, "import-unreadable", {std::make_shared<const std::string>(settings.model), 0},
             std::string("cannot be read: ") + importer.GetErrorString());
}

}  // namespace tomales::model
