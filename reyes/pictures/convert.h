// Pictures to tiled MIP files, and where those of the cache are. Private to the module.
#pragma once
#include <OpenImageIO/imagebuf.h>

#include <optional>

#include "reyes/pictures.h"

namespace tomales {

/// PictureLibrary::makeTexture.
Making convert(const TextureRecipe& recipe, std::string& error);

/// All texels of a file. False: `error` says why.
bool readWhole(const std::string& file, OIIO::ImageBuf& picture, std::string& error);

/// Six faces as one latitude-longitude picture that resolves them everywhere.
std::optional<OIIO::ImageBuf> unfoldCube(const TextureRecipe& recipe, std::string& error);

/// The tiled MIP file that stands for a picture: itself, or its conversion in `folder`, made now if need be. Empty:
/// unreadable. `note`: what had to be made anew because it was damaged.
std::string tiledFile(const std::string& picture, const std::string& folder, std::string& error, std::string& note);

}  // namespace tomales
