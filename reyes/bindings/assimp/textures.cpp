#include "reyes/bindings/assimp/textures.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>

#include "reyes/base/input_file.h"
#include "reyes/bindings/assimp/nodes.h"
#include "reyes/pictures.h"

namespace tomales::model {
namespace {

namespace fs = std::filesystem;

const char* wrapOf(aiTextureMapMode mode) {
  switch (mode) {
    case aiTextureMapMode_Clamp:
      return "clamp";
    case aiTextureMapMode_Mirror:
      return "mirror";
    case aiTextureMapMode_Decal:
      return "black";
    default:
      return "periodic";
  }
}

/// `%20` is a blank in URIs.
std::string withoutEscapes(const std::string& uri) {
  std::string out;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool isEscape = uri[i] == '%' && i + 2 < uri.size() &&
                          std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                          std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    out += isEscape ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (isEscape) i += 2;
  }
  return out;
}

/// Returns the file of this name beside the model, also if the name is a path of Windows. If there is none, it looks
/// for the last part of the name, because models outlive the folders they were made in.
std::string foundBeside(const std::string& model, const std::string& name) {
  std::string slashed = withoutEscapes(name);
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path folder = fs::path(model).parent_path(), last = fs::path(slashed).filename();
  if (last.empty() || slashed.find('\0') != std::string::npos) return "";
  for (const fs::path& file : {folder / name, folder / slashed, folder / last, folder / "textures" / last})
    if (inputProblem(file).empty()) return file.string();
  return "";
}

/// Returns an uncompressed Targa file, whose channels have the order of aiTexel.
std::string targaOf(const aiTexture& texture) {
  std::string out(18, '\0');
  out[2] = 2;
  out[16] = 32;
  out[17] = 0x28;
  for (int k = 0; k < 2; ++k) {
    out[static_cast<size_t>(12 + k)] = static_cast<char>(texture.mWidth >> (8 * k));
    out[static_cast<size_t>(14 + k)] = static_cast<char>(texture.mHeight >> (8 * k));
  }
  const size_t texels = size_t{texture.mWidth} * texture.mHeight;
  return out.append(reinterpret_cast<const char*>(texture.pcData), texels * sizeof(aiTexel));
}

}  // namespace

std::string Textures::file(const std::string& name, aiTextureMapMode sWrap, aiTextureMapMode tWrap) {
  const char *s = wrapOf(sWrap), *t = wrapOf(tWrap);
  const auto [made, isNew] = made_.try_emplace(fmt::format("{} {} {}", s, t, name));
  if (isNew) made->second = convert(name, s, t);
  return made->second;
}

/// Returns the file of a picture. A picture inside the model is first written below the folder of parts.
std::string Textures::pictureOf(const std::string& name) const {
  const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str());
  if (!inside || !inside->pcData) return foundBeside(settings_.model, name);
  constexpr unsigned kMostSide = 65535;
  const bool isFile = inside->mHeight == 0;
  if (!isFile && std::max(inside->mWidth, inside->mHeight) > kMostSide) return "";
  std::string path = settings_.scene + (isFile ? ".picture" : ".tga");
  writePart(path,
            isFile ? std::string(reinterpret_cast<const char*>(inside->pcData), inside->mWidth) : targaOf(*inside));
  return path;
}

std::string Textures::convert(const std::string& name, const char* sWrap, const char* tWrap) {
  const auto report = [&](const std::string& what) {
    log_.report(Severity::Missing, "import-texture", {std::make_shared<const std::string>(settings_.model), 0},
                fmt::format("texture \"{}\" {}; its material does without", name, what));
    return std::string();
  };
  const std::string picture = pictureOf(name);
  if (picture.empty()) return report("is neither in the model nor beside it");
  const Parts::Place place = parts_.reserve(fs::path(name).stem().string(), ".tx");
  TextureRecipe recipe;
  recipe.pictures = {picture};
  recipe.file = place.path;
  recipe.sWrap = sWrap;
  recipe.tWrap = tWrap;
  recipe.greyAsColor = true;  // materials count on alpha as the fourth channel
  std::string error;
  if (makeTexture(recipe, error) != Making::Done) return report("cannot be read: " + error);
  return place.name;
}

}  // namespace tomales::model
