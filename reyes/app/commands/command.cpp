#include "reyes/app/commands/command.h"

#include <csignal>
#include <cstdio>

#include "reyes/app/chart/chart.h"
#include "reyes/app/chart/stability.h"
#include "reyes/app/chart/sweeps.h"
#include "reyes/app/commands/atlas_commands.h"
#include "reyes/app/commands/catrib.h"
#include "reyes/app/commands/compile.h"
#include "reyes/app/commands/help.h"
#include "reyes/app/commands/import.h"
#include "reyes/app/commands/info.h"
#include "reyes/app/commands/list.h"
#include "reyes/app/commands/options.h"
#include "reyes/app/commands/render.h"
#include "reyes/app/commands/shade.h"
#include "reyes/app/commands/shadetest.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/crash_note.h"
#include "reyes/base/deep_stack.h"
#include "reyes/base/input_file.h"
#include "reyes/image.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

/// Everything that the arguments may fill.
struct Invocation {
  RenderSettings render;
  CatribSettings catrib;
  model::Settings import;
  ShadetestCommand shadetest;
  CompileCommand compile;
  IrradianceCommand irradiance;
  BrickmakeCommand brickmake;
  ViewCommand view;
  ConvertCommand convert;
  ChartSettings chart;
  bool stability = false;
  std::string first, second, difference;
  InfoCommand info;
  bool json = false;
};

void buildRender(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c =
      app.add_subcommand("render", "Render RIB files, taken as one stream; - is standard input (the default command)");
  addOutput(*c, in.render);
  addPictureOptions(*c, in.render);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  addWatching(*c, in.render);
  c->add_flag("--resume", in.render.resume,
              "Keep finished buckets beside the picture until it is written, and use those of an interrupted run");
  c->add_option("--irradiance", in.render.irradiance, "Indirect light from these records instead of a gather pass")
      ->type_name("SHOT.icf");
  c->add_flag("--irradiance-append", in.render.appendIrradiance,
              "Gather where those records leave points uncovered or disagree");
  c->add_option(
       "--baked", in.render.bakedFolder,
       "Brick maps of gathered light: made, or added to; with --gi baked used instead of gathering, by any camera")
      ->type_name("FOLDER");
  c->add_option("--allow-program", in.render.trust.program,
                "The RIB may start this program, by this very command, and no other")
      ->type_name("COMMAND");
  addParsed(
      *c, "--memory-limit", in.render.memoryLimit, parseBytes, "600M",
      "Limits textures, bricks and the buckets of the frame; what exceeds it rests in a file (default: no limit)");
  c->add_option("SCENE", in.render.files, "RIB files")->required();
  c->callback([&] { code = renderCommand(in.render); });
}

void buildHide(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("hide", "Geometry to a deep frame buffer of visible micropolygons");
  addParsed(*c, "-o", in.render.output, parseNamed(".dfb"), "SHOT.dfb", "Write here; # stands for the frame number")
      ->required();
  addPictureOptions(*c, in.render);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  c->add_flag("--resume", in.render.resume, "Keep the buckets that an interrupted run has finished");
  c->add_option("SCENE", in.render.files, "RIB files")->required();
  c->callback([&] { code = hideCommand(in.render); });
}

void addShotOptions(CLI::App& app, RenderSettings& s) {
  app.add_option("--edit", s.edits,
                 "Changes to shaders, lights and attributes: RIB requests after Attribute \"identifier\" \"name\"")
      ->expected(1)
      ->take_all()
      ->type_name("EDIT.rib");
  app.add_option("SHOT", s.files, "A deep frame buffer")->required()->expected(1)->type_name("SHOT.dfb");
}

void buildGather(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("gather", "A shot's irradiance cache, and all else that its rays say");
  addParsed(*c, "-o", in.render.output, parseNamed(".icf"), "SHOT.icf", "Write here")->required();
  c->add_option("--irradiance", in.render.irradiance,
                "Start from these records and add where they leave points uncovered or disagree; with --crop "
                "those inside are gathered anew")
      ->type_name("OTHER.icf");
  addCrop(*c, in.render);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  addShotOptions(*c, in.render);
  c->callback([&] { code = gatherCommand(in.render); });
}

void buildShade(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("shade", "The picture of a shot, without hiding it again");
  addOutput(*c, in.render);
  c->add_option("--irradiance", in.render.irradiance,
                "Indirect light and shadows of tomales gather: no rays are traced")
      ->type_name("SHOT.icf");
  addCrop(*c, in.render);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  addWatching(*c, in.render);
  addShotOptions(*c, in.render);
  c->callback([&] { code = shadeCommand(in.render); });
}

