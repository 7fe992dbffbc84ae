#include "reyes/bindings/assimp/model_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <assimp/Importer.hpp>

#include "reyes/base/text.h"
#include "reyes/bindings/assimp/plain_gltf.h"
#include "reyes/bindings/assimp/scene_file.h"

namespace tomales::model {
namespace {

/// The files of a model as Assimp gets them.
class ModelFiles : public Assimp::DefaultIOSystem {
 public:
  ModelFiles(const std::string& model, const PlainGltf& gltf) : model_(model), gltf_(gltf) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const std::string name = file;
    if (name == model_ && !gltf_.bytes.empty()) return streamOf(gltf_.bytes);
    if (name.ends_with(kFloatsFile) && !gltf_.floats.empty()) return streamOf(gltf_.floats);
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  static Assimp::IOStream* streamOf(const std::string& bytes) {
    return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  }

  const std::string& model_;
  const PlainGltf& gltf_;
};

void tellOfExtensions(const PlainGltf& gltf, const SourceLoc& where, Log& log) {
  if (gltf.leftOut.empty()) return;
  const std::string required =
      gltf.required.empty() ? ""
                            : fmt::format("; the file asks not to be read without {}", fmt::join(gltf.required, ", "));
  log.report(Severity::Warning, "import-extension", where,
             fmt::format("extensions of glTF are left out: {}{}", fmt::join(gltf.leftOut, ", "), required));
}

}  // namespace

void importModel(const Settings& settings, Log& log) {
  const SourceLoc where{std::make_shared<const std::string>(settings.model), 0};
  const std::string ending = endingOf(settings.model);
  const PlainGltf gltf = ending == ".gltf" || ending == ".glb" ? plainGltf(settings.model) : PlainGltf();
  tellOfExtensions(gltf, where, log);
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetIOHandler(new ModelFiles(settings.model, gltf));  // which it deletes
  const aiScene* scene = importer.ReadFile(settings.model, aiProcess_ValidateDataStructure);
  if (scene && scene->mRootNode) return writeScene(*scene, settings, log);
  log.report(Severity::Error, "import-unreadable", where, std::string("cannot be read: ") + importer.GetErrorString());
}

}  // namespace tomales::model
