#include "reyes/app/commands/foreign_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "reyes/base/text.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

struct Foreign {
  std::string_view endings;  ///< Each has a blank before and after it.
  const char* what;
  const char* remedy;  ///< {} stands for the file.
};

constexpr const char* kExport = "export the scene as RIB from the program that made it";
constexpr const char* kModel = "tomales import {} -o FILE.rib makes a scene of it";
constexpr Foreign kForeign[] = {
    {" .sl ", "the text of a shader",
     "Surface \"NAME\" in a scene beside it uses it; tomales compile {} checks it, tomales shadetest {} runs it"},
    {" .slo .sdr .slx .slc .sdl ", "a shader that another renderer has compiled",
     "put the text of the shader, its .sl, beside the scene that names it"},
    {" .oso .osl ", "a shader in Open Shading Language", "shaders are written in RenderMan's language (.sl) or in C++"},
    {" .so .dylib .dll ", "a plugin", "a scene names what it needs of it; tomales info {} says what it holds"},
    {" .dfb ", "a deep frame buffer", "tomales shade {} -o FILE.exr makes a picture of it"},
    {" .icf ", "an irradiance cache",
     "tomales shade SHOT.dfb --irradiance {} uses it, tomales view {} -o FILE.png shows it"},
    {" .ptc .bkm ", "a point cloud or brick map", "tomales view {} -o FILE.png shows it"},
    {" .obj ", "a model in Wavefront's format", kModel},
    {" .ply .stl .off .3ds ", "a model", kModel},
    {" .fbx .gltf .glb .dae ", "a model or scene in a format for exchange", kModel},
    {" .abc ", "a scene in a format for exchange", kExport},
    {" .usd .usda .usdc .usdz ", "a stage of OpenUSD", kExport},
    {" .blend .ma .mb .max .hip .hipnc .c4d .xsi .lwo ", "a modeller's own file", kExport},
    {" .pbrt .mi .pov .ass .vrscene .nk ", "a scene for another program", "only RIB is read"},
    {" .exr .tif .tiff .png .jpg .jpeg .tx .tex .hdr .tga ", "a picture",
     "tomales info {} describes it; a scene uses it as a texture"},
    {" .py ", "a program in Python",
     "run it with python3; if it writes RIB, render what it writes, or: python3 {} | tomales -"},
    {" .zip .tar .tgz .7z .rar ", "an archive of files", "unpack it and render a RIB file in it"},
};

/// OpenEXR, TIFF and BigTIFF in both orders of bytes, PNG, JPEG and Radiance, as their specifications have it.
constexpr std::string_view kPictureMagic[] = {
    {"\x76\x2f\x31\x01", 4}, {"II*\0", 4},        {"MM\0*", 4}, {"II+\0", 4}, {"MM\0+", 4},
    {"\x89PNG\r\n", 6},      {"\xff\xd8\xff", 3}, "#?RADIANCE", "#?RGBE"};

bool beginsAsPicture(const std::string& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return false;  // a pipe gives its bytes only once
  char bytes[16] = {};
  std::ifstream in(file, std::ios::binary);
  in.read(bytes, sizeof bytes);
  const std::string_view begin(bytes, static_cast<size_t>(in.gcount()));
  return std::any_of(std::begin(kPictureMagic), std::end(kPictureMagic),
                     [&](std::string_view magic) { return begin.starts_with(magic); });
}

const Foreign* kindOfEnding(const std::string& ending) {
  if (ending.empty() || ending.find(' ') != std::string::npos) return nullptr;
  const auto* kind = std::find_if(std::begin(kForeign), std::end(kForeign), [&](const Foreign& f) {
    return f.endings.find(" " + ending + " ") != std::string_view::npos;
  });
  return kind == std::end(kForeign) ? nullptr : kind;
}

}  // namespace

bool isPicture(const std::string& file) {
  const std::vector<std::string>& endings = pictureEndings();
  return std::find(endings.begin(), endings.end(), endingOf(file)) != endings.end() || beginsAsPicture(file);
}

bool isForeign(const std::string& file, Log& log) {
  const Foreign* const named = kindOfEnding(endingOf(file));
  const Foreign* const kind = !named && beginsAsPicture(file) ? kindOfEnding(".exr") : named;
  if (!kind) return false;
  std::string remedy = kind->remedy;
  for (size_t at = remedy.find("{}"); at != std::string::npos; at = remedy.find("{}", at + file.size()))
    remedy.replace(at, 2, file);
  log.report(Severity::Error, "not-rib", {std::make_shared<const std::string>(file), 0},
             fmt::format("is {} by its {}, and no RIB: {}", kind->what, named ? "name" : "first bytes", remedy));
  return true;
}

bool isAnyForeign(const std::vector<std::string>& files, Log& log) {
  return std::count_if(files.begin(), files.end(), [&](const std::string& f) { return isForeign(f, log); }) > 0;
}

}  // namespace tomales
