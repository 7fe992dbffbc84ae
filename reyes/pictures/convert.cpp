#include "reyes/pictures/convert.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "reyes/base/checksum.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

std::string oiioError() {
  std::string text = OIIO::geterror();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.empty() ? "it cannot be read" : text;
}

/// A name beside `file` that no other thread or process writes to.
std::string temporaryName(const std::string& file) {
  static std::atomic<int> number{0};
  return fmt::format("{}.{}.{}.part", file, ::getpid(), number++);
}

bool moveInto(const std::string& temporary, const std::string& file, std::string& error) {
  std::error_code problem;
  fs::rename(temporary, file, problem);
  if (problem) error = fmt::format("\"{}\" cannot be written: {}", file, problem.message());
  return !problem;
}

/// Every texel is read here: a truncated picture is found out before anything is made of it. By an ImageInput, since an
/// ImageBuf takes strips of TIFF that are cut off for read: OpenImageIO returns true and leaves a message.
bool readWhole(const std::string& file, OIIO::ImageBuf& picture, std::string& error) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) return error = oiioError(), false;
  OIIO::ImageSpec spec = in->spec();
  if (spec.deep) return error = "it is a deep picture", false;
  spec.channelformats.clear();
  picture.reset(spec);
  const bool read = in->read_image(0, 0, 0, spec.nchannels, spec.format, picture.localpixels());
  error = in->geterror();
  error = error.substr(0, error.find('\n'));
  if (!read && error.empty()) error = "it cannot be read";
  return error.empty();
}

bool write(const OIIO::ImageBuf& picture, const TextureRecipe& recipe, const std::string& file, std::string& error) {
  OIIO::ImageSpec config;
  const bool exr = fs::path(file).extension() == ".exr";
  config.attribute("maketx:fileformatname", exr ? "openexr" : "tiff");
  config.attribute("maketx:filtername", recipe.filter);
  config.attribute("wrapmodes", recipe.sWrap + "," + recipe.tWrap);
  const std::string temporary = temporaryName(file);
  if (OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, picture, temporary, config))
    return moveInto(temporary, file, error);
  error = oiioError();
  std::error_code none;
  fs::remove(temporary, none);
  return false;
}

bool isTiledMip(const std::string& file, std::string& error) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) return error = oiioError(), false;
  return in->spec().tile_width > 0 && in->seek_subimage(0, 1);
}

std::optional<uint64_t> contentSum(const std::string& file) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return std::nullopt;
  Bytes bytes(static_cast<size_t>(in.tellg()));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return in ? std::optional(checksum(bytes)) : std::nullopt;
}

}  // namespace

bool convert(const TextureRecipe& recipe, std::string& error) {
  if (recipe.shape == TextureRecipe::Shape::Cube) {
    const auto picture = unfoldCube(recipe, error);
    return picture && write(*picture, recipe, recipe.file, error);
  }
  OIIO::ImageBuf picture;
  return readWhole(recipe.pictures.front(), picture, error) && write(picture, recipe, recipe.file, error);
}

std::string tiledFile(const std::string& picture, const std::string& folder, std::string& error) {
  if (isTiledMip(picture, error)) return picture;
  if (!error.empty()) return {};
  const auto sum = contentSum(picture);
  if (!sum) return error = "it cannot be read", std::string();
  const std::string name = fmt::format("{:016x}.tx", *sum);
  const fs::path file = fs::path(folder) / name.substr(0, 2) / name;
  std::error_code problem;
  if (fs::exists(file, problem)) return file.string();
  OIIO::ImageBuf whole;
  if (!readWhole(picture, whole, error)) return {};
  fs::create_directories(file.parent_path(), problem);
  TextureRecipe recipe;
  // A cache that cannot be written costs time and memory, and nothing else: OpenImageIO makes the levels in memory.
  if (problem || !write(whole, recipe, file.string(), error)) return error.clear(), picture;
  return file.string();
}

}  // namespace tomales
