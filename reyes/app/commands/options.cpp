#include "reyes/app/commands/options.h"

#include <fmt/format.h>

#include "reyes/image.h"
#include "reyes/image_files.h"
#include "reyes/state.h"

namespace tomales {
namespace {

void addConventions(CLI::App& app, RenderSettings& s) {
  app.add_option("--specular", s.picture.specular,
                 "Exponent of specular(): 8/roughness as PRMan has it, or 1/roughness as RISpec and BMRT have it "
                 "(default: what the scene states or, if it states nothing, what its requests suggest)")
      ->check(CLI::IsMember({"prman", "rispec"}))
      ->type_name("prman|rispec");
  app.add_option(
         "--arealight", s.picture.arealight,
         "Meaning of intensity of arealight: radiance, or intensity / distance^2 as BMRT had it (default: found as "
         "for --specular)")
      ->check(CLI::IsMember({"radiance", "bmrt"}))
      ->type_name("radiance|bmrt");
  app.add_option_function<std::string>(
         "--standard-shaders", [&s](const std::string& t) { s.input.standardFromFiles = t == "files"; },
         "Which shaders have the names of RISpec, such as plastic: the built-in ones, or files of these names if there "
         "are any (default: files that have parameters which the built-in shader lacks)")
      ->check(CLI::IsMember({"built-in", "files"}))
      ->type_name("built-in|files");
}

}  // namespace

CLI::Validator between(double least, double most) {
  const auto problem = [least, most](const std::string& text) {
    double value = 0;
    const bool inside = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return inside ? std::string()
                  : "\"" + text + "\" is no number from " + CLI::detail::to_string(least) + " to " +
                        CLI::detail::to_string(most);
  };
  return {[problem](std::string& text) { return problem(text); }, ""};
}

void refuseOptionsAsValues(CLI::App& app) {
  const auto problem = [](const std::string& text) {
    const bool option = text.size() > 1 && text[0] == '-' && (text[1] == '-' || std::isalpha(text[1]));
    return option ? "\"" + text + "\" stands where a value is missing" : std::string();
  };
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* o : command->get_options())
      if (!o->get_positional() && o->get_items_expected_min() > 0) o->check(problem);
}

std::optional<std::string> parseOutput(const std::string& text) {
  return namesPicture(text) ? std::optional(text) : std::nullopt;
}

void addOutput(CLI::App& app, PictureSettings& s) {
  addParsed(app, "-o", s.output, parseOutput, pictureNames(),
            "Write here instead of to the first Display, other pictures beside it; # stands for the frame number, "
            "but in the names of folders that exist. "
            "PNG: rgb, in sRGB unless the scene's Exposure has a gamma (everything else is linear, also a PNG of a "
            "Display). A scene without Display writes ri.exr");
  app.add_flag("--one-picture", s.onePicture, "With -o: leave out the scene's other Displays, shadow maps excepted")
      ->needs("-o");
}

void addCrop(CLI::App& app, PictureSettings& s) {
  addParsed(app, "--crop", s.crop, parseCrop, "X0,X1,Y0,Y1",
            "Part of the frame, 0..1 from the top left (default: CropWindow)",
            ": numbers from 0 to 1 are allowed, X0 below X1 and Y0 below Y1");
  app.add_flag(
         "--overwrite", s.overwrite,
         "With --crop: write over pictures of the scene that hold more. Without it they are kept, and the crop of "
         "a.exr goes to a_crop.exr")
      ->needs("--crop");
}

void addFrameSize(CLI::App& app, RenderSettings& s) {
  constexpr int kMostPixels = 65536, kMostSamples = 64;
  const auto format = [](const std::string& t) { return parsePair(t, 1, kMostPixels); };
  const Options unasked;  // the options of a scene that sets none
  const auto pixelSamples = [](const std::string& t) { return parsePair(t, 1, kMostSamples); };
  addParsed(
      app, "--format", s.picture.format, format, "WxH",
      fmt::format("Resolution in pixels (default: the scene's, or {}x{})", unasked.xResolution, unasked.yResolution),
      fmt::format(": whole numbers from 1 to {} are allowed", kMostPixels));
  addParsed(app, "--pixel-samples", s.picture.pixelSamples, pixelSamples, "NxM",
            fmt::format("Samples of a pixel (default: the scene's, or {}x{})", unasked.xSamples, unasked.ySamples),
            fmt::format(": whole numbers from 1 to {} are allowed", kMostSamples));
  app.add_option("--shading-rate", s.picture.shadingRate,
                 "Area of a micropolygon in pixels (default: as objects ask, or 1)")
      ->check(between(1e-3, 1e6));
  app.add_option("--seed", s.picture.seed, fmt::format("Seed of all random numbers (default {})", s.picture.seed));
  app.add_option("--bucket-size", s.resources.bucketSize,
                 fmt::format("Edge of a bucket in pixels (default: the scene's, or {})", unasked.bucketWidth))
      ->check(CLI::Range(1, 4096));
}

