// The settings of the command line, and how their texts are parsed. It knows no scene and no CLI library.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gi/services.h"
#include "reyes/base/plugin_trust.h"
#include "reyes/base/search_path.h"
#include "reyes/base/trust.h"

namespace tomales {

struct LightQuality;

struct RenderSettings {
  std::vector<std::string> files;  ///< The files of one RIB stream; "-" is standard input.
  std::string output;              ///< Empty for the scene's Displays.
  bool onePicture = false;         ///< Displays other than `output` are left out.
  std::set<std::string> sources;   ///< Pictures that Make requests of `files` read (reyes/rib.h:makeSources).
  bool overwrite = false;          ///< A crop may take the place of a picture that holds more.
  int threads = 0;                 ///< 0 for as many as the machine has.
  std::optional<std::array<int, 2>> format, pixelSamples;
  std::optional<std::array<float, 4>> crop;  ///< xmin xmax ymin ymax, 0..1
  std::optional<float> shadingRate;
  bool draft = false;                      ///< Coarse and fast, to place lights by.
  std::optional<std::vector<int>> frames;  ///< Sorted. If not given, all are rendered.
  bool framesApart = false;                ///< Frames that --frames leaves out need not be read.
  std::optional<std::vector<int>> makes;   ///< Sorted places of the Make requests to perform. If not given, all are.
  const GiMethod* gi = nullptr;            ///< Null for the method of the scene's indirect light.
  int samples = 0, bounces = 0;            ///< 0 for the numbers of the scene's indirect light.
  float maxError = -1;                     ///< Negative for the value of the scene's indirect light.
  std::optional<ErrorFunction> errorFunction;  ///< If not given, that of the scene's indirect light.
  /// Samples of each area light and the sky, where the eye looks; 0 for as many as the light asks.
  int lightSamples = 0;
  bool direct = true;  ///< If false, the picture shows what indirect lights bring, and nothing else.
  uint32_t seed = 0;
  std::optional<uint32_t> lightSeed;  ///< Seed of the random numbers of light alone; if not given, `seed`.
  int64_t photons = 1'000'000;        ///< Number to emit for --gi atlas and the caustics of the reference; the most for
                                      ///< --gi progressive.
  double photonNoise = 0;             ///< Counted photons end when their noise is less than this share of their light.
  bool atlasDirect = false;  ///< Maps of --gi atlas hold direct light; else gather rays sample lights where they hit.
  /// Brick maps of --gi atlas leave out bricks whose voxels vary by less of the map's mean.
  float brickMaxError = 0.03f;
  float radiosityTexels = 1;    ///< Factor on the texels along each edge of a radiosity map.
  std::string radiosityFolder;  ///< Radiosity maps are written there too, unless it is empty.
  std::string atlasFolder;      ///< Brick maps to use or to make, in a temporary folder if empty. For --gi points:
                                ///< point clouds.
  std::string bakedFolder;      ///< Brick maps of gathered light to add to, or with --gi baked to use; empty for none.
  size_t brickCacheBytes = BrickCache::kDefaultBytes;
  std::optional<int> bucketSize;
  std::vector<std::string> edits;  ///< RIB files of changes to a shot.
  std::string irradiance;          ///< An .icf to shade with.
  bool keepsAnswers = true;        ///< An .icf gets the answers of rays too.
  bool byLight = false;            ///< Irradiance records keep the share of each group of lights.
  bool appendIrradiance = false;   ///< True to gather too, where that has no records.
  int audit = 0;  ///< Pixels at which the error of the picture is measured; 0: none, unless an error is to be reached.
  double targetError = 0;    ///< The mean relative error of light to reach; 0: settings are as they are given.
  double targetSmudges = 0;  ///< Deviation of smudges to reach with it; 0: as targetError.
  double timeBudget_s = 0;   ///< Time that a frame may take; 0: as long as its settings ask.
  double reading_s = 0;      ///< Time that reading the frame has taken; it counts in timeBudget_s.
  std::optional<std::vector<int>> pilotFrames;  ///< Frames on which settings of light are found for all. Sorted.
  std::string shotSettings;                     ///< A file that keeps these settings for other runs; empty: none.
  int auditEvery = 10;        ///< Frames with settings of pilots whose number this divides are audited; 0: none.
  bool holdsQuality = false;  ///< This frame has settings that were found on others.
  bool auditsHeld = false;    ///< It is audited nevertheless.
  /// True if only settings are wanted of this frame, and no picture.
  bool isPilot = false;
  std::function<void(const LightQuality&)> onQuality;  ///< Gets the settings that a frame has chosen; may be empty.
  bool resume = false;
  bool skipFinished = false;             ///< Frames whose pictures hold what would be rendered are left as they are.
  std::optional<int64_t> memoryLimit;    ///< Limit in bytes.
  bool memoryIsGranted = false;          ///< The limit is what a cluster has granted, so it may not change pictures.
  std::optional<int64_t> textureMemory;  ///< Limit in bytes.
  std::string textureCache;
  bool hitList = true;
  std::optional<int64_t> geometryCache;  ///< Limit in bytes.
  std::optional<bool> fullGeometry;      ///< Rays see displaced micropolygons; if not given, for the reference alone.
  /// A name with '#' makes one file for each frame. A name ending in .jsonl gets a line for each.
  std::string statsFile;
  bool statsHeader = false;     ///< Statistics go to the headers of OpenEXR pictures too.
  std::string logFile;          ///< Messages are appended there too; empty: none.
  bool profileShaders = false;  ///< True to say at the end what each shader has cost.
  bool progress = false;
  std::function<void(const char* pass, float share)> watcher;  ///< See ProgressWatcher.
  std::string preview;                                         ///< host:port of a viewer; empty: none.
  std::vector<std::array<int, 2>> pixels;                      ///< Pixels to explain.
  Trust trust;                                                 ///< Trust in the code that the RIB names.
  std::string outputRoot;          ///< Files that the RIB names are written below it; empty: anywhere.
  bool strict = false;             ///< A warning ends with the exit code of what is missing.
  std::string specular;            ///< Option "shade" "specular"; empty: as the scene says.
  std::string arealight;           ///< Option "shade" "arealight"; empty: as the scene says.
  bool standardFromFiles = false;  ///< A file that is called as a shader of RISpec's comes before that.
  Log::Verbosity verbosity = Log::Verbosity::Normal;
  std::string commandLine;
};

/// Tells whether the program chooses the settings of light, by trials that need the whole frame.
inline bool choosesQuality(const RenderSettings& s) {
  return (s.targetError > 0 || s.timeBudget_s > 0) && !s.holdsQuality;
}
inline bool audits(const RenderSettings& s) {
  return s.audit > 0 || (s.targetError > 0 && !s.holdsQuality) || s.auditsHeld;
}
inline PluginTrust pluginTrust(const Trust& t) {
  return {.folders = t.shaderFolders + ":" + standardPath("shader") + ":" + t.pluginFolders(),
          .chosen = t.shaderFolders,
          .sceneFolders = t.allowsPluginsOfScene()};
}
inline PluginTrust pluginTrust(const RenderSettings& settings) { return pluginTrust(settings.trust); }
inline uint32_t lightSeedOf(const RenderSettings& settings) { return settings.lightSeed.value_or(settings.seed); }

// Each of these returns nothing when the text is not of its form.
std::optional<std::array<int, 2>> parsePair(const std::string& text, int least, int most);  ///< "640x480"
std::optional<std::array<int, 2>> parsePixel(const std::string& text);                      ///< "120,80"
std::optional<std::array<float, 4>> parseCrop(const std::string& text);                     ///< "0,0.5,0.25,1"
std::optional<std::vector<int>> parseFrames(const std::string& text);                       ///< "1-10x2,15", "none"
std::optional<int64_t> parseBytes(const std::string& text);                                 ///< "600M", "2G", "1000000"
/// Returns null for "scene", which leaves it to the scene.
std::optional<const GiMethod*> parseGi(const std::string& text);
/// "2%" or "0.02"; more than 0 and less than 1.
std::optional<double> parseShare(const std::string& text);
std::optional<double> parseSeconds(const std::string& text);  ///< "90", "90s", "10m", "2h"

/// Shares of --memory-limit: textures and what rays meet get a quarter each, bricks --brick-cache but no more than an
/// eighth, and each gets at least 1 MB.
int64_t textureShare(int64_t memoryLimit);
int64_t rayShare(int64_t memoryLimit);
size_t brickCacheBytes(const RenderSettings& settings);

/// Replaces runs of '#' by the frame number, padded to their length.
std::string withFrameNumber(const std::string& path, int frame);

}  // namespace tomales
