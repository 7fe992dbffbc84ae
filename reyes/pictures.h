// Noun: pictures in files, as a library behind a door sees them. OpenImageIO brings 260 shared libraries along, which cost 0.15 s
// to link and are not needed to render a scene to OpenEXR: so it lives in a module of its own (reyes/pictures/module.cpp) that is
// loaded when something is first asked of it.
// Threads: concurrent calls are safe, but for those of one reader or writer.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reyes/shader_api.h"

namespace tomales {

struct PictureShape {
  int x = 0, y = 0, width = 0, height = 0;  ///< The data window,
  int fullWidth = 0, fullHeight = 0;        ///< inside the display window, which begins at (0, 0).
  std::vector<std::string> channels;
};

class PictureReader {
 public:
  virtual ~PictureReader() = default;
  virtual const PictureShape& shape() const = 0;
  virtual bool deep() const = 0;
  /// 16 floats, as the file stores them. False: it has no such matrix.
  virtual bool matrix(const char* name, float* out) const = 0;
  /// Channels [first, end) of all pixels, interleaved. False: error() says why.
  virtual bool read(int first, int end, float* out) = 0;
  /// How many samples each pixel has, then all their channels. False: error() says why.
  virtual bool readDeep(std::vector<uint32_t>& counts, std::vector<float>& values) = 0;
  virtual std::string error() const = 0;
};

enum class PixelType { UInt8, UInt16, Float };

struct PictureFormat {
  std::string name;  ///< "tiff", "png"
  PixelType type = PixelType::UInt8;
  bool unassociatedAlpha = false;
  std::string compression;
};

class PictureWriter {
 public:
  virtual ~PictureWriter() = default;
  /// Rows [y0, y1), pixels of the format's type. False: error() says why; likewise below.
  virtual bool write(int y0, int y1, const void* pixels) = 0;
  virtual bool close() = 0;
  virtual std::string error() const = 0;
};

/// Which texels a batch asks for: (s[i], t[i]) over a box of (width, height), all in 0..1 of the picture.
struct TextureQuery {
  const char* name;
  int channel, channels;
  int count;
  const uint8_t* active;
  const float *s, *t, *width, *height;
  bool latlong = false;  ///< The left and right edge join; beyond top and bottom lies the edge.
};

class TextureCache {
 public:
  virtual ~TextureCache() = default;
  /// Fills out.x (and y, z for three channels) and counts lookups. False: unreadable, `error` says why.
  virtual bool lookup(const TextureQuery& query, TmVec3 out, int64_t& lookups, std::string& error) = 0;
};

class PictureLibrary {
 public:
  virtual ~PictureLibrary() = default;
  /// Null: `error` says why; likewise below.
  virtual std::unique_ptr<PictureReader> open(const std::string& path, std::string& error) const = 0;
  virtual std::unique_ptr<PictureWriter> create(const std::string& path, const PictureShape& shape, const PictureFormat& format,
                                                std::string& error) const = 0;
  /// `searchPath`: colon-separated folders. `cache_MB`: of tiles in memory.
  virtual std::unique_ptr<TextureCache> textures(const std::string& searchPath, float cache_MB) const = 0;
};

/// Loads the module. Null: it cannot be loaded; `error` says why.
const PictureLibrary* pictureLibrary(std::string& error);
/// A file's reader. Null: `error` says why.
std::unique_ptr<PictureReader> openPicture(const std::string& path, std::string& error);

}  // namespace tomales
