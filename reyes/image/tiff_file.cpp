#include <fmt/format.h>

#include <stdexcept>

#include "reyes/base/module.h"
#include "reyes/image/tiff_module.h"

namespace tomales {
namespace {

std::unique_ptr<FormatWriter> openTiff(const std::string& path, const Image& shape, const FileFormat& format) {
  static const ModuleFunction<OpenTiff> open("libtomales_tiff.so", "tomalesOpenTiff");
  if (!open.call) throw std::runtime_error(fmt::format("the module that writes TIFF cannot be loaded: {}", open.error));
  return open.call(path, shape, format);
}

}  // namespace

const PictureFormat& tiffFormat() {
  static const PictureFormat row = {.name = "tiff",
                                    .title = "TIFF",
                                    .types = {"tif"},
                                    .extensions = {".tif", ".tiff"},
                                    .compressions = {"none", "rle", "zip", "zips", "lzw"},
                                    .floats = true,
                                    .quantises = true,
                                    .open = openTiff};
  return row;
}

}  // namespace tomales
