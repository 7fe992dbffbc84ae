// Verbs: shaded DeepFrame -> pixels -> files. Filter, exposure, quantise, write (RISpec imaging pipeline, in that
// order).
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "reyes/base/plugin_trust.h"
#include "reyes/base/stats.h"
#include "reyes/camera.h"
#include "reyes/deep.h"
#include "reyes/output.h"

namespace tomales {

/// Linear float channels, interleaved, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< For example "R" "G" "B" "A" "Z".
  std::vector<float> pixels;
  int originX = 0, originY = 0;  ///< Position of the data window inside the display window (crop).
  int displayWidth = 0, displayHeight = 0;

  int channelCount() const { return static_cast<int>(channels.size()); }
  float* at(int x, int y) {
    return pixels.data() +
           (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * channels.size();
  }
  const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
  int channelIndex(const std::string& name) const;  ///< Returns -1 if there is none.
};

/// A separable or radial pixel filter; names and formulas of RISpec 3.2 section 5.1.2, with the repairs that
/// docs/rib_support.md lists.
class PixelFilter {
 public:
  /// An unknown name gives gaussian and sets `known` to false.
  PixelFilter(const std::string& name, float xWidth, float yWidth, bool* known = nullptr);
  float operator()(float x, float y) const;  ///< Weight at an offset from the pixel centre, in pixels.
  bool hasNegativeLobes() const;
  static std::vector<std::string> names();
  int reachX() const, reachY() const;  ///< Number of pixels that the filter reaches beyond its own.
 private:
  int kind_;
  float xWidth_, yWidth_;
};

/// Sample positions of the pixel patterns, as the filter needs them; supplied by the composer.
struct SampleOffsets {
  int count = 0;
  std::vector<std::vector<vec2>> byPattern;  ///< Position inside the pixel, [0,1)^2.
  std::function<int(int x, int y)> patternOf;
};

/// The camera of a picture, kept in files whose format has room for it. Screen space has x and y in [-1, 1], y up.
struct View {
  mat4 cameraFromWorld{1.0f}, screenFromWorld{1.0f};
  float near = 0, far = kInfinity;  ///< Distances of the clipping planes.
};

/// Names for Cryptomatte, indexed as Scene::groups.
struct MatteNames {
  std::vector<std::string> objects, materials;
};

View viewOf(const Camera& camera, const mat4& cameraFromWorld);

/// Limits of merging the samples of a deep pixel. Samples are merged if they lie within the fraction `depth` of their
/// distance, or if together they are no more opaque than `opacity`.
struct DeepMerge {
  float depth = 1e-3f, opacity = 1.0f / 512;
  bool opacityOnly = false;  ///< Write AR AG AB Z ZBack instead of R G B A Z ZBack.
};

/// Rows of deep pixels: the number of samples of each, and their floats, nearest first.
struct DeepRows {
  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::vector<uint32_t> counts;
  std::vector<float> values;
};

/// The sums over pixels of their luminance and of its standard error. The error is estimated from the differences of
/// each pixel's samples as if they were independent (stratified ones are better).
struct PixelNoise {
  double light = 0, error = 0;
};

/// Filters the crop window of a shaded frame, some rows at a time. The floats of a pixel are those of
/// outputOf(options): R G B A Z first; colour premultiplied, linear, before exposure; Z by Options::depthFilter,
/// infinite where nothing opaque was hit. The sums run in a fixed order (rows, columns, fragments), so the result does
/// not depend on buckets, bands and threads. All arguments must outlive it.
class FrameFilter {
 public:
  FrameFilter(const DeepFrame& frame, const Options& options, const SampleOffsets& samples,
              const MatteNames& names = {});
  ~FrameFilter();
  Image shape() const;  ///< The whole picture, without pixels.
  /// Takes the contributions of a tile. The tile may be dropped afterwards unless needsTiles(). Threads may call it at
  /// the same time for different tiles.
  void resolve(size_t index, const DeepTile& tile);
  /// Tells whether tiles must stay in the frame until their rows are read: Cryptomatte and deep pixels read fragments.
  bool needsTiles() const;
  PixelNoise noise() const;  ///< Noise of the tiles that have been resolved.
  /// Returns raster rows [y0, y1) of the crop window. Calls must go from the top down. Tiles that are not resolved are
  /// taken from the frame. Data that no lower row needs are dropped afterwards.
  Image rows(int y0, int y1);
  /// Returns the same rows as deep pixels, before exposure.
  DeepRows deepRows(int y0, int y1, const DeepMerge& merge) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
Image filterFrame(const DeepFrame& frame, const Options& options, const SampleOffsets& samples);

/// Returns the number of pixels beyond the crop window that some channel's filter reaches.
vec2 filterReach(const Options& options);
/// Returns the pixels whose samples count in some pixel of `rect`: it grows by filterReach() on each side.
PixelRect grownByFilter(const PixelRect& rect, const Options& options);
/// Reports displays, channels and filters that are not understood. Returns false if some filter is unknown.
bool checkDisplays(const Options& options, Log& log);

/// Applies the exposure of Options, gain and gamma, to colours; alpha stays.
void expose(Image& image, const Options& options);

/// Returns the plugin that takes a Display instead of a file (reyes/display_api.h), because its type names no format;
/// empty if there is none. Plugins that come with the program are found first, then others as findPlugins() finds them
/// along Option "searchpath" "display".
std::string driverOf(const DisplayCall& display, const Options& options, const PluginTrust& trust);

/// Returns the path of a Display's file: its name, with an extension where type and name leave the format open
/// (RISpec's "ri.pic" does). Pre: no driver takes the Display.
std::string fileOf(const DisplayCall& display);
/// Returns the name, without its folder, of a file that stands in for a picture that is not whole: a.partial.exr for
/// a.exr.
std::string partialName(const std::string& path);
/// Names of texts in headers that identify a picture: the sum of all that it depends on, the shot that it was shaded
/// from, and the crop window that light was gathered for (docs/formats.md).
inline constexpr const char *kContents = "tomales:contents", *kShot = "tomales:shot", *kGathered = "tomales:gathered";
/// The header's text that tells which share of its buckets a picture holds: kAllFinished, or less where the frame was
/// interrupted. DisplayFile::close() writes the share over it.
constexpr const char *kFinishedShare = "tomales:finished", *kAllFinished = "1.000";
/// The header's text for statistics of the frame, which are known after its last pixel. It begins as kStatisticsRoom
/// blanks.
constexpr const char* kStatistics = "tomales:statistics";
constexpr size_t kStatisticsRoom = 8192;
/// Writes `text` over the blanks, in each part of a finished OpenEXR file. Returns false if there is no room for it.
bool fillStatistics(const std::string& file, const std::string& text);
/// Adds a named text to the header of a Display's file if its format has room for texts.
void addHeader(DisplayCall& display, const std::string& name, const std::string& text);

/// The file of one Display, or the display driver that takes its picture. It picks the Display's floats, encodes,
/// quantises and writes band after band to an UnfinishedFile; the last step renames. The format is given by
/// `display.type` or the name's extension (.exr .tif .png); 8-bit types are sRGB only where the Display's "string
/// transfer" says so. Failures are reported to the log, once.
class DisplayFile {
 public:
  /// `shape`: a picture without pixels. `output`: outputOf(options); `index`: that of the Display. `trust`: where a
  /// display driver may be loaded from.
  DisplayFile(const Image& shape, const FrameOutput& output, size_t index, const Options& options, Log& log,
              const View& view = {}, const MatteNames& names = {}, const PluginTrust& trust = {});
  ~DisplayFile();
  /// Returns false if the constructor has found that it cannot be written.
  bool hasBegun() const;
  /// Writes the next rows from the top: 64 or a multiple, except for the last call. Returns false if it cannot be
  /// written.
  bool write(const Image& rows);
  /// A deep Display uses these instead of write(Image); deep() is empty if the Display is not deep.
  std::optional<DeepMerge> deep() const;
  bool write(const DeepRows& rows);
  /// Gives the file its name. `finished`: the share of the buckets that it holds. If that is less than 1, the file is
  /// named NAME.partial.exr instead, which is reported, and an earlier file of the right name stays.
  bool close(float finished = 1);
  /// Returns the name that close() has given to the file, or that a driver has got.
  const std::string& written() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
/// Begins the file of each Display, and leaves nothing of it. Returns false, and reports it, if one cannot be written.
/// Display drivers are not tried.
bool displaysCanBegin(const Options& options, const PluginTrust& trust, Log& log);
/// Serves MakeShadow: the file of a Display needs no change, so it is checked and copied.
bool makeShadow(const std::string& picture, const std::string& map, const SourceLoc& where, Log& log);
/// Writes a whole picture at once.
bool writeDisplay(const Image& image, const DisplayCall& display, const Options& options, Log& log);
}  // namespace tomales
