#include "reyes/app/commands/atlas_commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "gi/brick_file.h"
#include "gi/icf.h"
#include "gi/ply.h"
#include "gi/point_picture.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/frame/frame_shaders.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/sky_portals.h"
#include "reyes/app/watch/progress.h"
#include "reyes/app/watch/run_report.h"
#include "reyes/area_lights.h"
#include "reyes/base/parallel.h"
#include "reyes/base/temporary_folder.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/base/unfinished_folder.h"
#include "reyes/image_files.h"
#include "reyes/moving_surfaces.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Replaces folders by the point clouds in them.
std::vector<fs::path> pointFiles(const std::vector<std::string>& inputs) {
  std::vector<fs::path> out;
  for (const std::string& input : inputs) {
    std::error_code problem;
    if (!fs::is_directory(input, problem)) {
      out.emplace_back(input);
      continue;
    }
    requireFinished(input);
    for (const auto& entry : fs::directory_iterator(input, problem))
      if (entry.path().extension() == ".ptc") out.push_back(entry.path());
    if (problem) throw FileError(fmt::format("folder \"{}\" cannot be read: {}", input, problem.message()));
  }
  std::sort(out.begin(), out.end());
  if (out.empty()) throw FileError("there is no point cloud (.ptc) to read");
  return out;
}

/// Refuses to replace a file that the command reads.
void refuseInput(const fs::path& output, const std::vector<std::string>& inputs) {
  if (isAmong(output, inputs))
    throw WriteError(fmt::format("\"{}\" would replace what it is made of", output.string()));
}

/// Joins several clouds, chunk by chunk.
void joinPointFiles(const std::vector<fs::path>& files, const fs::path& out) {
  const PointFile first(files.front().string());
  PointFileWriter writer(out.string(), first.channels());
  for (const fs::path& path : files) {
    const PointFile file(path.string());
    if (file.channels() != first.channels())
      throw FileError(fmt::format("\"{}\" has other channels than the files before", path.string()));
    for (size_t chunk = 0; chunk < file.chunkCount(); ++chunk) {
      PointCloud part;
      file.read(chunk, part);
      for (size_t i = 0; i < part.count(); ++i)
        writer.add(part.position[i], part.normal[i], part.radius[i], part.at(i));
    }
  }
  writer.finish(first.madeFrom());
}

/// Reads the first frame of RIB files, ready to be traced.
std::optional<Scene> firstScene(const RenderSettings& settings, Log& log) {
  std::optional<Scene> scene;
  RibSettings rib;
  rib.trust = settings.input.trust;
  rib.onScene = [&](Scene&& s) {
    if (!scene) scene = std::move(s);
  };
  const bool read = readRib(settings.input.files, rib, log);
  if (read && !scene) log.report(Severity::Error, "no-world", {}, "no WorldBegin ... WorldEnd was found");
  if (!read) scene.reset();
  return scene;
}

void tracePhotonsOf(Scene& scene, const RenderSettings& settings, Stats& stats, Log& log) {
  ProgressMeter meter(settings.report.progress, "preparing");
  applyOverrides(scene, settings);
  const std::unique_ptr<ShaderRegistry> shaders = frameShaders(settings, log);
  measureAreaLights(scene, *shaders, log);
  displaceByMovingSurfaces(scene, *shaders, log);
  scene.expandAll([](const Attributes& a) { return a.visibility.photon; });
  ShadingSystem shading(scene, *shaders, nullptr, log, stats);
  const Camera camera(scene.options);
  const RayScene rays(scene, camera, shading, raySettings(settings, scene.options), stats, log);
  findSkyPortals(scene, camera, shading, rays, log);
  const StageTimer timer(stats, "photons");
  AtlasSettings atlas = atlasSettings(settings, scene, shading);
  atlas.photons.direct = true;  // so that the maps, which may be viewed, have all light
  const MapNames names = mapNames(scene, shading, atlas);
  const PhotonFigures figures = writePhotons(
      settings.picture.output, {{&rays, &shading}, names, atlas, meter.pass("tracing photons", 0, 1), stats, log});
  meter.finish();
  stats.addOutput(settings.picture.output);
  if (settings.report.verbosity != Log::Verbosity::Quiet)
    fmt::print("{} photons emitted, {} stored in {}\n", figures.emitted, figures.stored, settings.picture.output);
}

/// Reads the points of a .ptc, or the records of an .icf.
PointCloud cloudOf(const std::string& path) {
  if (fs::path(path).extension() != ".icf") return PointFile(path).readAll();
  std::string error;
  const std::unique_ptr<IcfFile> file = IcfFile::open(path, error);
  if (!file) throw FileError(fmt::format("\"{}\": {}", path, error));
  return recordsOf(file->shot());
}

}  // namespace

