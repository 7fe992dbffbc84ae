#include "reyes/app/commands/usage.h"

#include "reyes/base/deep_stack.h"
#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

void buildPhotons(CLI::App& app, Invocation& in, int& code) {
  CLI::App* photons = app.add_subcommand("photons", "Photon maps of a scene, one file for each group of objects");
  photons->add_option("-o", in.render.picture.output, "Folder to write to")->required()->type_name("FOLDER");
  photons->add_option("--photons", in.render.light.photons, "Photons to emit")
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 40));
  photons->add_option("--bounces", in.render.light.bounces, "Maximum number of surfaces that a photon may arrive at")
      ->check(CLI::Range(1, kMostBounces));
  photons->add_option("--seed", in.render.picture.seed, "Of all random numbers");
  addRunOptions(*photons, in.render);
  photons->add_option("SCENE", in.render.input.files, "RIB files")->required();
  photons->callback([&] { code = photonsCommand(in.render); });
}

void buildIrradiance(CLI::App& app, Invocation& in, int& code) {
  CLI::App* irradiance =
      app.add_subcommand("irradiance", "Irradiance (W/m2) and area at photons: point clouds of disks");
  irradiance->add_option("FILES", in.irradiance.inputs, "Photon maps, or folders of them")->required();
  irradiance->add_option("-o", in.irradiance.output, "Folder to write to")->required()->type_name("FOLDER");
  irradiance->add_option("--nearest", in.irradiance.settings.nearest, "Photons of one estimate")
      ->check(CLI::Range(2, 100000));
  irradiance
      ->add_option("--every", in.irradiance.settings.every, "Number of neighbouring photons that share an estimate")
      ->check(CLI::Range(1, 100000));
  irradiance->callback([&] { code = irradianceCommand(in.irradiance); });
}

void buildBrickmake(CLI::App& app, Invocation& in, int& code) {
  CLI::App* bricks = app.add_subcommand("brickmake", "Brick maps of point clouds");
  bricks->add_option("FILES", in.brickmake.inputs, "Point clouds, or folders of them")->required();
  bricks->add_option("-o", in.brickmake.output, "FILE.bkm for one map of all clouds, or a folder for a map of each")
      ->required();
  bricks->add_option("--maxerror", in.brickmake.settings.maxError, "Variation up to which no finer bricks are made")
      ->check(between(0.0, 1e9));
  bricks->add_flag("--relative", in.brickmake.relative, "maxerror is a share of the mean of the data");
  bricks->add_option("--maxdepth", in.brickmake.settings.maxDepth, "Maximum number of levels below the first")
      ->check(CLI::Range(0, 20));
  bricks->add_option("--radiusscale", in.brickmake.settings.radiusScale, "Scale of the points' radii")
      ->check(between(1e-3, 1e3));
  bricks
      ->add_option("--coarseness", in.brickmake.settings.coarseness,
                   "Width of the finest voxels as a multiple of the one that the points' radii imply; 2 for irradiance "
                   "of photons")
      ->check(between(0.1, 100.0));
  bricks->add_flag("--ignorenormals", in.brickmake.settings.ignoreNormals, "The data fill a volume");
  bricks->callback([&] { code = brickmakeCommand(in.brickmake); });
}

void buildView(CLI::App& app, Invocation& in, int& code) {
  CLI::App* view = app.add_subcommand(
      "view", "A picture of a point cloud, photon map, brick map, or of the records of an irradiance cache");
  view->add_option("FILE", in.view.input)->required();
  addParsed(*view, "-o", in.view.output, parseOutput, pictureNames(), "The picture");
  view->add_option("--channel", in.view.channel, "Channel to show; also normal, radius (default: the first)");
  view->add_option("--level", in.view.level, "Level of a brick map, 0 the coarsest (default: the finest)");
  view->add_option("--camera", in.view.camera, "Look with the camera of this RIB file")->type_name("SCENE.rib");
  view->add_option("--gain", in.view.gain, "Multiplies the values (default: chosen so that they are visible)")
      ->check(between(0, 1e30));
  addParsed(
      *view, "--format", in.view.size, [](const std::string& t) { return parsePair(t, 1, 16384); }, "WxH",
      "Resolution in pixels");
  view->callback([&] { code = viewCommand(in.view); });
}

void buildConvert(CLI::App& app, Invocation& in, int& code) {
  CLI::App* convert = app.add_subcommand(
      "convert",
      "Point clouds from and to PLY, for other programs; the records of an irradiance cache as a point cloud");
  convert->add_option("IN", in.convert.input, "FILE.ptc, FILE.ply or SHOT.icf")->required();
  convert->add_option("OUT", in.convert.output, "FILE.ply or FILE.ptc")->required();
  convert->add_option("--radius", in.convert.radius, "Radius of points that have none (default: 0)")
      ->check(between(0.0, 1e9));
  convert->callback([&] { code = convertCommand(in.convert); });
}

}  // namespace

void addAtlasCommands(CLI::App& app, Invocation& in, int& code) {
  buildPhotons(app, in, code);
  buildIrradiance(app, in, code);
  buildBrickmake(app, in, code);
  buildView(app, in, code);
  buildConvert(app, in, code);
}

}  // namespace tomales
