// Private to the OpenEXR files: a writer for existing headers, such as those of tiles.
#pragma once
#include <OpenEXR/ImfHeader.h>

#include "reyes/image/format_writer.h"

namespace tomales {

/// Each header is one part of the file. All their channels are channels of `shape`, and no two parts share one.
std::unique_ptr<FormatWriter> openExrOf(const std::string& path, const Image& shape, std::vector<Imf::Header> headers);

}  // namespace tomales
