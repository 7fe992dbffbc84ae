// What the command line asks for, and how its small languages are read. Knows no scene and no CLI library.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gi/services.h"
#include "reyes/base/plugin_trust.h"
#include "reyes/base/search_path.h"
#include "reyes/base/trust.h"

namespace tomales {

constexpr const char* kVersion = "0.1.0";

struct RenderSettings {
  std::vector<std::string> files;  ///< One RIB stream; "-" is standard input.
  std::string output;              ///< Empty: the scene's Displays.
  bool onePicture = false;         ///< Displays beside `output` are left out.
  int threads = 0;                 ///< 0: as many as the machine has.
  std::optional<std::array<int, 2>> format, pixelSamples;
  std::optional<std::array<float, 4>> crop;  ///< xmin xmax ymin ymax, 0..1
  std::optional<float> shadingRate;
  bool draft = false;                          ///< Coarse and fast, to place lights by.
  std::optional<std::vector<int>> frames;      ///< Sorted. None: all.
  const GiMethod* gi = nullptr;                ///< Null: as the scene's indirect light asks.
  int samples = 0, bounces = 0;                ///< 0: as the scene's indirect light asks.
  float maxError = -1;                         ///< < 0: likewise.
  std::optional<ErrorFunction> errorFunction;  ///< None: likewise.
  int lightSamples = 0;  ///< Of each area light and of the sky, where the eye looks; 0: as many as the light asks for.
  bool direct = true;    ///< False: the picture shows what indirect lights bring, and nothing else.
  uint32_t seed = 0;
  std::optional<uint32_t> lightSeed;  ///< Of the random numbers of light alone; none: seed.
  int64_t photons = 1'000'000;        ///< To emit for --gi atlas.
  bool atlasDirect = false;  ///< Maps of --gi atlas hold direct light; else gather rays sample lights where they hit.
  float brickMaxError =
      0.03f;  ///< Of the brick maps of --gi atlas: bricks whose voxels vary by less of the map's mean are left out.
  float radiosityTexels = 1;    ///< Times as many along each edge of a radiosity map as objects ask.
  std::string radiosityFolder;  ///< Radiosity maps are written there too; empty: nowhere.
  std::string atlasFolder;      ///< Brick maps to use, or to make; empty: made in a temporary folder. For --gi points:
                                ///< point clouds.
  std::string bakedFolder;      ///< Brick maps of gathered light: added to, or with --gi baked used; empty: none.
  size_t brickCacheBytes = BrickCache::kDefaultBytes;
  std::optional<int> bucketSize;
  std::vector<std::string> edits;  ///< RIB files of changes to a shot.
  std::string irradiance;          ///< An .icf to shade with.
  bool appendIrradiance = false;   ///< And to gather into what it leaves uncovered.
  bool resume = false;
  std::optional<int64_t> memoryLimit;    ///< Bytes.
  std::optional<int64_t> textureMemory;  ///< Bytes.
  std::string textureCache;
  bool hitList = true;
  std::optional<int64_t> geometryCache;  ///< Bytes.
  std::optional<bool> fullGeometry;      ///< Rays see displaced micropolygons; none: for the reference.
  std::string statsFile;
  bool profileShaders = false;  ///< Say at the end what each shader has cost.
  bool progress = false;
  std::string preview;                     ///< host:port of a viewer; empty: none.
  std::vector<std::array<int, 2>> pixels;  ///< To explain.
  Trust trust;                             ///< Of the code that the RIB names.
  std::string outputRoot;                  ///< What the RIB names is written below it; empty: anywhere.
  bool strict = false;                     ///< A warning ends with the exit code of what is missing.
  std::string specular;                    ///< Option "shade" "specular"; empty: as the scene says. Likewise,
  std::string arealight;                   ///< Option "shade" "arealight".
  bool standardFromFiles = false;          ///< A file that is called as a shader of RISpec's comes before that.
  Log::Verbosity verbosity = Log::Verbosity::Normal;
  std::string commandLine;
};

inline PluginTrust pluginTrust(const Trust& t) {
  return {.folders = t.shaderFolders + ":" + standardPath("shader") + ":" + t.pluginFolders(),
          .sceneFolders = t.allowsPluginsOfScene()};
}
inline PluginTrust pluginTrust(const RenderSettings& settings) { return pluginTrust(settings.trust); }
inline uint32_t lightSeedOf(const RenderSettings& settings) { return settings.lightSeed.value_or(settings.seed); }

// Each returns nothing when the text is not of its form.
std::optional<std::array<int, 2>> parsePair(const std::string& text, int least, int most);  ///< "640x480"
std::optional<std::array<int, 2>> parsePixel(const std::string& text);                      ///< "120,80"
std::optional<std::array<float, 4>> parseCrop(const std::string& text);                     ///< "0,0.5,0.25,1"
std::optional<std::vector<int>> parseFrames(const std::string& text);                       ///< "1-10x2,15"
std::optional<int64_t> parseBytes(const std::string& text);                                 ///< "600M", "2G", "1000000"
/// Null for "scene", which leaves it to the scene.
std::optional<const GiMethod*> parseGi(const std::string& text);
std::optional<double> parseSeconds(const std::string& text);  ///< "90", "90s", "10m", "2h"

/// Shares of --memory-limit: for textures a quarter, for bricks --brick-cache but no more than an eighth; at least 1 MB
/// each.
int64_t textureShare(int64_t memoryLimit);
size_t brickCacheBytes(const RenderSettings& settings);

/// Runs of '#' become the frame number, padded to their length.
std::string withFrameNumber(const std::string& path, int frame);

}  // namespace tomales
