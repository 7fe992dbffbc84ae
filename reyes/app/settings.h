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
#include "reyes/base/standard_folders.h"
#include "reyes/base/trust.h"

namespace tomales {

struct LightQuality;

/// The RIB to read, how much of it, and what it may do.
struct InputSettings {
  std::vector<std::string> files;  ///< The files of one RIB stream; "-" is standard input.
  std::set<std::string> sources;   ///< The pictures that Make requests in `files` read (reyes/rib.h:makeSources).
  std::vector<std::string> edits;  ///< RIB files of changes to a shot.
  std::optional<std::vector<int>> frames;  ///< Sorted. If not given, all are rendered.
  bool framesApart = false;                ///< Frames that --frames leaves out need not be read.
  std::optional<std::vector<int>> makes;   ///< Sorted places of the Make requests to perform. If not given, all are.
  Trust trust;                             ///< Trust in the code that the RIB names.
  std::optional<bool> standardFromFiles;   ///< Parameter of ShaderRegistry.
};

/// Where the pictures go, and the settings that replace options of the scene.
struct PictureSettings {
  std::string output;         ///< Empty for the scene's Displays.
  bool onePicture = false;    ///< Displays other than `output` are left out.
  bool overwrite = false;     ///< A crop may take the place of a picture that holds more.
  std::string outputRoot;     ///< Files that the RIB names are written below it; empty: anywhere.
  bool resume = false;        ///< Finished work is kept, and the work of an interrupted run is taken over.
  bool skipFinished = false;  ///< Frames whose pictures hold what would be rendered are left as they are.
  std::optional<std::array<int, 2>> format, pixelSamples;
  std::optional<std::array<float, 4>> crop;  ///< xmin xmax ymin ymax, 0..1
  std::optional<float> shadingRate;
  bool draft = false;  ///< Coarse and fast, to place lights by.
  uint32_t seed = 0;
  std::string specular;   ///< Option "shade" "specular"; empty: as the scene says.
  std::string arealight;  ///< Option "shade" "arealight"; empty: as the scene says.
};

/// Light, direct and indirect, and the rays that find it.
struct LightSettings {
  const GiMethod* gi = nullptr;                ///< Null for the method of the scene's indirect light.
  int samples = 0, bounces = 0;                ///< 0 for the numbers of the scene's indirect light.
  float maxError = -1;                         ///< Negative for the value of the scene's indirect light.
  std::optional<ErrorFunction> errorFunction;  ///< If not given, that of the scene's indirect light.
  /// Samples of each area light and the sky, where the eye looks; 0 for as many as the light asks.
  int lightSamples = 0;
  bool direct = true;            ///< If false, the picture shows nothing but the light of indirect lights.
  std::optional<uint32_t> seed;  ///< Seed of the random numbers of light alone; if not given, PictureSettings::seed.
  int64_t photons = 1'000'000;   ///< Number to emit for --gi atlas and the caustics of the reference; the most for
                                 ///< --gi progressive.
  double photonNoise = 0;        ///< Counting photons stops when their noise is below this share of their light.
  bool hitList = true;           ///< Rays leave surfaces by lists of hits; if false, by a bias alone (Ray::offset).
  std::optional<bool> fullGeometry;  ///< Rays see displaced micropolygons; if not given, for the reference alone.
};

/// Light that is kept in maps and files.
struct StoredLightSettings {
  bool atlasDirect =
      false;  ///< Maps of --gi atlas hold direct light; if false, gather rays sample lights where they hit.
  /// Brick maps of --gi atlas leave out bricks whose voxels vary by less than this share of the map's mean.
  float brickMaxError = 0.03f;
  float radiosityTexels = 1;    ///< Factor on the texels along each edge of a radiosity map.
  std::string radiosityFolder;  ///< Radiosity maps are written there too, unless it is empty.
  std::string atlasFolder;      ///< Brick maps to use or to make, in a temporary folder if empty. For --gi points:
                                ///< point clouds.
  std::string bakedFolder;      ///< Brick maps of gathered light to add to, or with --gi baked to use; empty for none.
  std::string irradiance;       ///< An .icf to shade with.
  bool keepsAnswers = true;     ///< An .icf gets the answers of rays too.
  bool byLight = false;         ///< Irradiance records keep the share of each group of lights.
  bool appendIrradiance = false;  ///< True to gather new records where `irradiance` has none.
};

/// The error to measure or to reach, or the time to keep; and settings that hold for all frames but are found on some.
struct QualitySettings {
  int audit =
      0;  ///< Number of pixels at which the error of the picture is measured; 0: none, unless there is a target error.
  double targetError = 0;    ///< The mean relative error of light to reach; 0: settings are as they are given.
  double targetSmudges = 0;  ///< Deviation of smudges to reach besides; 0: the same as targetError.
  double timeBudget_s = 0;   ///< Time that a frame may take; 0: as long as its settings ask.
  double reading_s = 0;      ///< Time that reading the frame has taken; it counts in timeBudget_s.
  std::optional<std::vector<int>> pilotFrames;  ///< Frames on which settings of light are found for all. Sorted.
  std::string animationSettings;                ///< A file that keeps these settings for other runs; empty: none.
  int auditEvery = 10;      ///< Frames with settings of pilots are audited if this divides their number; 0: none.
  bool isHeld = false;      ///< This frame uses settings that were found on other frames.
  bool isPilot = false;     ///< Only settings are wanted of this frame, and no picture.
  bool auditsHeld = false;  ///< The frame is audited though its settings are held.
  std::function<void(const LightQuality&)> onQuality;  ///< Gets the settings that a frame has chosen; may be empty.