void buildInfo(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand(
      "info",
      "What is in a .rib, .dfb, .icf, picture (" + pictureExtensions() +
          ") or shader .sl or .so file, or of a shader by its name; of a scene, which files and shaders that it needs "
          "are missing");
  c->add_option("FILE", in.info.file, "A file, or the name of a shader")->required();
  c->add_flag("--json", in.info.json, "As JSON");
  addTrust(*c, in.info.trust);
  c->callback([&] { code = infoCommand(in.info); });
}

void buildList(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("list", "What is built in, with parameters, types, defaults and what they are for");
  c->add_option("KIND", in.first)->required()->check(CLI::IsMember(listedKinds()));
  c->add_flag("--json", in.json, "As JSON");
  c->callback([&] { code = listCommand(in.first, in.json); });
}

void buildCompare(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("compare", "How far a picture is from a reference");
  c->add_option("A", in.first)->required();
  c->add_option("B", in.second, "The reference")->required();
  c->add_flag("--json", in.json, "As JSON");
  addParsed(*c, "--diff", in.difference, parseOutput, pictureNames(), "Write the absolute difference as a picture");
  c->callback([&] { code = compareCommand(in.first, in.second, in.difference, in.json); });
}

void buildCompile(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("compile", "Check shaders in the RenderMan Shading Language");
  c->add_option("SHADER.sl", in.compile.files)->required();
  c->add_option("-I", in.compile.folders, "Folder of #include")
      ->type_name("FOLDER")
      ->expected(1)
      ->allow_extra_args(false);
  c->add_option("-D", in.compile.definitions, "Define a macro")
      ->type_name("NAME[=VALUE]")
      ->expected(1)
      ->allow_extra_args(false);
  c->add_option("--dump", in.compile.dump, "Print what a stage makes of the shaders")
      ->check(CLI::IsMember({"tokens", "tree", "types", "lowered", "code"}))
      ->type_name("tokens|tree|types|lowered|code");
  c->add_flag("-q", in.compile.quiet, "No warnings");
  addShaderFolders(*c, in.compile.shaderFolders);
  c->callback([&] { code = compileCommand(in.compile); });
}

void buildShadetest(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("shadetest", "One shader over a grid: time and values");
  c->add_option("SHADER", in.shadetest.shader, "A name, a .sl file, or a plugin .so")->required();
  c->add_option("PARAMETER=VALUE", in.shadetest.parameters, "Of the shader: Kd=.5, color=1,0,0, name=marble");
  c->add_option("-I", in.shadetest.folders, "Folder of #include, for a .sl")
      ->type_name("FOLDER")
      ->expected(1)
      ->allow_extra_args(false);
  addShaderFolders(*c, in.shadetest.shaderFolders);
  c->add_flag("--watch", in.shadetest.watch, "Shade again whenever the .sl or what it includes changes");
  addParsed(
      *c, "--grid", in.shadetest.grid, [](const std::string& t) { return parsePair(t, 2, 4096); }, "NxM",
      "Points along u and v (default 64x64)");
  addParsed(*c, "-o", in.shadetest.output, parseOutput, pictureNames(), "Picture of Ci");
  c->add_flag("--check", in.shadetest.check,
              "Does the shader, or do all of the file, what they declare? Exit code 3 if not");
  c->callback([&] { code = shadetestCommand(in.shadetest); });
}

void buildCatrib(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("catrib", "Write RIB files as one, requests as they are, in another encoding");
  c->add_option("IN", in.catrib.files, "RIB files of any encoding; - is standard input")->required();
  c->add_option("-o", in.catrib.output, "Write here instead of to standard output")->type_name("FILE.rib");
  c->add_flag("--binary", in.catrib.binary, "Binary RIB instead of ASCII");
  c->add_flag("--gzip", in.catrib.gzip, "Compressed");
  c->callback([&] { code = catribCommand(in.catrib); });
}

void buildImport(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand(
      "import",
      "A model (.obj .ply .gltf .glb .stl .fbx .dae and other kinds that Assimp reads) as a scene with a camera and "
      "lights (docs/import.md)");
  c->add_option("MODEL", in.import.model, "The file of the model")->required();
  addParsed(*c, "-o", in.import.scene, parseNamed(".rib"), "SCENE.rib",
            "Write here, and what it names into the folder SCENE_parts beside it")
      ->required();
  c->add_flag("--subdivide", in.import.subdivide, "Polygons are the cages of subdivision surfaces");
  c->add_option("--smooth", in.import.smooth_degrees,
                "Where the model has no normals, faces that meet at less than this angle look smooth (default 45)")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name("DEGREES");
  c->add_option("--up", in.import.up, "Axis of the model that points up (default: z for .stl and .3mf, else y)")
      ->check(CLI::IsMember({"y", "z"}))
      ->type_name("y|z");
  c->add_option("--camera", in.import.camera, "Look through this camera of the model (default: the first)")
      ->type_name("NAME");
  c->add_option("--light-scale", in.import.lightScale,
                "Multiplies the lights of the model (default: so that they neither drown nor flood the picture)")
      ->check(between(1e-12, 1e12));
  c->callback([&] { code = importCommand(in.import); });
}

