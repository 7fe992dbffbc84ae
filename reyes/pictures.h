// Noun: pictures that are read, through the interface of a module over OpenImageIO. That library brings 260 shared
// libraries along, which cost 0.15 to 0.25 s to link and are not needed to render a scene without textures. So the
// module (reyes/pictures/module.cpp) is loaded when something is first asked of it. Pictures are written by
// reyes/image. Threads: calls may be concurrent, except for those of one reader.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reyes/base/log.h"
#include "reyes/base/math.h"
#include "reyes/shader_api.h"

namespace tomales {

struct PictureShape {
  int x = 0, y = 0, width = 0, height = 0;  ///< The data window.
  int fullWidth = 0, fullHeight = 0;        ///< The display window, which begins at (0, 0).
  std::vector<std::string> channels;
};

class PictureReader {
 public:
  virtual ~PictureReader() = default;
  virtual const PictureShape& shape() const = 0;
  virtual bool deep() const = 0;
  /// Reads 16 floats as the file stores them. Returns false if the file has no such matrix.
  virtual bool matrix(const char* name, float* out) const = 0;
  /// Reads a text of the header. Empty if there is none of that name.
  virtual std::string text(const char* name) const = 0;
  /// Reads two floats in the same way.
  virtual bool pair(const char* name, float* out) const = 0;
  /// Reads channels [first, end) of all pixels, interleaved. Returns false on failure, and error() says why.
  virtual bool read(int first, int end, float* out) = 0;
  /// Reads the number of samples of each pixel, then all their channels. Returns false as read() does.
  virtual bool readDeep(std::vector<uint32_t>& counts, std::vector<float>& values) = 0;
  virtual std::string error() const = 0;
};

/// The texels that a batch asks for: a parallelogram around each (s[i], t[i]), with edges (su, tu) and (sv, tv).
struct TextureQuery {
  const char* name;  ///< <UDIM> or _MAPID_ stands for 1001 + floor(s) + 10 floor(t).
  int channel = 0, channels = 3;
  float fill = 0;                ///< Value of channels that the picture lacks.
  const char* filter = "";       ///< "", box, disk and lerp are bilinear; others are cubic where texels are magnified.
  float sWidth = 1, tWidth = 1;  ///< Factors of the region's size; 0 looks up a point of the finest level.
  float sBlur = 0, tBlur = 0;    ///< Widen the region by a fraction of the picture.
  int count = 0;
  const uint8_t* active = nullptr;
  const float *s = nullptr, *t = nullptr;
  const float *su = nullptr, *tu = nullptr, *sv = nullptr, *tv = nullptr;  ///< All are null if it asks for points.
  bool latlong = false;  ///< The left and right edges join; beyond the top and the bottom, the edge goes on.
};

struct TextureSettings {
  std::string searchPath{};   ///< Folders, separated by colons.
  std::string cacheFolder{};  ///< Where converted pictures are kept; if empty: $TOMALES_TEXTURE_CACHE or the user's
                              ///< cache folder.
  int64_t memory_bytes = int64_t{1} << 30;
  /// Is told which file in the folder was damaged and is made anew. Any thread may call it.
  std::function<void(const std::string& what)> note{};
};

/// Extensions of textures, also those that other renderers make. The best ones to read come first.
inline const std::vector<std::string>& textureEndings() {
  static const std::vector<std::string> endings = {".tif", ".tiff", ".exr", ".png", ".jpg", ".jpeg",
                                                   ".hdr", ".tga",  ".tx",  ".tex", ".txr", ".tdl"};
  return endings;
}
/// Extensions of textures and of other maps.
inline const std::vector<std::string>& pictureEndings() {
  static const std::vector<std::string> endings = [] {
    std::vector<std::string> out = textureEndings();
    out.insert(out.end(), {".shd", ".env", ".z"});
    return out;
  }();
  return endings;
}

struct TextureFigures {
  int64_t tileRequests = 0, tileMisses = 0, bytesRead = 0;
};

/// Pictures by name, for one frame. A picture that is rewritten while no cache is open is read anew by the next cache.
/// One that is not a tiled MIP file yet becomes one at its first use, in a folder where files are named by content, so
/// that none is converted twice. Coordinates: s runs right, t down the picture, 0..1 (RISpec 15.7).
class TextureCache {
 public:
  virtual ~TextureCache() = default;
  /// Fills out.x (and y, z for three channels) and counts lookups. If the picture is missing or unreadable, another of
  /// candidateFiles() is taken. Returns false if nothing was read; `remark` then says why. If another file was taken,
  /// `remark` says which and why. Otherwise `remark` is left alone.
  virtual bool lookup(const TextureQuery& query, TmVec3 out, int64_t& lookups, std::string& remark) = 0;
  /// RSL textureinfo(): exists, resolution, channels, bitsperchannel, viewingmatrix, projectionmatrix into `numbers`,
  /// type and textureformat into `text`. Returns false if there is no such picture or no such fact.
  virtual bool info(const std::string& name, const std::string& what, std::vector<float>& numbers,
                    std::string& text) = 0;
  /// Returns the figures that all caches have counted since the last call. All caches of the process share their tiles.
  virtual TextureFigures takeFigures() = 0;
};

/// The result of making a file of pictures. An unreadable picture is reported as something missing, and an unwritable
/// file as a failed output.
enum class Making { Done, Unreadable, Unwritable };
inline Severity severityOf(Making made) {
  return made == Making::Done ? Severity::Info : made == Making::Unreadable ? Severity::Missing : Severity::Output;
}

/// The texture file that MakeTexture or a similar request makes of pictures.
struct TextureRecipe {
  enum class Shape { Picture, LatLong, Cube } shape = Shape::Picture;
  std::vector<std::string> pictures;  ///< One picture; for a Cube px nx py ny pz nz.
  std::string file;
  std::string sWrap = "black", tWrap = "black";  ///< black, clamp, periodic, mirror
  std::string filter = "box";                    ///< Filter that makes the MIP levels.
  float fov_degrees = 90;                        ///< Field of view of the faces of a Cube.
  bool greyAsColor = false;                      ///< A Picture of grey and alpha gets red, green and blue instead.
};
class PictureLibrary {
 public:
  virtual ~PictureLibrary() = default;
  /// Returns null on failure, and `error` says why.
  virtual std::unique_ptr<PictureReader> open(const std::string& path, std::string& error) const = 0;
  virtual std::unique_ptr<TextureCache> textures(const TextureSettings& settings) const = 0;
  /// The file appears only when it is whole. A cube becomes a latitude-longitude picture, which is what environment
  /// lookups read. Unless the result is Done, `error` says why, and no file is left behind.
  virtual Making makeTexture(const TextureRecipe& recipe, std::string& error) const = 0;
};

/// Loads the module. Returns null if it cannot be loaded, and `error` says why.
const PictureLibrary* pictureLibrary(std::string& error);
/// Calls PictureLibrary::makeTexture.
Making makeTexture(const TextureRecipe& recipe, std::string& error);
/// Calls PictureLibrary::open. Returns null on failure, and `error` says why.
std::unique_ptr<PictureReader> openPicture(const std::string& path, std::string& error);

/// Returns the name of an attribute as OpenEXR spells it.
std::string exrAttributeName(const std::string& name);

/// Attribute of deep pictures: the width and height, in pixels, of the region whose depths a pixel holds.
inline constexpr const char* kSampleRegion = "sampleregion";

/// The camera that a picture of a Display of type "shadow", "zfile" or "deepshad" describes, and its depth channel.
struct DepthCamera {
  mat4 cameraFromWorld{1.0f};
  mat4 ndcFromWorld{1.0f};  ///< Homogeneous, -1..1, y up.
  int depth = 0;            ///< Number of the depth channel.
};
std::optional<DepthCamera> depthCameraOf(const PictureReader& picture);

}  // namespace tomales
