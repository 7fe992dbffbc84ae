#include "reyes/app/commands/make.h"

#include <fmt/format.h>

#include <set>
#include <span>

#include "reyes/app/commands/atlas_commands.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/base/output_root.h"
#include "reyes/base/search_path.h"
#include "reyes/image.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

void warnAboutParams(const Request& r, std::span<const std::string_view> known, Log& log) {
  for (const Param& p : r.params)
    if (std::find(known.begin(), known.end(), p.name) == known.end())
      log.report(Severity::Warning, "make-parameter", r.where,
                 fmt::format("{}: there is no \"{}\"; ignored", r.name, p.name));
}

/// Translates RenderMan's names of filters to those of OpenImageIO.
std::string filterOf(const Request& r, const std::string& name, Log& log) {
  static const std::set<std::string> known = {
      "box", "triangle", "gaussian", "catmull-rom", "mitchell", "blackman-harris", "sinc", "disk", "lanczos3"};
  if (name == "lanczos") return "lanczos3";
  if (known.contains(name)) return name;
  log.report(Severity::Warning, "make-filter", r.where,
             fmt::format("{}: there is no filter \"{}\"; box is used", r.name, name));
  return "box";
}

std::string wrapOf(const Request& r, const std::string& name, Log& log) {
  static const std::set<std::string> known = {"black", "clamp", "periodic", "mirror"};
  if (known.contains(name)) return name;
  log.report(Severity::Warning, "make-wrap", r.where,
             fmt::format("{}: there is no wrap mode \"{}\"; black is used", r.name, name));
  return "black";
}

TextureRecipe recipeOf(const Request& r, Log& log) {
  const auto text = [&](size_t i) { return r.args[i].strings[0]; };
  TextureRecipe recipe;
  if (r.name == "MakeCubeFaceEnvironment") {
    recipe.shape = TextureRecipe::Shape::Cube;
    for (size_t face = 0; face < 6; ++face) recipe.pictures.push_back(text(face));
    recipe.file = text(6);
    recipe.fov_degrees = r.args[7].number();
    recipe.filter = filterOf(r, text(8), log);
    if (!(recipe.fov_degrees >= 90 && recipe.fov_degrees < 179)) {
      log.report(Severity::Warning, "make-fov", r.where,
                 fmt::format("{}: faces of {} degrees do not close a cube; 90 is used", r.name, recipe.fov_degrees));
      recipe.fov_degrees = 90;
    }
  } else if (r.name == "MakeLatLongEnvironment") {
    recipe.shape = TextureRecipe::Shape::LatLong;
    recipe.pictures = {text(0)};
    recipe.file = text(1);
    recipe.filter = filterOf(r, text(2), log);
  } else {
    recipe.pictures = {text(0)};
    recipe.file = text(1);
    recipe.sWrap = wrapOf(r, text(2), log);
    recipe.tWrap = wrapOf(r, text(3), log);
    recipe.filter = filterOf(r, text(4), log);
  }
  if (recipe.shape != TextureRecipe::Shape::Picture) {
    recipe.sWrap = "periodic";
    recipe.tWrap = "clamp";
  }
  return recipe;
}

/// Translates the arguments, which are those of PRMan's brickmake.
BrickmakeCommand brickmakeOf(const Request& r, Log& log) {
  static constexpr std::string_view kKnown[] = {"maxerror", "maxdepth", "radiusscale", "ignorenormals"};
  warnAboutParams(r, kKnown, log);
  makeFolderOf(r.args[1].strings[0]);
  BrickmakeCommand command{r.args[0].strings, r.args[1].strings[0], {}};
  BrickSettings& s = command.settings;
  const auto number = [&](std::string_view name, float fallback, float least, float most) {
    const Param* p = findParam(r.params, name);
    if (!p) return fallback;
    const float given = p->number(fallback);
    if (given >= least && given <= most) return given;
    log.report(Severity::Warning, "make-brickmap", r.where,
               fmt::format("{}: \"{}\" is {:g} and must be from {:g} to {:g}; {:g} is used", r.name, name, given, least,
                           most, fallback));
    return fallback;
  };
  s.maxError = number("maxerror", s.maxError, 0, 1e9f);
  s.maxDepth = static_cast<int>(number("maxdepth", static_cast<float>(s.maxDepth), 0, 20));
  s.radiusScale = number("radiusscale", s.radiusScale, 1e-3f, 1e3f);
  command.oneFile = true;
  s.ignoreNormals = number("ignorenormals", 0, 0, 1) != 0;
  return command;
}

void makeBrickMap(const Request& r, Log& log) {
  try {
    makeBrickMaps(brickmakeOf(r, log));
  } catch (const std::runtime_error& e) {  // FileError, or an error of the file system
    log.report(severityOfLoss(e), "make-brickmap", r.where,
               fmt::format("{}: \"{}\" cannot be made ({})", r.name, r.args[1].strings[0], e.what()));
  }
}

/// Returns the request with its files' names below the root. Throws WriteError.
Request placed(const Request& request, const std::string& root) {
  Request out = request;
  const size_t target = request.name == "MakeCubeFaceEnvironment" ? 6 : 1;
  for (size_t i = 0; i < target; ++i)
    for (std::string& source : out.args[i].strings)
      if (const std::string found = findFile(source, root); !found.empty()) source = found;
  for (std::string& file : out.args[target].strings) file = placeBelow(root, file);
  return out;
}

void perform(const Request& r, Log& log) {
  if (r.name == "MakeBrickMap") return makeBrickMap(r, log);
  warnAboutParams(r, {}, log);
  if (r.name == "MakeShadow") {
    makeFolderOf(r.args[1].strings[0]);
    makeShadow(r.args[0].strings[0], r.args[1].strings[0], r.where, log);
    return;
  }
  const TextureRecipe recipe = recipeOf(r, log);
  makeFolderOf(recipe.file);
  std::string error;
  if (const Making made = makeTexture(recipe, error); made != Making::Done)
    log.report(
        severityOf(made), "make-texture", r.where,
        fmt::format("{}: \"{}\" cannot be made of \"{}\" ({})", r.name, recipe.file, recipe.pictures.front(), error));
}

}  // namespace

void performMake(const Request& request, const std::string& outputRoot, Log& log) {
  try {
    perform(placed(request, outputRoot), log);
  } catch (const WriteError& e) {
    log.report(Severity::Output, "output-root", request.where, fmt::format("{}: {}", request.name, e.what()));
  }
}

}  // namespace tomales
