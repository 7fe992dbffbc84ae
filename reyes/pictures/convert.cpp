#include "reyes/pictures/convert.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "reyes/base/checksum.h"
#include "reyes/base/folder_lock.h"
#include "reyes/base/input_file.h"
#include "reyes/base/stop.h"
#include "reyes/base/temporary_folder.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

std::string oiioError() {
  std::string text = OIIO::geterror();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.empty() ? "it cannot be read" : text;
}

struct Seal {
  char magic[8];
  uint64_t sum;  ///< Sum of the bytes before the seal.
};
constexpr char kSealMagic[] = "TMSEALED";

std::optional<Bytes> bytesOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return std::nullopt;
  Bytes bytes(static_cast<size_t>(in.tellg()));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return in ? std::optional(std::move(bytes)) : std::nullopt;
}

/// Files of the cache end in a checksum of their contents, which readers of TIFF ignore. Without it, a truncated or
/// corrupt file would be noticed only when its texels are needed, in the middle of a frame, or never.
bool seal(const std::string& file) {
  const auto bytes = bytesOf(file);
  if (!bytes) return false;
  Seal s{{}, checksum(*bytes)};
  std::memcpy(s.magic, kSealMagic, sizeof s.magic);
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out.write(reinterpret_cast<const char*>(&s), sizeof s);
  out.close();
  return out.good();
}

bool isSealed(const std::string& file) {
  const auto bytes = bytesOf(file);
  Seal s{};
  if (!bytes || bytes->size() < sizeof s) return false;
  std::memcpy(&s, bytes->data() + bytes->size() - sizeof s, sizeof s);
  return std::memcmp(s.magic, kSealMagic, sizeof s.magic) == 0 &&
         s.sum == checksum(BytesView(*bytes).first(bytes->size() - sizeof s));
}

/// Reads every texel, so that a truncated picture is found before anything is made from it. It uses an ImageInput,
/// because an ImageBuf accepts truncated strips of TIFF: OpenImageIO returns true and leaves a message.
bool readTexels(const std::string& file, OIIO::ImageBuf& picture, std::string& error) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) {
    error = oiioError();
    return false;
  }
  OIIO::ImageSpec spec = in->spec();
  if (spec.deep) {
    error = "it is a deep picture";
    return false;
  }
  spec.channelformats.clear();
  picture.reset(spec);
  const bool read = in->read_image(0, 0, 0, spec.nchannels, spec.format, picture.localpixels());
  error = in->geterror();
  error = error.substr(0, error.find('\n'));
  if (!read && error.empty()) error = "it cannot be read";
  return error.empty();
}

/// Copies a tiled TIFF with its levels. Where tiles reach beyond the picture, OpenImageIO writes uninitialised memory,
/// so the same picture would give different bytes each time. The copy has zeros there.
bool copyWithBlackEdges(const std::string& from, const std::string& to, std::string& error) {
  const auto in = OIIO::ImageInput::open(from);
  const auto out = OIIO::ImageOutput::create("tiff");
  const auto failed = [&](const std::string& what) {
    error = what.empty() ? "it cannot be written" : what;
    return false;
  };
  if (!in || !out) return failed(oiioError());
  for (int level = 0; in->seek_subimage(0, level); ++level) {
    const OIIO::ImageSpec spec = in->spec();
    if (!out->open(to, spec, level == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage))
      return failed(out->geterror());
    const size_t pixel = spec.pixel_bytes(true), row = pixel * static_cast<size_t>(spec.tile_width);
    std::vector<char> tile(row * static_cast<size_t>(spec.tile_height));
    for (int y = 0; y < spec.height; y += spec.tile_height)
      for (int x = 0; x < spec.width; x += spec.tile_width) {
        if (!in->read_tile(spec.x + x, spec.y + y, 0, spec.format, tile.data())) return failed(in->geterror());
        const auto columns = static_cast<size_t>(std::min(spec.tile_width, spec.width - x));
        for (int r = 0; r < spec.tile_height; ++r) {
          const auto begin = tile.begin() + static_cast<std::ptrdiff_t>(row) * r;
          const size_t kept = r < spec.height - y ? columns * pixel : 0;
          std::fill(begin + static_cast<std::ptrdiff_t>(kept), begin + static_cast<std::ptrdiff_t>(row), 0);
        }
        // The type must be named: otherwise OpenImageIO would take all rows of the tile from the same place.
        if (!out->write_tile(spec.x + x, spec.y + y, 0, spec.format, tile.data())) return failed(out->geterror());
      }
  }
  return out->close() || failed(out->geterror());
}

