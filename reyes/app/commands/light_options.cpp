// Options of light, and of the error that it may have.
#include <fmt/format.h>

#include "reyes/app/commands/options.h"
#include "reyes/base/deep_stack.h"

namespace tomales {
namespace {

const std::string kRangeOfShares = ": more than 0% and less than 100% are allowed";
const std::string kRangeOfTimes = ": more than 0 s are needed";

const GiMethod* giOrUsageError(const std::string& text) {
  if (const auto method = parseGi(text)) return *method;
  throw CLI::ValidationError("--gi", "\"" + text + "\" is none of scene, " + giMethodNames());
}

void addMethodOptions(CLI::App& app, RenderSettings& s) {
  app.add_option_function<std::string>(
         "--gi", [&s](const std::string& t) { s.light.gi = giOrUsageError(t); },
         "Indirect light (default: scene, as the RIB says)")
      ->type_name("scene|" + giMethodNames("|"));
  app.add_option(
         "--samples", s.light.samples,
         "Gather rays of an irradiance sample, or paths of a point for the reference (default: as the scene asks)")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--bounces", s.light.bounces, "Maximum number of diffuse bounces (default: as the scene asks)")
      ->check(CLI::Range(1, kMostBounces));
  app.add_option("--max-error", s.light.maxError,
                 "Error allowed in irradiance interpolation; 0 computes every point (default: as the scene asks)")
      ->check(between(0.0, 1e6));
  addParsed(app, "--error-function", s.light.errorFunction, errorFunctionNamed, errorFunctionNames(),
            "How far an irradiance record may be used (default: as the scene asks)");
  app.add_flag_callback(
      "--indirect-only", [&s] { s.light.direct = false; }, "Leave out direct light where the eye looks");
  app.add_option("--light-samples", s.light.lightSamples,
                 "Samples of each area light and of the sky where the eye looks (default: as the lights ask)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--light-seed", s.light.seed, "Seed of the random numbers of light alone (default: that of --seed)");
}

void addPhotonOptions(CLI::App& app, RenderSettings& s) {
  app.add_option("--photons", s.light.photons,
                 fmt::format("Photons to emit for --gi atlas, progressive and the caustics of reference (default {})",
                             s.light.photons))
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 40));
  app.add_option("--photon-noise", s.light.photonNoise,
                 "--gi progressive, and the caustics of reference: send no more photons once the noise of their light "
                 "is less than this share of it, such as 0.01 (default: send all of --photons)")
      ->check(between(0.0, 1.0));
}

void addMapOptions(CLI::App& app, RenderSettings& s) {
  app.add_option_function<std::string>(
         "--atlas-direct", [&s](const std::string& t) { s.stored.atlasDirect = t == "stored"; },
         "Direct light where gather rays of --gi atlas hit: stored in the maps that are made, or sampled "
         "there (default)")
      ->check(CLI::IsMember({"stored", "sampled"}))
      ->type_name("stored|sampled");
  app.add_option("--atlas", s.stored.atlasFolder,
                 "Folder of brick maps: used if they are there, else made and kept; for --gi radiosity likewise, of "
                 "direct light; for --gi points of point clouds")
      ->type_name("FOLDER");
  app.add_option(
         "--radiosity-texels", s.stored.radiosityTexels,
         "Factor for the texels that objects ask along each edge of a radiosity map, for --gi radiosity (default 1)")
      ->check(between(1e-3, 1e3));
  app.add_option("--radiosity-maps", s.stored.radiosityFolder,
                 "Write the radiosity maps there: a tiled MIP EXR for each object and side; not with --atlas")
      ->type_name("FOLDER");
  const auto bytes = [](const std::string& text) -> std::optional<size_t> { return parseBytes(text); };
  addParsed(app, "--brick-cache", s.resources.brickCacheBytes, bytes, "10M", "Memory for bricks (default 10M)");
  app.add_option("--brick-maxerror", s.stored.brickMaxError,
                 "Bricks whose voxels vary by less, as a share of the mean, are left out of the maps of --gi atlas "
                 "(default 0.03)")
      ->check(between(0.0, 1e6));
}

void addRayOptions(CLI::App& app, RenderSettings& s) {
  addParsed(app, "--geometry-cache", s.resources.geometryCache, parseBytes, "30M",
            "Memory for geometry that rays see at several levels (default 30M)");
  app.add_option_function<std::string>(
         "--ray-geometry", [&s](const std::string& t) { s.light.fullGeometry = t == "full"; },
         "What rays see: scene (as the RIB says), or full: displaced micropolygons (the default of --gi reference)")
      ->check(CLI::IsMember({"scene", "full"}))
      ->type_name("scene|full");
  app.add_flag_callback(
      "--no-hit-list", [&s] { s.light.hitList = false; },
      "Offset the origins of rays by a bias alone, without the hit list");
}

}  // namespace

void addLightOptions(CLI::App& app, RenderSettings& s) {
  addMethodOptions(app, s);
  addPhotonOptions(app, s);
  addMapOptions(app, s);
  addRayOptions(app, s);
}

void addTarget(CLI::App& app, QualitySettings& s) {
  CLI::Option* target = addParsed(app, "--target-error", s.targetError, parseShare, "2%",
                                  "Choose --samples, --max-error and --light-samples for this mean error of the light: "
                                  "trials measure their effect on this scene, and an audit checks the picture",
                                  kRangeOfShares);
  CLI::Option* budget = addParsed(
      app, "--time-budget", s.timeBudget_s, parseSeconds, "5m",
      "Choose --samples, --max-error and --light-samples for the least error that a frame reaches in this time",
      kRangeOfTimes);
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

void addAnimationTarget(CLI::App& app, QualitySettings& s) {
  addParsed(app, "--pilot-frames", s.pilotFrames, parseFrames, "1,50,100",
            "With --target-error or --time-budget: the frames on which settings of light are found for all frames "
            "(default: the first, the middle and the last)");
  app.add_option("--animation-settings", s.animationSettings,
                 "Store the settings that were found for the animation in this file; if it exists, use its settings: "
                 "runs that make other frames of the animation then light them alike")
      ->type_name("FILE.json");
  app.add_option(
         "--audit-every", s.auditEvery,
         "Audit the frames whose number is a multiple of N, with the settings of the animation; 0: none (default 10)")
      ->check(CLI::Range(0, 1'000'000));
}

}  // namespace tomales
