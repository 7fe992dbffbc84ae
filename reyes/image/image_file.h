// Private to reyes/image: reads and writes pixels in files of any format.
#pragma once
#include "reyes/image.h"
#include "reyes/pictures.h"

namespace tomales {

enum class SampleType { Half, Float, UInt8, UInt16 };

/// A named text or list of numbers in a file's header.
struct Metadata {
  std::string name;
  std::string text;            ///< Empty if it is `numbers`.
  std::vector<float> numbers;  ///< 16 numbers are a matrix.
};

struct PictureFormat;

/// A picture for a plugin (reyes/display_driver.h) instead of a file.
struct DriverCall {
  std::string plugin;
  DisplayCall display;
  View view;
};

struct FileFormat {
  const PictureFormat* kind = nullptr;
  SampleType type = SampleType::Float;    ///< For integer types, pixels hold integers already, 0..255 or 0..65535.
  bool unassociatedAlpha = false;         ///< True if the colour has been divided by alpha.
  std::string compression = {};           ///< If empty, the format's best lossless one.
  int tile = 0;                           ///< Edge of a tile in pixels; 0 for scanlines.
  bool deep = false;                      ///< OpenEXR: a list of samples in every pixel.
  bool multipart = false;                 ///< OpenEXR: one part for each layer.
  std::vector<std::string> precise = {};  ///< Channels that stay float in a file of halves.
  std::vector<Metadata> metadata = {};
  float pixelAspect = 1;  ///< Width of a pixel over its height.
  std::optional<DriverCall> driver = {};
};

/// Writes a picture to an UnfinishedFile, which close() gives its name. A file that is not closed leaves nothing
/// behind. Pictures for drivers are not files.
class PictureFile {
 public:
  static constexpr int kBandRows = 64;

  PictureFile(const std::string& path, const Image& shape, const FileFormat& format);
  ~PictureFile();
  /// Write the next rows from the top. Pre: in all calls but the last their number is a multiple of kBandRows. Return
  /// false on failure, and error() says why.
  bool write(const Image& rows);
  bool write(const DeepRows& rows);
  /// Closes the picture, of which the share `finished` is done. If that is less than 1, the file gets the name of
  /// partialName(), and its header says so; a whole picture removes a file of that name.
  bool close(float finished = 1);
  const std::string& error() const;
  /// Returns the parameters of a Display that its driver has not read.
  std::vector<std::string> unread() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Copies a shadow map. Unless the result is Done, `error` says why.
Making copyShadowMap(const std::string& from, const std::string& to, std::string& error);

/// Returns the IEC 61966-2-1 transfer of one linear value, clamped to [0,1].
float encodeSrgb(float linear);

}  // namespace tomales
