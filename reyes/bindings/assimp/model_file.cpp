#include "reyes/bindings/assimp/model_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <deque>

#include "reyes/base/text.h"
#include "reyes/bindings/assimp/file_content.h"
#include "reyes/bindings/assimp/mtl.h"
#include "reyes/bindings/assimp/plain_gltf.h"
#include "reyes/bindings/assimp/plain_off.h"
#include "reyes/bindings/assimp/scene_file.h"

namespace tomales::model {
namespace {

/// The files of a model as Assimp gets them.
class ModelFiles : public Assimp::DefaultIOSystem {
 public:
  /// `materials` is filled as Assimp reads the files of materials that an .obj names.
  ModelFiles(const std::string& model, const PlainGltf& gltf, MtlMaterials& materials)
      : model_(model), ending_(endingOf(model)), gltf_(gltf), materials_(materials) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const std::string name = file;
    if (name == model_ && !gltf_.bytes.empty()) return streamOf(gltf_.bytes);
    if (name.ends_with(kFloatsFile) && !gltf_.floats.empty()) return streamOf(gltf_.floats);
    if (name == model_ && ending_ == ".off") return streamOf(texts_.emplace_back(plainOff(contentOf(name))));
    if (name != model_ && ending_ == ".obj" && Exists(file))
      return streamOf(texts_.emplace_back(plainMtl(contentOf(name), materials_)));
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  static Assimp::IOStream* streamOf(const std::string& bytes) {
    return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  }

  const std::string& model_;
  const std::string ending_;
  const PlainGltf& gltf_;
  MtlMaterials& materials_;
  std::deque<std::string> texts_;  // Those that streams read from.
};

/// Tells whether a stranger's word may stand in a message.
bool isPlainName(const std::string& name) {
  constexpr size_t kLongest = 64;
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_');
  });
}

/// Lists the first of the names that are plain, and counts the others.
std::string listed(const std::vector<std::string>& names) {
  constexpr size_t kMost = 8;
  std::vector<std::string> out;
  for (const std::string& name : names)
    if (out.size() < kMost && isPlainName(name)) out.push_back(name);
  const size_t others = names.size() - out.size();
  if (out.empty()) return fmt::format("{} with odd names", others);
  return fmt::format("{}{}", fmt::join(out, ", "), others > 0 ? fmt::format(" and {} more", others) : "");
}

void tellOfGltf(const PlainGltf& gltf, const SourceLoc& where, Log& log) {
  if (gltf.isTooLarge)
    log.report(Severity::Warning, "import-coordinates", where,
               "vertices stored as integers are not understood here: as floats they would be far larger than the file");
  if (gltf.leftOut.empty()) return;
  const std::string required =
      gltf.required.empty() ? "" : "; the file asks not to be read without " + listed(gltf.required);
  log.report(Severity::Warning, "import-extension", where,
             fmt::format("extensions of glTF are left out: {}{}", listed(gltf.leftOut), required));
}

}  // namespace

void importModel(const Settings& settings, Log& log) {
  const SourceLoc where{std::make_shared<const std::string>(settings.model), 0};
  const std::string ending = endingOf(settings.model);
  const PlainGltf gltf = ending == ".gltf" || ending == ".glb" ? plainGltf(settings.model) : PlainGltf();
  tellOfGltf(gltf, where, log);
  MtlMaterials materials;
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetIOHandler(new ModelFiles(settings.model, gltf, materials));  // which it deletes
  const aiScene* scene = importer.ReadFile(settings.model, aiProcess_ValidateDataStructure);
  if (scene && scene->mRootNode) return writeScene(*scene, settings, materials, log);
  log.report(Severity::Error, "import-unreadable", where, std::string("cannot be read: ") + importer.GetErrorString());
}

}  // namespace tomales::model
