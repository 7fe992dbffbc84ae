#include "reyes/app/commands/options.h"

#include <fmt/format.h>

#include "reyes/base/deep_stack.h"
#include "reyes/image.h"
#include "reyes/state.h"

namespace tomales {
namespace {

const std::string kRangeOfShares = ": more than 0% and less than 100% are allowed";
const std::string kRangeOfTimes = ": more than 0 s are needed";

const GiMethod* giOrUsageError(const std::string& text) {
  if (const auto method = parseGi(text)) return *method;
  throw CLI::ValidationError("--gi", "\"" + text + "\" is none of scene, " + giMethodNames());
}

void addConventions(CLI::App& app, RenderSettings& s) {
  app.add_option("--specular", s.specular,
                 "Exponent of specular(): 8/roughness as PRMan has it, or 1/roughness as RISpec and BMRT have it "
                 "(default: what the scene states or, if it states nothing, what its requests suggest)")
      ->check(CLI::IsMember({"prman", "rispec"}))
      ->type_name("prman|rispec");
  app.add_option(
         "--arealight", s.arealight,
         "Meaning of intensity of arealight: radiance, or intensity / distance^2 as BMRT had it (default: found as "
         "for --specular)")
      ->check(CLI::IsMember({"radiance", "bmrt"}))
      ->type_name("radiance|bmrt");
  app.add_option_function<std::string>(
         "--standard-shaders", [&s](const std::string& t) { s.standardFromFiles = t == "files"; },
         "Shaders of RISpec's names, such as plastic, are built-in (default), or files of these names where there are "
         "such")
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

void addOutput(CLI::App& app, RenderSettings& s) {
  addParsed(app, "-o", s.output, parseOutput, pictureNames(),
            "Write here instead of to the first Display, other pictures beside it; # stands for the frame number. "
            "PNG: rgb, "
            "in sRGB unless the scene's Exposure has a gamma (all else is linear, a Display's own PNG too). A scene "
            "without Display writes ri.exr");
  app.add_flag("--one-picture", s.onePicture, "With -o: leave out the scene's other Displays, shadow maps excepted")
      ->needs("-o");
}

void addCrop(CLI::App& app, RenderSettings& s) {
  addParsed(app, "--crop", s.crop, parseCrop, "X0,X1,Y0,Y1",
            "Part of the frame, 0..1 from the top left (default: CropWindow)");
  app.add_flag(
         "--overwrite", s.overwrite,
         "With --crop: write over pictures of the scene that hold more. Without it they are kept, and the crop of "
         "a.exr goes to a_crop.exr")
      ->needs("--crop");
}

void addFrameSize(CLI::App& app, RenderSettings& s) {
  const auto format = [](const std::string& t) { return parsePair(t, 1, 65536); };
  const Options unasked;  // the options of a scene that sets none
  const auto pixelSamples = [](const std::string& t) { return parsePair(t, 1, 64); };
  addParsed(
      app, "--format", s.format, format, "WxH",
      fmt::format("Resolution in pixels (default: the scene's, or {}x{})", unasked.xResolution, unasked.yResolution));
  addParsed(app, "--pixel-samples", s.pixelSamples, pixelSamples, "NxM",
            fmt::format("Samples of a pixel (default: the scene's, or {}x{})", unasked.xSamples, unasked.ySamples));
  app.add_option("--shading-rate", s.shadingRate, "Area of a micropolygon in pixels (default: as objects ask, or 1)")
      ->check(between(1e-3, 1e6));
  app.add_option("--seed", s.seed, fmt::format("Seed of all random numbers (default {})", s.seed));
  app.add_option("--bucket-size", s.bucketSize,
                 fmt::format("Edge of a bucket in pixels (default: the scene's, or {})", unasked.bucketWidth))
      ->check(CLI::Range(1, 4096));
}

void addPictureOptions(CLI::App& app, RenderSettings& s) {
  addFrameSize(app, s);
  addCrop(app, s);
  app.add_flag("--draft", s.draft,
               "Coarse and fast, to place lights by: 50 gather rays, no displacement, micropolygons of 16 times the "
               "area, 2x2 samples");
  addParsed(app, "--frames", s.frames, parseFrames, "1-10x2,15", "Only these frames (default: all)");
  addFramesApart(app, s);
  addParsed(app, "--makes", s.makes, parseFrames, "0-3,5",
            "Only these of the Make requests, such as MakeTexture, counted from 0; none is a list too (default: all)");
}

void addFramesApart(CLI::App& app, RenderSettings& s) {
  app.add_flag("--frames-apart", s.framesApart,
               "Promise that no request in a frame of the RIB, such as Declare, concerns later frames: frames that are "
               "not asked for are then skipped unread");
}

void addLightOptions(CLI::App& app, RenderSettings& s) {
  app.add_option_function<std::string>(
         "--gi", [&s](const std::string& t) { s.gi = giOrUsageError(t); },
         "Indirect light (default: scene, as the RIB says)")
      ->type_name("scene|" + giMethodNames("|"));
  app.add_option(
         "--samples", s.samples,
         "Gather rays of an irradiance sample, or paths of a point for the reference (default: as the scene asks)")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--bounces", s.bounces, "Most diffuse bounces (default: as the scene asks)")
      ->check(CLI::Range(1, kMostBounces));
  app.add_option("--max-error", s.maxError,
                 "Error allowed in irradiance interpolation; 0 computes every point (default: as the scene asks)")
      ->check(between(0.0, 1e6));
  addParsed(app, "--error-function", s.errorFunction, errorFunctionNamed, errorFunctionNames(),
            "How far an irradiance record may be used (default: as the scene asks)");
  app.add_flag_callback(
      "--indirect-only", [&s] { s.direct = false; }, "Leave out direct light where the eye looks");
  app.add_option("--light-samples", s.lightSamples,
                 "Samples of each area light and of the sky where the eye looks (default: as the lights ask)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--light-seed", s.lightSeed, "Seed of the random numbers of light alone (default: that of --seed)");
  app.add_option("--photons", s.photons,
                 fmt::format("Photons to emit for --gi atlas, progressive and the caustics of reference (default {})",
                             s.photons))
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 40));
  app.add_option("--photon-noise", s.photonNoise,
                 "--gi progressive, and the caustics of reference: send no more photons once the noise of their light "
                 "is less than this share of it, as 0.01 (default: send all of --photons)")
      ->check(between(0.0, 1.0));
  app.add_option_function<std::string>(
         "--atlas-direct", [&s](const std::string& t) { s.atlasDirect = t == "stored"; },
         "Direct light where gather rays of --gi atlas hit: stored in the maps that are made, or sampled "
         "there (default)")
      ->check(CLI::IsMember({"stored", "sampled"}))
      ->type_name("stored|sampled");
  app.add_option("--atlas", s.atlasFolder,
                 "Folder of brick maps: used if they are there, else made and kept; for --gi radiosity likewise, of "
                 "direct light; for --gi points of point clouds")
      ->type_name("FOLDER");
  app.add_option(
         "--radiosity-texels", s.radiosityTexels,
         "Times as many texels along each edge of a radiosity map as objects ask, for --gi radiosity (default 1)")
      ->check(between(1e-3, 1e3));
  app.add_option("--radiosity-maps", s.radiosityFolder,
                 "Write the radiosity maps there: a tiled MIP EXR for each object and side; not with --atlas")
      ->type_name("FOLDER");
  app.add_option("--brick-cache", s.brickCacheBytes, "Memory for bricks (default 10M)")
      ->transform(CLI::AsSizeValue(false));
  app.add_option("--brick-maxerror", s.brickMaxError,
                 "Bricks whose voxels vary by less, as a share of the mean, are left out of the maps of --gi atlas "
                 "(default 0.03)")
      ->check(between(0.0, 1e6));
  addParsed(app, "--geometry-cache", s.geometryCache, parseBytes, "30M",
            "Memory for geometry that rays see at several levels (default 30M)");
  app.add_option_function<std::string>(
         "--ray-geometry", [&s](const std::string& t) { s.fullGeometry = t == "full"; },
         "What rays see: scene (as the RIB says), or full: displaced micropolygons (the default of --gi reference)")
      ->check(CLI::IsMember({"scene", "full"}))
      ->type_name("scene|full");
  app.add_flag_callback(
      "--no-hit-list", [&s] { s.hitList = false; }, "Rays leave surfaces by a bias alone");
}

/// Tells the environment, which is asked wherever files are looked for.
void addSearchPath(CLI::App& app) {
  std::string kinds, places;
  for (const StandardPlace& p : standardPlaces()) {
    kinds += (kinds.empty() ? "" : "|") + std::string(p.kind);
    places += fmt::format("{}{} and ~/.config/tomales/{}", places.empty() ? "" : ", ", p.variable, p.folder);
  }
  app.add_option_function<std::vector<std::string>>(
         "--searchpath",
         [kinds](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const size_t equals = std::min(text.find('='), text.size());
             const std::string kind = text.substr(0, equals);
             const auto known = standardPlaces();
             if (equals == text.size() ||
                 std::none_of(known.begin(), known.end(), [&](const StandardPlace& p) { return p.kind == kind; }))
               throw CLI::ValidationError("--searchpath", "\"" + text + "\" is not of the form " + kinds + "=FOLDERS");
             addToStandardPath(kind, text.substr(equals + 1));
           }
         },
         "Folders, separated by colons, where files of a kind are looked for after those that the RIB names; may be "
         "given again (also: " +
             places + "). Plugins in folders of shaders are trusted")
      ->expected(1)
      ->take_all()
      ->type_name(kinds + "=FOLDERS");
}

