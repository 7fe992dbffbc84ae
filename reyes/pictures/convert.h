// Private to the module: converts pictures to tiled MIP files, and finds those in the cache.
#pragma once
#include <OpenImageIO/imagebuf.h>

#include <optional>

#include "reyes/pictures.h"

namespace tomales {

/// Does what PictureLibrary::makeTexture does.
Making convert(const TextureRecipe& recipe, std::string& error);

/// Reads all texels of a file. Returns false on failure, and `error` says why.
bool readWhole(const std::string& file, OIIO::ImageBuf& picture, std::string& error);

/// Makes one latitude-longitude picture of six faces, fine enough to resolve them everywhere.
std::optional<OIIO::ImageBuf> unfoldCube(const TextureRecipe& recipe, std::string& error);

/// Returns the tiled MIP file of a picture: the picture itself, or its conversion in `folder`, which is made now if
/// need be. Returns an empty name if it is unreadable. `note` names a damaged conversion that was made again.
std::string tiledFile(const std::string& picture, const std::string& folder, std::string& error, std::string& note);

}  // namespace tomales