void addPictureOptions(CLI::App& app, RenderSettings& s) {
  addFrameSize(app, s);
  addCrop(app, s.picture);
  app.add_flag("--draft", s.picture.draft,
               "Coarse and fast, for placing lights: 50 gather rays, no displacement, micropolygons of 16 times the "
               "area, 2x2 samples");
  addParsed(app, "--frames", s.input.frames, parseFrames, "1-10x2,15", "Only these frames (default: all)",
            ": ranges rise, and at most a million frames are allowed");
  addFramesApart(app, s.input);
  addParsed(app, "--makes", s.input.makes, parseFrames, "0-3,5",
            "Only these Make requests, such as MakeTexture, counted from 0; \"none\" runs none (default: all)");
}

void addFramesApart(CLI::App& app, InputSettings& s) {
  app.add_flag("--frames-apart", s.framesApart,
               "Promise that no request in a frame of the RIB, such as Declare, concerns later frames: frames that are "
               "not asked for are then skipped unread");
}

void addRunOptions(CLI::App& app, RenderSettings& s) {
  app.add_option("-t", s.resources.threads, "Threads (default: all)")->check(CLI::Range(1, 4096));
  app.add_option("--stats", s.report.statsFile, "Statistics as JSON; # is the frame's number; .jsonl gets a line each")
      ->type_name("FILE.json");
  app.add_flag("--stats-header", s.report.statsHeader, "Statistics in the headers of OpenEXR pictures too");
  app.add_option("--log", s.report.logFile, "Append all messages, with the time, and what each frame took")
      ->type_name("FILE");
  app.add_flag("--profile-shaders", s.report.profileShaders, "Points and time of each shader, at the end");
  app.add_flag("--progress", s.report.progress, "Show progress: a bar on a terminal, else lines for render farms");
  addParsed(app, "--texture-memory", s.resources.textureMemory, parseBytes, "600M",
            "Memory for tiles of pictures (default 1G)");
  app.add_option("--texture-cache", s.resources.textureCache,
                 "Where converted pictures are kept (default: $TOMALES_TEXTURE_CACHE, or the user's cache folder)")
      ->type_name("FOLDER");
  addTrust(app, s.input.trust);
  app.add_option("--output-root", s.picture.outputRoot,
                 "Keep all files that the RIB writes below this folder; names that lead out of it are refused")
      ->type_name("FOLDER");
  addConventions(app, s);
  app.add_flag("--strict", s.report.strict,
               "Warnings end with exit code 3: the picture may not be what the scene asks for");
  app.add_flag_callback(
      "-q", [&s] { s.report.verbosity = Log::Verbosity::Quiet; }, "No warnings");
  app.add_flag_callback(
      "-v", [&s] { s.report.verbosity = Log::Verbosity::Verbose; },
      "Print more, such as the files, time and memory of each frame");
}

void addWatching(CLI::App& app, RenderSettings& s) {
  app.add_flag("--audit{300}", s.quality.audit,
               "Measure the error of the picture: the light of 300 of its pixels, or of N (--audit=N), is computed "
               "again with many rays")
      ->check(CLI::Range(20, 1'000'000));
  app.add_flag("--preview{127.0.0.1:14158}", s.report.preview,
               "Show rows as they are made, in a tev viewer that listens there (--preview=HOST:PORT)");
  app.add_option_function<std::vector<std::string>>(
         "--pixel",
         [&s](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const auto pixel = parsePixel(text);
             if (!pixel) throw CLI::ValidationError("--pixel", "\"" + text + "\" is not of the form X,Y");
             s.report.pixels.push_back(*pixel);
           }
         },
         "Print what the samples of a pixel see; may be given again")
      ->expected(1)
      ->take_all()
      ->type_name("X,Y");
}

}  // namespace tomales
