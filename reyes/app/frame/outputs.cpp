#include "reyes/app/frame/outputs.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>

#include "reyes/base/output_root.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/camera.h"
#include "reyes/image.h"
#include "reyes/image_files.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Tells whether later frames read the file of a Display, by its type or through a Make request.
bool feedsFrames(const DisplayCall& d, const RenderSettings& settings) {
  return writesMap(d) || settings.input.sources.contains(fs::path(d.name).lexically_normal().string());
}

/// Sets up a Display for pictures to be looked at: without alpha, and in sRGB unless the scene's Exposure encodes
/// already.
void writeForScreens(DisplayCall& display, const Options& options) {
  display.mode = "rgb";
  if (options.exposureGamma != 1 || findParam(display.params, "transfer")) return;
  Param transfer;
  transfer.name = "transfer";
  transfer.type = ValueType::String;
  transfer.strings = {"sRGB"};
  display.params.push_back(std::move(transfer));
}

/// Returns the name of another Display's file beside `output`, which takes the place of `first`.
std::string beside(const std::string& output, const std::string& first, const std::string& other) {
  const fs::path to(output), from(other);
  const std::string replaced = fs::path(first).stem().string(), stem = from.stem().string();
  const std::string rest = stem.starts_with(replaced) ? stem.substr(replaced.size()) : "_" + stem;
  return (to.parent_path() / (to.stem().string() + rest + from.extension().string())).string();
}

/// Applies -o. Returns the names that it has given.
std::set<std::string> replaceByOutput(Options& options, const RenderSettings& settings) {
  std::vector<DisplayCall>& displays = options.displays;
  const auto isMap = [&](const DisplayCall& d) { return feedsFrames(d, settings); };
  const auto first = std::find_if_not(displays.begin(), displays.end(), isMap);
  if (first == displays.end()) return {};
  if (settings.picture.onePicture)
    displays.erase(std::remove_if(first + 1, displays.end(), std::not_fn(isMap)), displays.end());
  const std::string output = withFrameNumber(settings.picture.output, options.frame);
  std::set<std::string> names{output};
  const PluginTrust trust = pluginTrust(settings);
  const bool staysBelowRoot = !settings.picture.outputRoot.empty();  // what the RIB names does, by its own name
  for (auto other = first + 1; other != displays.end() && !staysBelowRoot; ++other) {
    if (isMap(*other) || !driverOf(*other, options, trust).empty()) continue;
    other->name = beside(output, first->name, other->name);
    names.insert(other->name);
  }
  first->name = output;
  first->type = "file";
  if (isForScreens(settings.picture.output)) writeForScreens(*first, options);
  return names;
}

/// Moves files that the scene writes to below the root, and also where they are read again, but not files that the user
/// named. A .dfb or .icf as output stands for all Displays, and the scene writes none.
void keepBelow(const RenderSettings& settings, const std::set<std::string>& named, Options& options) {
  const std::string& root = settings.picture.outputRoot;
  const bool writesDisplays = settings.picture.output.empty() || namesPicture(settings.picture.output);
  for (DisplayCall& d : options.displays)
    if (writesDisplays && !named.contains(d.name)) d.name = placeBelow(root, d.name);
  std::string& textures = options.searchPaths["texture"];
  textures = root + ":" + textures;
  std::string& converted = options.searchPaths["texturecache"];
  if (!converted.empty()) converted = placeBelow(root, converted);
}

/// Leaves out, with a message, Displays that would write over an earlier one's file, and windows beside files. A user
/// who names a file wants that picture there, so it is no fault of the scene then.
void dropDisplays(Options& options, const std::set<std::string>& named, const PluginTrust& trust, Log& log) {
  const auto isWindow = [&](const DisplayCall& d) {
    if (!driverOf(d, options, trust).empty()) return false;
    return d.type == "framebuffer" || d.type == "it" || d.type == "windows" || d.type == "x11";
  };
  const bool someFile =
      std::any_of(options.displays.begin(), options.displays.end(), [&](const DisplayCall& d) { return !isWindow(d); });
  std::set<std::string> places;
  std::erase_if(options.displays, [&](const DisplayCall& d) {
    if (someFile && isWindow(d)) {
      log.report(Severity::Note, "display-window", d.where,
                 "Display \"" + d.name + "\" of type " + d.type + ": there are no windows; left out beside the file");
      return true;
    }
    if (d.type == "null" || places.insert(placeOf(d, options, trust)).second) return false;
    log.report(named.contains(d.name) ? Severity::Note : Severity::Warning, "display-twice", d.where,
               "Display \"" + d.name + "\" would write over an earlier Display of this frame; left out");
    return true;
  });
}

