// Private to reyes/image: pixels to and from files, whatever their format.
#pragma once
#include "reyes/image.h"

namespace tomales {

enum class SampleType { Half, Float, UInt8, UInt16 };

struct FileFormat {
  std::string name;                     ///< "openexr", "tiff", "png"
  SampleType type = SampleType::Float;  ///< Integer types: pixels hold integers already, 0..255 or 0..65535.
  bool unassociatedAlpha = false;       ///< Colour has been divided by alpha.
};

/// Format of a file by its name's extension; empty name: none that can be written.
FileFormat formatOfExtension(const std::string& path);

/// To a temporary name in the same directory, then renamed. False: nothing was left behind, `error` says why.
bool writeFile(const std::string& path, const Image& image, const FileFormat& format, std::string& error);

/// IEC 61966-2-1 transfer of one linear value, clamped to [0,1].
float encodeSrgb(float linear);

}  // namespace tomales
