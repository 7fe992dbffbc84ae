#include "reyes/pictures/textures.h"

#include <OpenImageIO/texture.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <utility>

#include "reyes/base/file_guesses.h"
#include "reyes/base/input_file.h"
#include "reyes/base/missing_file.h"
#include "reyes/base/search_path.h"
#include "reyes/pictures/convert.h"
#include "reyes/pictures/footprint.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;
using Handle = OIIO::TextureSystem::TextureHandle;
using Thread = OIIO::TextureSystem::Perthread;

std::string cacheFolderOf(const TextureSettings& settings) {
  if (!settings.cacheFolder.empty()) return settings.cacheFolder;
  if (const char* own = std::getenv("TOMALES_TEXTURE_CACHE")) return own;
  if (const char* cache = std::getenv("XDG_CACHE_HOME")) return std::string(cache) + "/tomales/textures";
  const char* home = std::getenv("HOME");
  return (home ? std::string(home) + "/.cache" : fs::temp_directory_path().string()) + "/tomales/textures";
}

/// Returns the position of a tile's number in a name; npos if it has none.
size_t tileMark(const std::string& name, size_t& length) {
  for (const std::string_view mark : {"<UDIM>", "_MAPID_"})
    if (const size_t at = name.find(mark); at != std::string::npos) {
      length = mark.size();
      return at;
    }
  return std::string::npos;
}

struct OpenFile {
  Handle* handle = nullptr;  ///< Null: the file cannot be opened.
  int channels = 0;
};

/// A picture that is open, under the name by which shaders call it.
struct Picture {
  std::map<int, OpenFile> tiles;  ///< Indexed by UDIM number; 0 if there is only one.
  bool tiled = false;
  std::string error;   ///< Says why there is none.
  std::string remark;  ///< Says what was used instead of a file, and why.
};

/// OpenImageIO's texture system, one for the process and never destroyed. Threads keep tiles of a system beyond its
/// life, under its address, and OpenImageIO 2.4 gives them to the next system at that address. (It keeps them in a
/// boost::thread_specific_ptr, whose destruction frees only the tiles of the calling thread.)
class SharedSystem {
 public:
  OIIO::TextureSystem* const textures = OIIO::TextureSystem::create(false);

  static SharedSystem& get() {
    static SharedSystem shared;
    return shared;
  }
  void enter(int64_t memory_bytes) {
    const std::lock_guard lock(mutex);
    ++users;
    textures->attribute("max_memory_MB", static_cast<float>(memory_bytes) / (1 << 20));
  }
  /// Frees tiles and closes files after the last user: a picture that is rewritten between frames is then read anew.
  void leave() {
    const std::lock_guard lock(mutex);
    if (--users == 0) textures->invalidate_all(true);
  }
  TextureFigures takeFigures() {
    TextureFigures now;
    int misses = 0;
    const std::lock_guard lock(mutex);
    textures->getattribute("stat:find_tile_calls", OIIO::TypeDesc::INT64, &now.tileRequests);
    textures->getattribute("stat:tiles_created", OIIO::TypeDesc::INT, &misses);
    textures->getattribute("stat:bytes_read", OIIO::TypeDesc::INT64, &now.bytesRead);
    now.tileMisses = misses;
    const TextureFigures before = std::exchange(taken, now);
    return {now.tileRequests - before.tileRequests, now.tileMisses - before.tileMisses,
            now.bytesRead - before.bytesRead};
  }

 private:
  SharedSystem() {
    textures->attribute("automip", 1);  // needed for pictures of a cache folder that cannot be written
    textures->attribute("autotile", 64);
    textures->attribute("gray_to_rgb", 1);  // the colour of a picture of one channel is grey, not red
  }

  std::mutex mutex;
  int users = 0;
  TextureFigures taken;
};

OIIO::TextureOpt optionsOf(const TextureQuery& q) {
  using Opt = OIIO::TextureOpt;
  Opt o;
  o.firstchannel = q.channel;
  o.fill = q.fill;
  o.sblur = q.sBlur;
  o.tblur = q.tBlur;
  const std::string_view filter = q.filter ? q.filter : "";
  const bool straight = filter.empty() || filter == "box" || filter == "disk" || filter == "lerp";
  o.interpmode = straight ? Opt::InterpBilinear : Opt::InterpSmartBicubic;
  if (q.sWidth == 0 && q.tWidth == 0 && q.sBlur == 0 && q.tBlur == 0) {
    o.mipmode = Opt::MipModeNoMIP;
    o.interpmode = Opt::InterpClosest;
  }
  if (q.latlong) {
    o.swrap = Opt::WrapPeriodic;
    o.twrap = Opt::WrapClamp;
  }
  return o;
}

