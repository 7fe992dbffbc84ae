// Noun: pictures that are read, as a library behind a door sees them. OpenImageIO brings 260 shared libraries along,
// which cost 0.15 to 0.25 s to link and are not needed to render a scene without textures: so it lives in a module of
// its own (reyes/pictures/module.cpp) that is loaded when something is first asked of it. Pictures are written by
// reyes/image. Threads: concurrent calls are safe, but for those of one reader.
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
  /// Two floats, likewise.
  virtual bool pair(const char* name, float* out) const = 0;
  /// Channels [first, end) of all pixels, interleaved. False: error() says why.
  virtual bool read(int first, int end, float* out) = 0;
  /// How many samples each pixel has, then all their channels. False: error() says why.
  virtual bool readDeep(std::vector<uint32_t>& counts, std::vector<float>& values) = 0;
  virtual std::string error() const = 0;
};

/// Which texels a batch asks for: a parallelogram around (s[i], t[i]), with edges (su, tu) and (sv, tv).
struct TextureQuery {
  const char* name;  ///< <UDIM> or _MAPID_ stands for 1001 + floor(s) + 10 floor(t).
  int channel = 0, channels = 3;
  float fill = 0;           ///< Of channels that the picture lacks.
  const char* filter = "";  ///< "", box, disk, lerp: bilinear between texels; others: cubic where texels are magnified.
  float sWidth = 1, tWidth = 1;  ///< Scale the region; 0 looks up a point of the finest level.
  float sBlur = 0, tBlur = 0;    ///< Widen it by a fraction of the picture.
  int count = 0;
  const uint8_t* active = nullptr;
  const float *s = nullptr, *t = nullptr;
  const float *su = nullptr, *tu = nullptr, *sv = nullptr, *tv = nullptr;  ///< All null: points.
  bool latlong = false;  ///< The left and right edge join; beyond top and bottom lies the edge.
};

struct TextureSettings {
  std::string searchPath{};   ///< Folders, by colons.
  std::string cacheFolder{};  ///< Of converted pictures; empty: $TOMALES_TEXTURE_CACHE, or the user's cache folder.
  int64_t memory_bytes = int64_t{1} << 30;
  std::function<void(const std::string& what)>
      note{};  ///< Is told what was damaged in the folder and is made anew; called by any thread.
};

/// Endings of names of textures, those of other renderers among them; the best to read first.
inline const std::vector<std::string>& textureEndings() {
  static const std::vector<std::string> endings = {".tif", ".tiff", ".exr", ".png", ".jpg", ".jpeg",
                                                   ".hdr", ".tga",  ".tx",  ".tex", ".txr", ".tdl"};
  return endings;
}
/// Endings of names of textures and of other maps.
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

/// Pictures by name, for one frame: what is rewritten while no cache is open is read anew by the next one. A picture
/// that is not a tiled MIP file yet becomes one at its first use, in a folder where files are named by content, so that
/// none is converted twice. Coordinates: s runs right, t down the picture, 0..1 (rispec-table section 10).
class TextureCache {
 public:
  virtual ~TextureCache() = default;
  /// Fills out.x (and y, z for three channels) and counts lookups. Where the picture is missing or unreadable another
  /// of candidateFiles() is taken. `remark` becomes why nothing was read (false), or which other was taken and why
  /// (true); else it is left alone.
  virtual bool lookup(const TextureQuery& query, TmVec3 out, int64_t& lookups, std::string& remark) = 0;
  /// RSL textureinfo(): exists, resolution, channels, bitsperchannel, viewingmatrix, projectionmatrix into `numbers`,
  /// type and textureformat into `text`. False: there is no such picture or no such fact.
  virtual bool info(const std::string& name, const std::string& what, std::vector<float>& numbers,
                    std::string& text) = 0;
  /// What has been counted since the last call, whichever cache was asked: all caches of the process share their tiles.
  virtual TextureFigures takeFigures() = 0;
};

/// How the making of a file out of pictures ended. Who cannot read is told of something missing, who cannot write has
/// no output.
enum class Making { Done, Unreadable, Unwritable };
inline Severity severityOf(Making made) {
  return made == Making::Done ? Severity::Info : made == Making::Unreadable ? Severity::Missing : Severity::Output;
}

/// A texture file to be made of pictures: MakeTexture and its kin.
struct TextureRecipe {
  enum class Shape { Picture, LatLong, Cube } shape = Shape::Picture;
  std::vector<std::string> pictures;  ///< One; Cube: px nx py ny pz nz.
  std::string file;
  std::string sWrap = "black", tWrap = "black";  ///< black, clamp, periodic, mirror
  std::string filter = "box";                    ///< Of the MIP levels.
  float fov_degrees = 90;                        ///< Of the faces of a Cube.
};
class PictureLibrary {
 public:
  virtual ~PictureLibrary() = default;
  /// Null: `error` says why; likewise below.
  virtual std::unique_ptr<PictureReader> open(const std::string& path, std::string& error) const = 0;
  virtual std::unique_ptr<TextureCache> textures(const TextureSettings& settings) const = 0;
  /// The file is there when it is whole. A cube becomes a latitude-longitude picture, which is what environment lookups
  /// read. Unless done `error` says why, and no file is left behind.
  virtual Making makeTexture(const TextureRecipe& recipe, std::string& error) const = 0;
};

/// Loads the module. Null: it cannot be loaded; `error` says why.
const PictureLibrary* pictureLibrary(std::string& error);
/// PictureLibrary::makeTexture.
Making makeTexture(const TextureRecipe& recipe, std::string& error);
/// A file's reader. Null: `error` says why.
std::unique_ptr<PictureReader> openPicture(const std::string& path, std::string& error);

/// How OpenEXR spells the name of an attribute.
std::string exrAttributeName(const std::string& name);

/// Attribute of deep pictures: two floats, how many pixels wide and high the region is whose depths a pixel holds.
inline constexpr const char* kSampleRegion = "sampleregion";

/// What a picture that a Display of type "shadow", "zfile" or "deepshad" has left says of its camera.
struct DepthCamera {
  mat4 cameraFromWorld{1.0f};
  mat4 ndcFromWorld{1.0f};  ///< Homogeneous, -1..1, y up.
  int depth = 0;            ///< Number of the channel.
};
std::optional<DepthCamera> depthCameraOf(const PictureReader& picture);

}  // namespace tomales