void buildRequests(CLI::App& app) {
  app.add_subcommand("requests",
                     "Every request of RIB with its arguments, for programs that write it (reyes/rib.h:ribRequests)")
      ->callback([] { std::fputs(ribRequests().c_str(), stdout); });
}

void buildAtlas(CLI::App& app, Invocation& in, int& code) {
  CLI::App* photons = app.add_subcommand("photons", "Photon maps of a scene, one file for each group of objects");
  photons->add_option("-o", in.render.output, "Folder to write to")->required()->type_name("FOLDER");
  photons->add_option("--photons", in.render.photons, "Photons to emit")
      ->check(CLI::Range(int64_t{1}, int64_t{1} << 40));
  photons->add_option("--bounces", in.render.bounces, "Most surfaces that a photon may arrive at")
      ->check(CLI::Range(1, kMostBounces));
  photons->add_option("--seed", in.render.seed, "Of all random numbers");
  addRunOptions(*photons, in.render);
  photons->add_option("SCENE", in.render.files, "RIB files")->required();
  photons->callback([&] { code = photonsCommand(in.render); });

  CLI::App* irradiance =
      app.add_subcommand("irradiance", "Irradiance (W/m2) and area at photons: point clouds of disks");
  irradiance->add_option("FILES", in.irradiance.inputs, "Photon maps, or folders of them")->required();
  irradiance->add_option("-o", in.irradiance.output, "Folder to write to")->required()->type_name("FOLDER");
  irradiance->add_option("--nearest", in.irradiance.settings.nearest, "Photons of one estimate")
      ->check(CLI::Range(2, 100000));
  irradiance->add_option("--every", in.irradiance.settings.every, "One estimate for so many photons")
      ->check(CLI::Range(1, 100000));
  irradiance->callback([&] { code = irradianceCommand(in.irradiance); });

  CLI::App* bricks = app.add_subcommand("brickmake", "Brick maps of point clouds");
  bricks->add_option("FILES", in.brickmake.inputs, "Point clouds, or folders of them")->required();
  bricks->add_option("-o", in.brickmake.output, "FILE.bkm for all, or a folder for one each")->required();
  bricks->add_option("--maxerror", in.brickmake.settings.maxError, "Variation that needs no finer bricks")
      ->check(between(0.0, 1e9));
  bricks->add_flag("--relative", in.brickmake.relative, "maxerror is a share of the mean of the data");
  bricks->add_option("--maxdepth", in.brickmake.settings.maxDepth, "Most levels below the first")
      ->check(CLI::Range(0, 20));
  bricks->add_option("--radiusscale", in.brickmake.settings.radiusScale, "Scale of the points' radii")
      ->check(between(1e-3, 1e3));
  bricks
      ->add_option("--coarseness", in.brickmake.settings.coarseness,
                   "Widths of the finest voxels, over what the radii ask: 2 for irradiance of photons")
      ->check(between(0.1, 100.0));
  bricks->add_flag("--ignorenormals", in.brickmake.settings.ignoreNormals, "The data fill a volume");
  bricks->callback([&] { code = brickmakeCommand(in.brickmake); });

  CLI::App* view = app.add_subcommand(
      "view", "A picture of a point cloud, photon map, brick map, or of the records of an irradiance cache");
  view->add_option("FILE", in.view.input)->required();
  addParsed(*view, "-o", in.view.output, parseOutput, pictureNames(), "The picture");
  view->add_option("--channel", in.view.channel, "Channel to show; also normal, radius (default: the first)");
  view->add_option("--level", in.view.level, "Level of a brick map, 0 the coarsest (default: the finest)");
  view->add_option("--camera", in.view.camera, "Look with the camera of this RIB file")->type_name("SCENE.rib");
  view->add_option("--gain", in.view.gain, "Multiplies the values (default: so that they can be seen)")
      ->check(between(0, 1e30));
  addParsed(
      *view, "--format", in.view.size, [](const std::string& t) { return parsePair(t, 1, 16384); }, "WxH",
      "Resolution in pixels");
  view->callback([&] { code = viewCommand(in.view); });

  CLI::App* convert = app.add_subcommand(
      "convert",
      "Point clouds from and to PLY, for other programs; the records of an irradiance cache as a point cloud");
  convert->add_option("IN", in.convert.input, "FILE.ptc, FILE.ply or SHOT.icf")->required();
  convert->add_option("OUT", in.convert.output, "FILE.ply or FILE.ptc")->required();
  convert->add_option("--radius", in.convert.radius, "Of points that name none (default: 0)")->check(between(0.0, 1e9));
  convert->callback([&] { code = convertCommand(in.convert); });
}