  /// Tells whether the program chooses the settings of light, by trials that need the whole frame.
  bool chooses() const { return (targetError > 0 || timeBudget_s > 0) && !isHeld; }
  bool audits() const { return audit > 0 || (targetError > 0 && !isHeld) || auditsHeld; }
};

/// Threads, memory and caches.
struct ResourceSettings {
  int threads = 0;                       ///< 0 for as many as the machine has.
  std::optional<int64_t> memoryLimit;    ///< Limit in bytes.
  bool memoryIsGranted = false;          ///< A cluster granted the limit, so it must not change pictures.
  std::optional<int64_t> textureMemory;  ///< Limit in bytes.
  std::string textureCache;
  size_t brickCacheBytes = BrickCache::kDefaultBytes;
  std::optional<int64_t> geometryCache;  ///< Limit in bytes.
  std::optional<int> bucketSize;         ///< Edge in pixels.
};

/// What a run reports while it works and afterwards.
struct ReportSettings {
  /// A name with '#' makes one file for each frame. A name ending in .jsonl gets a line for each.
  std::string statsFile;
  bool statsHeader = false;     ///< Statistics go to the headers of OpenEXR pictures too.
  std::string logFile;          ///< Messages are appended there too; empty: none.
  bool profileShaders = false;  ///< True to say at the end what each shader has cost.
  bool progress = false;
  std::function<void(const char* pass, float share)> watcher;  ///< See ProgressWatcher.
  std::string preview;                                         ///< host:port of a viewer; empty: none.
  std::vector<std::array<int, 2>> pixels;                      ///< Pixels to explain.
  bool strict = false;  ///< After a warning the exit code is that of something missing.
  Log::Verbosity verbosity = Log::Verbosity::Normal;
  std::string commandLine;
};

/// The settings of a command that renders.
struct RenderSettings {
  InputSettings input;
  PictureSettings picture;
  LightSettings light;
  StoredLightSettings stored;
  QualitySettings quality;
  ResourceSettings resources;
  ReportSettings report;
};

inline PluginTrust pluginTrust(const Trust& t) {
  return {.folders = t.shaderFolders + ":" + standardPath("shader") + ":" + t.pluginFolders(),
          .chosen = t.shaderFolders,
          .sceneFolders = t.allowsPluginsOfScene()};
}
inline PluginTrust pluginTrust(const RenderSettings& settings) { return pluginTrust(settings.input.trust); }
inline uint32_t lightSeedOf(const RenderSettings& settings) {
  return settings.light.seed.value_or(settings.picture.seed);
}

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
size_t brickCacheBytes(const ResourceSettings& settings);

/// Replaces a run of '#' by the frame number, padded to its length. The name of a folder that exists stays as it is.
std::string withFrameNumber(const std::string& path, int frame);

}  // namespace tomales
