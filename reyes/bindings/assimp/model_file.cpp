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
#include <exception>

#include "reyes/base/text.h"
#include "reyes/bindings/assimp/file_content.h"
#include "reyes/bindings/assimp/mtl.h"
#include "reyes/bindings/assimp/plain_gltf.h"
#include "reyes/bindings/assimp/plain_off.h"
#include "reyes/bindings/assimp/scene_file.h"

namespace tomales::model {
namespace {

/// What Assimp asks for beside the model.
struct Companions {
  MtlMaterials materials;            ///< Those of the files of materials that an .obj names.
  std::vector<std::string> missing;  ///< The files of materials that are not there.
  std::string instead;               ///< The one that Assimp reads in place of the last of them.
};

/// The files of a model as Assimp gets them.
class ModelFiles : public Assimp::DefaultIOSystem {
 public:
  /// `companions` is filled as Assimp asks for files.
  ModelFiles(const std::string& model, const PlainGltf& gltf, Companions& companions)
      : model_(model), ending_(endingOf(model)), gltf_(gltf), companions_(companions) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const std::string name = file;
    if (name == model_ && !gltf_.bytes.empty()) return streamOf(gltf_.bytes);
    if (name.ends_with(kFloatsFile) && !gltf_.floats.empty()) return streamOf(gltf_.floats);
    if (name == model_ && ending_ == ".off") return streamOf(texts_.emplace_back(plainOff(contentOf(name))));
    if (name == model_ || ending_ != ".obj") return DefaultIOSystem::Open(file, mode);
    if (!Exists(file)) {
      companions_.missing.push_back(name);
      return nullptr;
    }
    if (!companions_.missing.empty()) companions_.instead = name;
    return streamOf(texts_.emplace_back(plainMtl(contentOf(name), companions_.materials)));
  }

 private:
  static Assimp::IOStream* streamOf(const std::string& bytes) {
    return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  }

  const std::string& model_;
  const std::string ending_;
  const PlainGltf& gltf_;
  Companions& companions_;
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

/// After a file that is not there, Assimp tries the .mtl of the model's own name. So the first is what the model names.
void tellOfMissing(const Companions& companions, const SourceLoc& where, Log& log) {
  if (companions.missing.empty()) return;
  const std::string otherwise =
      companions.instead.empty() ? "its materials are grey" : fmt::format("\"{}\" is read instead", companions.instead);
  log.report(Severity::Missing, "import-texture", where,
             fmt::format("the file of materials \"{}\" is not there; {}", companions.missing.front(), otherwise));
}

}  // namespace

void importModel(const Settings& settings, Log& log) {
  const SourceLoc where{std::make_shared<const std::string>(settings.model), 0};
  const std::string ending = endingOf(settings.model);
  const PlainGltf gltf = ending == ".gltf" || ending == ".glb" ? plainGltf(settings.model) : PlainGltf();
  tellOfGltf(gltf, where, log);
  Companions companions;
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetIOHandler(new ModelFiles(settings.model, gltf, companions));  // which it deletes
  const aiScene* scene = importer.ReadFile(settings.model, aiProcess_ValidateDataStructure);
  tellOfMissing(companions, where, log);
  if (scene && scene->mRootNode) return writeScene(*scene, settings, companions.materials, log);
  if (importer.GetException()) std::rethrow_exception(importer.GetException());
  log.report(Severity::Error, "import-unreadable", where, std::string("cannot be read: ") + importer.GetErrorString());
}

}  // namespace tomales::model