void buildChart(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand(
      "chart", "A page that shows what error a second and a megabyte buy on a scene, for every method");
  ChartSettings& s = in.chart;
  addParsed(*c, "-o", s.output, parseNamed(".html"), "FILE.html", "Write here, and the figures to FILE.json")
      ->required();
  CLI::Option* sweep =
      c->add_option("--sweep", s.sweep, "What to vary: " + chartSweepNames())->check([](const std::string& name) {
        return chartSweep(name) ? std::string() : "none of " + chartSweepNames();
      });
  c->add_flag("--stability", in.stability,
              "SCENEs are laboratory scenes with a knob (docs/chart.md), or folders of them: error against the knob")
      ->excludes(sweep);
  addParsed(*c, "--budget", s.budget_s, parseSeconds, "10m", "Wall time, as 90s, 10m or 2h (default 10m)");
  addParsed(
      *c, "--format", s.format, [](const std::string& t) { return parsePair(t, 1, 65536); }, "WxH",
      "Resolution in pixels");
  c->add_option("--batches", s.batches, "Most independent pictures that make the reference")
      ->check(CLI::Range(2, 10000));
  c->add_option("--bounces", s.bounces, "Most diffuse bounces")->check(CLI::Range(1, kMostBounces));
  c->add_option("-t", s.threads, "Threads of each rendering (default: all)")->check(CLI::Range(1, 4096));
  addTrust(*c, s.trust);
  c->add_option("--cache", s.folder, "Keep what has been measured here (default: the user's cache)")
      ->type_name("FOLDER");
  c->add_option("SCENE", s.files, "RIB files")->required()->check(CLI::ExistingPath);
  c->callback([&] {
    if (in.stability) {
      code = stabilityCommand(in.chart);
      return;
    }
    for (const std::string& file : in.chart.files)
      if (const std::string problem = inputProblem(file); !problem.empty())
        throw CLI::ValidationError("SCENE", "\"" + file + "\" cannot be read again and again: " + problem +
                                                " (only --stability takes folders)");
    code = chartCommand(in.chart);
  });
}

/// Does the text name a command? If not, the arguments are those of render.
bool namesCommand(const CLI::App& app, const std::string& text) {
  for (const char* name : {"-h", "--help", "--help-all", "--version"})
    if (text == name) return true;
  return !app.get_subcommands([&](const CLI::App* c) { return c->get_name() == text; }).empty();
}

int parseAndRun(int argc, char** argv) {
  CLI::App app("A Reyes renderer with global illumination", "tomales");
  app.set_version_flag("--version", std::string("tomales ") + kVersion);
  app.footer(exitCodeHelp());
  app.require_subcommand(1);
  setHelp(app);
  Invocation in;
  int code = kDone;
  buildRender(app, in, code);
  buildHide(app, in, code);
  buildGather(app, in, code);
  buildShade(app, in, code);
  buildInfo(app, in, code);
  buildList(app, in, code);
  buildCompare(app, in, code);
  buildChart(app, in, code);
  buildCatrib(app, in, code);
  buildImport(app, in, code);
  buildRequests(app);
  buildCompile(app, in, code);
  buildShadetest(app, in, code);
  buildAtlas(app, in, code);
  refuseOptionsAsValues(app);
  finishHelp(app);

  std::vector<std::string> arguments(argv + 1, argv + argc);
  in.render.commandLine = "tomales";
  for (const std::string& a : arguments) in.render.commandLine += " " + a;
  if (!arguments.empty() && !namesCommand(app, arguments.front())) arguments.insert(arguments.begin(), "render");
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes a vector from its back
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kDone : kUsage;
  }
  return code;
}

int runGuarded(int argc, char** argv) {
  Log log;
  int code = kDone;
  guarded(log, [&] { code = parseAndRun(argc, argv); });
  if (std::fflush(stdout) != 0 || std::ferror(stdout))
    log.report(Severity::Output, "output-write", {std::make_shared<std::string>("standard output"), 0},
               "cannot be written");
  return log.worst() > Severity::Info && !interruptExitCode() ? exitCodeOf(log) : code;
}

}  // namespace

int run(int argc, char** argv) {
  openStandardFiles();
  endWithMessages();
  reportCrashes();
  watchSignals();  // before other threads start, which must not get the signals
  int code = kDone;
  runOnDeepStack([&] { code = runGuarded(argc, argv); });
  return code;
}

}  // namespace tomales