/// `scratch`: a folder on the same file system. Files that a killed process has left there are removed.
bool write(const OIIO::ImageBuf& picture, const TextureRecipe& recipe, const std::string& file, const fs::path& scratch,
           bool sealed, std::string& error) {
  OIIO::ImageSpec config;
  const bool exr = fs::path(file).extension() == ".exr";
  config.attribute("maketx:fileformatname", exr ? "openexr" : "tiff");
  config.attribute("maketx:filtername", recipe.filter);
  config.attribute("DateTime", "1970:01:01 00:00:00");  // the present date would make every conversion different
  config.attribute("wrapmodes", recipe.sWrap + "," + recipe.tWrap);
  try {
    // It is a folder, because OpenImageIO makes a further file beside the requested one, which a killed process would
    // leave behind.
    const TemporaryFolder folder(scratch);
    const fs::path first = folder.path() / "first", made = exr ? first : folder.path() / "texture";
    if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, picture, first.string(), config))
      error = oiioError();
    else if (!exr && !copyWithBlackEdges(first.string(), made.string(), error))
      error = fmt::format("\"{}\" cannot be written: {}", file, error);
    else if (sealed && !seal(made.string()))
      error = fmt::format("\"{}\" cannot be written", file);
    else if (!moveFinished(made, file, error))
      error = fmt::format("\"{}\" cannot be written: {}", file, error);
  } catch (const fs::filesystem_error& e) {
    error = fmt::format("\"{}\" cannot be written: {}", file, e.code().message());
  }
  return error.empty();
}

bool isTiledMip(const std::string& file, std::string& error) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) {
    error = oiioError();
    return false;
  }
  return in->spec().tile_width > 0 && in->seek_subimage(0, 1);
}

OIIO::ImageBuf withoutGrey(const OIIO::ImageBuf& picture) {
  const bool isGrey = picture.nchannels() == 2 && picture.spec().alpha_channel == 1;
  if (!isGrey) return picture;
  return OIIO::ImageBufAlgo::channels(picture, 4, {0, 0, 0, 1}, {}, {"R", "G", "B", "A"});
}

}  // namespace

bool readWhole(const std::string& file, OIIO::ImageBuf& picture, std::string& error) {
  error = inputProblem(file);
  return error.empty() && readTexels(file, picture, error);
}

Making convert(const TextureRecipe& recipe, std::string& error) {
  std::optional<OIIO::ImageBuf> picture;
  if (recipe.shape == TextureRecipe::Shape::Cube)
    picture = unfoldCube(recipe, error);
  else if (OIIO::ImageBuf whole; readWhole(recipe.pictures.front(), whole, error))
    picture = recipe.greyAsColor ? withoutGrey(whole) : std::move(whole);
  if (!picture) return Making::Unreadable;
  const fs::path beside = throughLinks(recipe.file).parent_path();
  return write(*picture, recipe, recipe.file, beside, false, error) ? Making::Done : Making::Unwritable;
}

std::string tiledFile(const std::string& picture, const std::string& folder, std::string& error, std::string& note) {
  if (isTiledMip(picture, error)) return picture;
  if (!error.empty()) return {};
  const auto content = bytesOf(picture);
  if (!content) {
    error = "it cannot be read";
    return std::string();
  }
  const std::string name = fmt::format("{:016x}.tx", checksum(*content));
  const fs::path file = fs::path(folder) / name.substr(0, 2) / name;
  if (isSealed(file.string())) return file.string();
  std::error_code problem, none;
  fs::create_directories(file.parent_path(), problem);
  std::optional<FolderLock> lock;
  try {
    lock.emplace(file.parent_path(), [] {});  // another process of this machine may be converting the picture
  } catch (const Stopped&) {
    return picture;  // the frame is given up
  }
  if (isSealed(file.string())) return file.string();
  if (fs::exists(file, none))
    note = fmt::format("\"{}\" is damaged, or of an earlier version: \"{}\" is converted anew", file.string(), picture);
  OIIO::ImageBuf whole;
  if (!readWhole(picture, whole, error)) return {};
  TextureRecipe recipe;
  // Beyond its edges a picture is black, as with the tools of other renderers, unless its file says otherwise.
  const std::string wraps = whole.spec().get_string_attribute("wrapmodes");
  if (const size_t comma = wraps.find(','); comma != std::string::npos) {
    recipe.sWrap = wraps.substr(0, comma);
    recipe.tWrap = wraps.substr(comma + 1);
  }
  // A cache that cannot be written only costs time and memory: OpenImageIO makes the levels in memory.
  if (problem || !write(whole, recipe, file.string(), folder, true, error)) {
    error.clear();
    return picture;
  }
  return file.string();
}

}  // namespace tomales