class Cache : public TextureCache {
 public:
  explicit Cache(const TextureSettings& s) : settings(s), cacheFolder(cacheFolderOf(s)) {
    SharedSystem::get().enter(settings.memory_bytes);
  }
  ~Cache() override { SharedSystem::get().leave(); }
  bool lookup(const TextureQuery& query, TmVec3 out, int64_t& lookups, std::string& remark) override;
  bool info(const std::string& name, const std::string& what, std::vector<float>& numbers, std::string& text) override;
  TextureFigures takeFigures() override { return SharedSystem::get().takeFigures(); }

 private:
  const Picture& picture(std::string_view name) {
    {
      const std::shared_lock lock(mutex);
      if (const auto it = pictures.find(name); it != pictures.end()) return *it->second;
    }
    // One conversion runs at a time, because those who wait mostly want the same picture, and conversions are few.
    const std::unique_lock lock(mutex);
    auto& slot = pictures[std::string(name)];
    if (!slot) slot = open(std::string(name));
    return *slot;
  }

  std::string notFound(const std::string& name) const {
    std::vector<std::string> folders = foldersOf(settings.searchPath);
    folders.push_back(".");
    return "not found in " + listOfFolders(folders) + hintOfMissing(name, pictureEndings(), folders);
  }

  std::unique_ptr<const Picture> open(const std::string& name) {
    auto picture = std::make_unique<Picture>();
    size_t length = 0;
    const size_t mark = tileMark(name, length);
    picture->tiled = mark != std::string::npos;
    constexpr int kFirst = 1001, kLast = 1100;
    for (int tile = kFirst; picture->tiled && tile <= kLast; ++tile)
      add(std::string(name).replace(mark, length, std::to_string(tile)), tile, *picture);
    if (!picture->tiled) add(name, 0, *picture);
    std::error_code none;
    if (picture->tiles.empty() && picture->error.empty())
      picture->error = fs::exists(name, none) ? inputProblem(name) : notFound(name);
    return picture;
  }

  void add(const std::string& name, int tile, Picture& picture) {
    const std::string named = findFile(name, settings.searchPath);
    std::string problem;  // with the best candidate
    for (const std::string& candidate : candidateFiles(name, settings.searchPath, textureEndings())) {
      std::string error;
      if (const OpenFile file = openFile(candidate, error); file.handle) {
        picture.tiles[tile] = file;
        if (candidate == named) return;
        picture.remark = fmt::format("{}; {} is taken, which has its name",
                                     named.empty() ? "is not there" : "cannot be read (" + problem + ")", candidate);
        return;
      }
      if (problem.empty()) problem = error;
    }
    if (!named.empty()) picture.error = problem;  // otherwise the picture counts as not found
  }

  /// Opens a file. If there is no handle, `error` says why.
  OpenFile openFile(const std::string& path, std::string& error) {
    std::string note;
    const std::string file = tiledFile(path, cacheFolder, error, note);
    if (!note.empty() && settings.note) settings.note(note);
    Handle* handle = file.empty() ? nullptr : system->get_texture_handle(OIIO::ustring(file));
    const OIIO::ImageSpec* spec = handle && system->good(handle) ? system->imagespec(handle) : nullptr;
    if (spec) return {handle, spec->nchannels};
    if (error.empty()) error = system->geterror();
    return {};
  }

  OIIO::TextureSystem* const system = SharedSystem::get().textures;
  const TextureSettings settings;
  const std::string cacheFolder;
  std::shared_mutex mutex;  ///< Protects `pictures`.
  std::map<std::string, std::unique_ptr<const Picture>, std::less<>> pictures;
};