void addTrust(CLI::App& app, Trust& trust) {
  app.add_flag("--allow-system", trust.programs,
               "The RIB may start programs (System, Procedural \"RunProgram\"), and all that --allow-plugins allows");
  app.add_flag("--allow-plugins", trust.scenePlugins,
               "The RIB may load plugins, which can do whatever you can, from the working folder and its search paths");
  app.add_option("--plugin-path", trust.pluginPath,
                 "Folders of plugins that you trust, separated by colons; they are searched before those of the RIB, "
                 "and followed by TOMALES_PLUGIN_PATH and ~/.config/tomales/plugins")
      ->type_name("FOLDERS");
  addShaderFolders(app, trust.shaderFolders);
}

void addShaderFolders(CLI::App& app, std::string& folders) {
  app.add_option("--shaders", folders,
                 "Folders of shaders, separated by colons, whose plugins you trust; they come before all others")
      ->type_name("FOLDERS");
  addSearchPath(app);
}

void addRunOptions(CLI::App& app, RenderSettings& s) {
  app.add_option("-t", s.threads, "Threads (default: all)")->check(CLI::Range(1, 4096));
  app.add_option("--stats", s.statsFile, "Statistics as JSON; # is the frame's number; .jsonl gets a line each")
      ->type_name("FILE.json");
  app.add_flag("--stats-header", s.statsHeader, "Statistics in the headers of OpenEXR pictures too");
  app.add_option("--log", s.logFile, "Append all messages, with the time, and what each frame took")->type_name("FILE");
  app.add_flag("--profile-shaders", s.profileShaders, "Points and time of each shader, at the end");
  app.add_flag("--progress", s.progress, "Show progress: a bar on a terminal, else lines for render farms");
  addParsed(app, "--texture-memory", s.textureMemory, parseBytes, "600M", "Memory for tiles of pictures (default 1G)");
  app.add_option("--texture-cache", s.textureCache,
                 "Where converted pictures are kept (default: $TOMALES_TEXTURE_CACHE, or the user's cache folder)")
      ->type_name("FOLDER");
  addTrust(app, s.trust);
  app.add_option("--output-root", s.outputRoot,
                 "Keep all files that the RIB writes below this folder; names that lead out of it are refused")
      ->type_name("FOLDER");
  addConventions(app, s);
  app.add_flag("--strict", s.strict, "Warnings end with exit code 3: the picture may not be what the scene asks for");
  app.add_flag_callback(
      "-q", [&s] { s.verbosity = Log::Verbosity::Quiet; }, "No warnings");
  app.add_flag_callback(
      "-v", [&s] { s.verbosity = Log::Verbosity::Verbose; }, "Say more, also what each frame wrote and took");
}

