// Lookups in pictures through OpenImageIO's texture system. Private to the module.
#pragma once
#include "reyes/pictures.h"

namespace tomales {

std::unique_ptr<TextureCache> makeTextureCache(const TextureSettings& settings);

}  // namespace tomales