bool Cache::lookup(const TextureQuery& q, TmVec3 out, int64_t& lookups, std::string& remark) {
  const Picture& known = picture(q.name);
  Thread* thread = system->get_perthread_info();
  OIIO::TextureOpt options = optionsOf(q);
  float* const channels[3] = {out.x, out.y, out.z};
  const int n = std::clamp(q.channels, 1, 3);
  bool found = !known.tiles.empty() && known.error.empty();
  for (int i = 0; i < q.count && found; ++i) {
    if (!q.active[i]) continue;
    float texel[3] = {q.fill, q.fill, q.fill};
    float s = std::isfinite(q.s[i]) ? q.s[i] : 0, t = std::isfinite(q.t[i]) ? q.t[i] : 0;
    OpenFile file;
    if (known.tiled) {
      const float column = std::floor(s), row = std::floor(t);
      const auto tile = column >= 0 && column < 10 && row >= 0 && row < 10
                            ? known.tiles.find(1001 + static_cast<int>(column) + 10 * static_cast<int>(row))
                            : known.tiles.end();
      if (tile != known.tiles.end()) {
        file = tile->second;
        s -= column;
        t -= row;
      }
    } else {
      file = known.tiles.begin()->second;
    }
    const auto edge = [&](const float* e, float width) {
      const float wide = e ? e[i] * width : 0;
      return std::isfinite(wide) ? double{wide} : 0;
    };
    // OpenImageIO 2.4 reads beyond the texel where a picture lacks even the first channel.
    if (file.handle && q.channel < file.channels) {
      const Footprint f =
          soundFootprint({edge(q.su, q.sWidth), edge(q.tu, q.tWidth), edge(q.sv, q.sWidth), edge(q.tv, q.tWidth)});
      found = system->texture(file.handle, thread, options, s, t, static_cast<float>(f.su), static_cast<float>(f.tu),
                              static_cast<float>(f.sv), static_cast<float>(f.tv), n, texel);
      ++lookups;
    }
    for (int k = 0; k < n; ++k) channels[k][i] = texel[k];
  }
  if (!found)
    remark = known.error.empty() ? system->geterror() : known.error;
  else if (!known.remark.empty())
    remark = known.remark;
  return found;
}

bool Cache::info(const std::string& name, const std::string& what, std::vector<float>& numbers, std::string& text) {
  const Picture& known = picture(name);
  const bool there = !known.tiles.empty();
  numbers.clear();
  text.clear();
  if (what == "exists") {
    numbers = {there ? 1.0f : 0.0f};
    return true;
  }
  if (!there) return false;
  Handle* handle = known.tiles.begin()->second.handle;
  const auto get = [&](const char* fact, const OIIO::TypeDesc& type, void* to) {
    return system->get_texture_info(handle, nullptr, 0, OIIO::ustring(fact), type, to);
  };
  const auto matrix = [&](const char* fact) {
    numbers.resize(16);
    return get(fact, OIIO::TypeMatrix44, numbers.data());
  };
  if (what == "viewingmatrix") return matrix("worldtocamera");
  if (what == "projectionmatrix") return matrix("worldtoscreen");
  if (what == "resolution") {
    int size[2] = {0, 0};
    const bool good = get("resolution", OIIO::TypeDesc(OIIO::TypeDesc::INT, 2), size);
    numbers = {static_cast<float>(size[0]), static_cast<float>(size[1])};
    return good;
  }
  if (what == "channels" || what == "bitsperchannel") {
    int value = 0;
    const bool counts = what == "channels";
    bool good = get(counts ? "channels" : "oiio:BitsPerSample", OIIO::TypeInt, &value);
    if (!good && !counts) {
      good = get("cachedpixeltype", OIIO::TypeInt, &value);
      if (good) value = static_cast<int>(8 * OIIO::TypeDesc(static_cast<OIIO::TypeDesc::BASETYPE>(value)).size());
    }
    numbers = {static_cast<float>(value)};
    return good;
  }
  if (what != "type" && what != "textureformat") return false;
  const char* format = nullptr;
  if (!get("textureformat", OIIO::TypeString, &format)) return false;
  const std::string_view kind = format;
  text = what == "textureformat"         ? format
         : kind == "Shadow"              ? "shadow"
         : kind.find("Env") != kind.npos ? "environment"
                                         : "texture";
  return true;
}

}  // namespace

std::unique_ptr<TextureCache> makeTextureCache(const TextureSettings& settings) {
  return std::make_unique<Cache>(settings);
}

}  // namespace tomales
