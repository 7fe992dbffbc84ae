#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "reyes/base/input_file.h"
#include "reyes/base/module.h"
#include "reyes/pictures.h"
#include "reyes/pictures/exr_reader.h"

namespace tomales {
const PictureLibrary* pictureLibrary(std::string& error) {
  static const ModuleFunction<const PictureLibrary*()> library("libtomales_openimageio.so", "tomalesPictureLibrary");
  if (library.call) return library.call();
  error = library.error;
  return nullptr;
}

Making makeTexture(const TextureRecipe& recipe, std::string& error) {
  const PictureLibrary* library = pictureLibrary(error);
  return library ? library->makeTexture(recipe, error) : Making::Unreadable;
}

std::unique_ptr<PictureReader> openPicture(const std::string& path, std::string& error) {
  error = inputProblem(path);
  if (!error.empty()) return nullptr;
  if (auto exr = openExrPicture(path, error); exr || !error.empty()) return exr;
  const PictureLibrary* library = pictureLibrary(error);
  return library ? library->open(path, error) : nullptr;
}

std::string exrAttributeName(const std::string& name) {
  return name == "worldtocamera" ? "worldToCamera" : name == "worldtoscreen" ? "worldToScreen" : name;
}

std::optional<DepthCamera> depthCameraOf(const PictureReader& picture) {
  const auto& channels = picture.shape().channels;
  DepthCamera out;
  out.depth = static_cast<int>(std::find(channels.begin(), channels.end(), "Z") - channels.begin());
  // RenderMan's matrices act on rows from the right and are stored by rows: that is glm's storage.
  const bool whole = picture.matrix("worldtocamera", glm::value_ptr(out.cameraFromWorld)) &&
                     picture.matrix("worldtoscreen", glm::value_ptr(out.ndcFromWorld));
  return whole && out.depth < static_cast<int>(channels.size()) ? std::optional(out) : std::nullopt;
}

}  // namespace tomales
