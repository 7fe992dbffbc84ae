// Verbs: whole pictures in files, of any format, besides those that a frame writes (reyes/image.h:DisplayFile).
#pragma once
#include <array>
#include <map>

#include "reyes/image.h"

namespace tomales {

/// Writes a picture in the format of its extension. Colours are encoded as sRGB if `srgb` is set and the format holds
/// integers. Returns false, after a report, if it cannot be written.
bool writeImage(const std::string& path, const Image& image, bool srgb, Log& log);
/// Tells whether the name's extension stands for a format that can be written.
bool namesPicture(const std::string& path);
/// Tells whether the extension stands for a format whose readers expect colours that are encoded for a screen.
bool isForScreens(const std::string& path);

/// A format of pictures: what a Display and the name of its file may say of it.
struct DisplayFormat {
  std::string type, title;
  std::vector<std::string> otherTypes, extensions, compressions, parameters;
};
std::vector<DisplayFormat> displayFormats();
std::string pictureExtensions();  ///< The extensions of all formats, for messages: "exr, tif, png".
std::string pictureNames();       ///< The form of names of pictures, for help: "FILE.exr|.tif|.png".

/// Reads a picture of any format. If it cannot be read, returns nothing, and a sentence in `error`.
std::optional<Image> readImage(const std::string& path, std::string& error);

/// Joins OpenEXR pictures of crop windows of one frame to the file that the whole frame would have written, with its
/// parts, channels, deep pixels and headers. `crop` is the frame's own crop window. Throws FileError if they are not of
/// one frame, leave pixels out or differ where they overlap, and WriteError.
void joinPictures(const std::vector<std::string>& crops, const std::string& output,
                  const std::optional<std::array<float, 4>>& crop);
/// Reads the channels of all parts of an OpenEXR file, which have the window of the first. Throws FileError.
Image readParts(const std::string& picture);
/// Copies an OpenEXR file with all its parts, channels and headers, and every bit of what is not changed. Channels that
/// `by` has are taken from there, and texts of headers are set, or removed where they are empty. Pre: `by` has the size
/// of the picture. Throws FileError and WriteError.
void replaceChannels(const std::string& picture, const std::string& output, const Image& by,
                     const std::map<std::string, std::string>& texts);

}  // namespace tomales
