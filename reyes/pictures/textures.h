// Private to the module: lookups in pictures through OpenImageIO's texture system.
#pragma once
#include "reyes/pictures.h"

namespace tomales {

std::unique_ptr<TextureCache> makeTextureCache(const TextureSettings& settings);

}  // namespace tomales
