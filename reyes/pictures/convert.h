// Pictures to tiled MIP files, and where those of the cache are. Private to the module.
#pragma once
#include <OpenImageIO/imagebuf.h>

#include <optional>

#include "reyes/pictures.h"

namespace tomales {

/// PictureLibrary::makeTexture.
bool convert(const TextureRecipe& recipe, std::string& error);

/// Six faces as one latitude-longitude picture that resolves them everywhere.
std::optional<OIIO::ImageBuf> unfoldCube(const TextureRecipe& recipe, std::string& error);

/// The tiled MIP file that stands for a picture: itself, or its conversion in `folder`, made now if need be. Empty:
/// unreadable.
std::string tiledFile(const std::string& picture, const std::string& folder, std::string& error);

}  // namespace tomales
