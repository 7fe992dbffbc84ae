// Private to the OpenEXR writer: writes pictures of scanlines in one part, with ZIP compression. The files are the same
// as those of OpenEXR's own writer, which uses zlib (until 3.2); libdeflate takes half the time (docs/decisions/0090).
#pragma once
#include <OpenEXR/ImfHeader.h>

#include "reyes/image/format_writer.h"

namespace tomales {

/// `header` describes all channels of `shape`, with ZIP_COMPRESSION.
std::unique_ptr<FormatWriter> openExrRows(const std::string& path, const Image& shape, const Imf::Header& header);

}  // namespace tomales
