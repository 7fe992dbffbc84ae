// Private to reyes/image: the only function of the module over libtiff.
#pragma once
#include "reyes/image/format_writer.h"

namespace tomales {

/// See PictureFormat::open.
using OpenTiff = std::unique_ptr<FormatWriter>(const std::string& path, const Image& shape, const FileFormat& format);

}  // namespace tomales
