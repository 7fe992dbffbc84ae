// Private to reyes/image: the table of picture formats. Each format's row is beside its writer.
#pragma once
#include <span>
#include <string_view>

#include "reyes/image/image_file.h"
#include "reyes/image_files.h"

namespace tomales {

class FormatWriter;

using Words = std::vector<std::string_view>;

struct PictureFormat {
  const char* name;           ///< The type of a Display that asks for it.
  const char* title;          ///< Used in messages.
  Words types = {};           ///< Other types of Displays that ask for it.
  Words extensions = {};      ///< Extensions of file names, with the dot.
  Words compressions = {};    ///< Compressions that a Display may ask for.
  Words params = {};          ///< Parameters of a Display for this format alone; "x_*": all that begin with x_.
  bool floats = false;        ///< It can hold floating point numbers.
  bool quantises = false;     ///< It holds integers where Quantize asks for them, or always.
  bool dividesColor = false;  ///< Its colours have been divided by alpha.
  bool carriesNames = false;  ///< It holds named texts, matrices, Cryptomatte and deep pixels.
  bool isForScreens = false;  ///< True if programs that open it expect colours that are encoded for a screen.
  /// `shape` is the whole picture, without pixels. For integer types, pixels hold integers already. Throws
  /// std::exception.
  std::unique_ptr<FormatWriter> (*open)(const std::string& path, const Image& shape,
                                        const FileFormat& format) = nullptr;

  SampleType usualType() const { return quantises ? SampleType::UInt8 : SampleType::Float; }
  bool takes(std::string_view param) const;
};

/// The first format is used for names without an extension, and for data that only formats with carriesNames hold.
std::span<const PictureFormat* const> pictureFormats();
/// Returns the format of pictures for display drivers, which is not in the table.
const PictureFormat& driverFormat();
/// Returns null if there is none.
const PictureFormat* formatOfType(std::string_view displayType);
const PictureFormat* formatOfExtension(const std::string& path);
/// Tells whether some format takes this parameter of a Display.
bool anyFormatTakes(std::string_view param);
/// Returns the titles of formats that hold floating point numbers: "OpenEXR or TIFF".
std::string floatFormats();

}  // namespace tomales
