// Private to the OpenEXR files: a writer for headers that exist already, as those of tiles do.
#pragma once
#include <OpenEXR/ImfHeader.h>

#include "reyes/image/format_writer.h"

namespace tomales {

/// Each of the headers is one part of the file. Every channel of them is one of `shape`, and no two parts share one.
std::unique_ptr<FormatWriter> openExrOf(const std::string& path, const Image& shape, std::vector<Imf::Header> headers);

}  // namespace tomales