void addTarget(CLI::App& app, RenderSettings& s) {
  CLI::Option* target = addParsed(app, "--target-error", s.targetError, parseShare, "2%",
                                  "Choose --samples, --max-error and --light-samples for a mean error of the light of "
                                  "this size: trials find what they bring on this scene, and an audit checks it",
                                  kRangeOfShares);
  CLI::Option* budget = addParsed(app, "--time-budget", s.timeBudget_s, parseSeconds, "5m",
                                  "Choose them for the least error that a frame reaches in this time", kRangeOfTimes);
  addParsed(app, "--target-smudges", s.targetSmudges, parseShare, "1%",
            "With --target-error: how uneven smooth regions may be, in blocks of 8 x 8 pixels (default: that error)",
            kRangeOfShares)
      ->needs(target);
  budget->excludes(target);
  for (const char* chosen : {"--samples", "--max-error", "--light-samples", "--irradiance", "--draft"})
    if (CLI::Option* option = app.get_option_no_throw(chosen)) {
      target->excludes(option);
      budget->excludes(option);
    }
}

void addShotTarget(CLI::App& app, RenderSettings& s) {
  addParsed(app, "--pilot-frames", s.pilotFrames, parseFrames, "1,50,100",
            "With --target-error or --time-budget: the frames on which settings of light are found for all frames "
            "(default: the first, the middle and the last)");
  app.add_option(
         "--shot-settings", s.shotSettings,
         "Store the settings that were found for the shot in this file; if it exists, use its settings: runs that make "
         "other frames of the shot then light them alike")
      ->type_name("FILE.json");
  app.add_option("--audit-every", s.auditEvery,
                 "Audit the frames whose number N divides, with the settings of the shot; 0: none (default 10)")
      ->check(CLI::Range(0, 1'000'000));
}

void addWatching(CLI::App& app, RenderSettings& s) {
  app.add_flag("--audit{300}", s.audit,
               "Say how far the picture is off: light is found again by many rays in 300 of its pixels, or in N of "
               "them (--audit=N)")
      ->check(CLI::Range(20, 1'000'000));
  app.add_flag("--preview{127.0.0.1:14158}", s.preview,
               "Show rows as they are made, in a tev viewer that listens there (--preview=HOST:PORT)");
  app.add_option_function<std::vector<std::string>>(
         "--pixel",
         [&s](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const auto pixel = parsePixel(text);
             if (!pixel) throw CLI::ValidationError("--pixel", "\"" + text + "\" is not of the form X,Y");
             s.pixels.push_back(*pixel);
           }
         },
         "Print what the samples of a pixel see; may be given again")
      ->expected(1)
      ->take_all()
      ->type_name("X,Y");
}

}  // namespace tomales