/// Tells whether a file holds more pixels than the rectangle. A file that cannot be read counts as if it did.
bool holdsMore(const std::string& file, const PixelRect& crop) {
  std::error_code failed;
  if (!fs::is_regular_file(file, failed)) return false;
  std::string error;
  const auto picture = openPicture(file, error);
  if (!picture) return true;
  const PictureShape& shape = picture->shape();
  return int64_t{shape.width} * shape.height > int64_t{crop.width()} * crop.height();
}

void keepLargerFiles(Options& options, const std::set<std::string>& named, const PluginTrust& trust, Log& log) {
  const PixelRect crop = Camera(options).crop();
  for (DisplayCall& d : options.displays) {
    if (named.contains(d.name) || !driverOf(d, options, trust).empty() || !holdsMore(fileOf(d), crop)) continue;
    const fs::path kept(fileOf(d));
    d.name = (kept.parent_path() / (kept.stem().string() + "_crop" + kept.extension().string())).string();
    log.report(Severity::Note, "output-kept", d.where,
               "\"" + kept.string() + "\" holds more than the crop and is kept; the crop goes to \"" + d.name +
                   "\" (--overwrite replaces it)");
  }
}

bool replacesNoSource(const DisplayCall& display, const RenderSettings& settings, Log& log) {
  if (!isAmong(fileOf(display), settings.input.files)) return true;
  log.report(Severity::Output, "image-write", display.where,
             "\"" + fileOf(display) + "\" could not be written: it would replace the scene");
  return false;
}

}  // namespace

bool writesMapsAlone(const Options& options, const RenderSettings& settings) {
  return !options.displays.empty() && std::all_of(options.displays.begin(), options.displays.end(),
                                                  [&](const DisplayCall& d) { return feedsFrames(d, settings); });
}

void nameOutputs(Options& options, const RenderSettings& settings, Log& log) {
  if (options.displays.empty()) options.displays.emplace_back();
  const PluginTrust trust = pluginTrust(settings);
  std::set<std::string> named;
  if (namesPicture(settings.picture.output)) named = replaceByOutput(options, settings);
  if (!settings.picture.outputRoot.empty()) keepBelow(settings, named, options);
  dropDisplays(options, named, trust, log);
  if (settings.picture.crop && !settings.picture.overwrite && !writesMapsAlone(options, settings))
    keepLargerFiles(options, named, trust, log);
}

std::string placeOf(const DisplayCall& display, const Options& options, const PluginTrust& trust) {
  const std::string driver = driverOf(display, options, trust);
  return driver.empty() ? placeOf(fileOf(display)) : driver + " " + display.name;
}

void makeFolderOf(const std::string& file) {
  const fs::path folder = std::filesystem::path(file).parent_path();
  std::error_code failed;  // if this fails, the folder is missing still
  if (folder.is_relative() && !folder.empty()) fs::create_directories(folder, failed);
}

bool hasFolder(const std::string& file, const SourceLoc& where, Log& log) {
  fs::path folder = std::filesystem::path(file).parent_path();
  if (folder.empty()) folder = ".";
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return true;
  log.report(
      Severity::Output, "output-folder", where,
      "\"" + file + "\" cannot be written: its folder is missing or cannot be written to; the frame was not rendered");
  return false;
}

bool displaysAreWritable(const Options& options, const RenderSettings& settings, Log& log) {
  const PluginTrust trust = pluginTrust(settings);
  bool all = true;
  for (const DisplayCall& display : options.displays) {
    if (display.type == "null" || !driverOf(display, options, trust).empty()) continue;
    makeFolderOf(display.name);
    all = hasFolder(display.name, display.where, log) && replacesNoSource(display, settings, log) && all;
  }
  if (!all || displaysCanBegin(options, trust, log)) return all;
  log.report(Severity::Output, "frame-unwritable", {},
             "the frame was not rendered, because not all of its Displays can be written");
  return false;
}

}  // namespace tomales