int photonsCommand(const RenderSettings& settings) {
  const ThreadLimit threads(settings.resources.threads);
  Log log(settings.report.verbosity);
  RunReport report(settings, log);
  guarded(log, [&] {
    std::optional<Scene> scene = firstScene(settings, log);
    if (!scene) return;
    report.begin(scene->options.frame);
    tracePhotonsOf(*scene, settings, report.stats(), log);
    report.end(scene->where);
  });
  report.finish();
  return exitCodeOf(log);
}

int irradianceCommand(const IrradianceCommand& command) {
  Log log;
  guarded(log, [&] {
    makeAtlasFolder(command.output);
    const std::vector<fs::path> files = pointFiles(command.inputs);
    UnfinishedFolder set(command.output);
    for (const fs::path& file : files) {
      const fs::path out = fs::path(command.output) / file.filename();
      refuseInput(out, {file.string()});
      writeIrradiance(file, out, command.settings);
    }
    set.finish();
  });
  return exitCodeOf(log);
}

void makeBrickMaps(const BrickmakeCommand& command, const std::function<void(const std::string&)>& made) {
  const std::vector<fs::path> files = pointFiles(command.inputs);
  const bool one = command.oneFile || fs::path(command.output).extension() == ".bkm";
  if (!one) makeAtlasFolder(command.output);
  const auto make = [&](const fs::path& in, const fs::path& out) {
    refuseInput(out, command.inputs);
    const PointFile file(in.string());
    const PointTiles tiles(file);
    BrickSettings settings = command.settings;
    if (command.relative) settings.maxError *= static_cast<float>(tiles.meanOfData());
    const BuiltBricks built = writeBrickMap(tiles, settings, out.string(), {file.madeFrom().world, 0});
    if (made)
      made(fmt::format("{}: {} points, {} bricks, {} left out, {} levels", out.string(), file.count(),
                       built.tree.nodes.size(), built.eliminated, built.tree.deepest + 1));
  };
  if (one && files.size() > 1) {
    const fs::path folder = fs::path(command.output).parent_path();
    const TemporaryFolder temporary(folder.empty() ? "." : folder);
    const fs::path all = temporary.path() / "all.ptc";
    joinPointFiles(files, all);
    make(all, command.output);
  } else {
    std::optional<UnfinishedFolder> set;
    if (!one) set.emplace(command.output);
    for (const fs::path& file : files)
      make(file, one ? fs::path(command.output)
                     : fs::path(command.output) / fs::path(file).filename().replace_extension(".bkm"));
    if (set) set->finish();
  }
}

int brickmakeCommand(const BrickmakeCommand& command) {
  Log log;
  guarded(log, [&] { makeBrickMaps(command, [](const std::string& what) { fmt::print("{}\n", what); }); });
  return exitCodeOf(log);
}

int viewCommand(const ViewCommand& command) {
  Log log;
  guarded(log, [&] {
    refuseInput(command.output, {command.input, command.camera});
    PointPictureSettings settings{command.size[0], command.size[1], command.channel, command.gain, {}};
    std::optional<Scene> scene;
    std::optional<Camera> camera;
    if (!command.camera.empty()) {
      RenderSettings look;
      look.input.files = {command.camera};
      scene = firstScene(look, log);
      if (!scene) return;
      scene->options.xResolution = command.size[0];
      scene->options.yResolution = command.size[1];
      camera.emplace(scene->options);
      settings.project = [&](const vec3& p) -> std::optional<vec3> {
        const vec3 at = transformPoint(scene->cameraFromWorldAtOpen(), p);
        if (camera->perspective() && at.z < camera->nearClip()) return std::nullopt;
        return vec3(camera->raster(at), at.z);
      };
    }
    const PointCloud cloud = fs::path(command.input).extension() == ".bkm"
                                 ? voxelsOf(BrickFile(command.input), command.level)
                                 : cloudOf(command.input);
    writeImage(command.output, pictureOf(cloud, settings), isForScreens(command.output), log);
  });
  return exitCodeOf(log);
}

int convertCommand(const ConvertCommand& command) {
  Log log;
  guarded(log, [&] {
    refuseInput(command.output, {command.input});
    const fs::path from = fs::path(command.input).extension(), to = fs::path(command.output).extension();
    if (from == ".ptc" && to == ".ply") {
      writePly(PointFile(command.input), command.output);
    } else if (from == ".ply" && to == ".ptc") {
      const PlyFigures figures = convertPly(command.input, command.output, command.radius);
      if (figures.dropped > 0)
        log.report(Severity::Warning, "ply-points", {},
                   fmt::format("\"{}\": {} of {} points are not finite or have a negative radius; dropped",
                               command.input, figures.dropped, figures.points + figures.dropped));
    } else if (from == ".icf" && to == ".ptc") {
      writePointFile(cloudOf(command.input), command.output);
    } else {
      throw FileError("point clouds are converted from .ptc to .ply, from .ply to .ptc, or from .icf to .ptc");
    }
  });
  return exitCodeOf(log);
}

}  // namespace tomales
