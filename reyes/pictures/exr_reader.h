// Private to reyes/pictures: reads OpenEXR files without OpenImageIO's libraries, for frames that read their shadow
// maps again.
#pragma once
#include "reyes/pictures.h"

namespace tomales {

/// Returns null without `error` for a file that is not OpenEXR, or not a single part of scanlines, tiles or deep
/// scanlines of floats: OpenImageIO reads those. Returns null with `error` if the file is damaged.
std::unique_ptr<PictureReader> openExrPicture(const std::string& path, std::string& error);

}  // namespace tomales
