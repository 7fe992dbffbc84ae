#include <dlfcn.h>

#include "reyes/pictures.h"

namespace tomales {

const PictureLibrary* pictureLibrary(std::string& error) {
  struct Loaded {
    const PictureLibrary* library = nullptr;
    std::string error;
    Loaded() {
      // Found by the run path of the program (CMakeLists.txt), and never closed: textures are in use until the end.
      void* handle = dlopen("libtomales_openimageio.so", RTLD_LAZY | RTLD_LOCAL);
      using Function = const PictureLibrary* (*)();
      const auto function = handle ? reinterpret_cast<Function>(dlsym(handle, "tomalesPictureLibrary")) : nullptr;
      if (function)
        library = function();
      else
        error = dlerror();
    }
  };
  static const Loaded loaded;
  if (!loaded.library) error = loaded.error;
  return loaded.library;
}

bool makeTexture(const TextureRecipe& recipe, std::string& error) {
  const PictureLibrary* library = pictureLibrary(error);
  return library && library->makeTexture(recipe, error);
}

std::unique_ptr<PictureReader> openPicture(const std::string& path, std::string& error) {
  const PictureLibrary* library = pictureLibrary(error);
  return library ? library->open(path, error) : nullptr;
}

}  // namespace tomales
