// Private to reyes/pictures: OpenEXR files without OpenImageIO's libraries, since frames read their shadow maps again.
#pragma once
#include "reyes/pictures.h"

namespace tomales {

/// Null without `error`: no OpenEXR file, or one that is not a single part of scanlines, tiles or deep scanlines of
/// floats, which are OpenImageIO's. Null with `error`: it is damaged.
std::unique_ptr<PictureReader> openExrPicture(const std::string& path, std::string& error);

}  // namespace tomales
