#include "reyes/app/commands/usage.h"

#include "reyes/app/chart/stability.h"
#include "reyes/app/chart/sweeps.h"
#include "reyes/app/commands/relight_first.h"
#include "reyes/app/commands/render.h"
#include "reyes/app/commands/shade.h"
#include "reyes/base/deep_stack.h"
#include "reyes/base/input_file.h"
#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

void addMemoryLimit(CLI::App& app, RenderSettings& s, const std::string& otherwise) {
  addParsed(app, "--memory-limit", s.resources.memoryLimit, parseBytes, "600M",
            "Limits textures, bricks and the buckets of the frame; what exceeds it rests in a file " + otherwise);
}

void buildRender(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c =
      app.add_subcommand("render", "Render RIB files, taken as one stream; - is standard input (the default command)");
  addOutput(*c, in.render.picture);
  addPictureOptions(*c, in.render);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  addWatching(*c, in.render);
  c->add_flag("--resume", in.render.picture.resume,
              "Keep finished work beside the picture until it is written, and use that of an earlier run");
  c->add_flag("--skip-finished", in.render.picture.skipFinished,
              "Leave out frames whose pictures hold what would be rendered, by their OpenEXR headers");
  c->add_option("--irradiance", in.render.stored.irradiance,
                "Indirect light from these records instead of a gather pass")
      ->type_name("SHOT.icf");
  c->add_flag("--irradiance-append", in.render.stored.appendIrradiance,
              "Gather where those records leave points uncovered or disagree")
      ->needs("--irradiance");
  c->add_option(
       "--baked", in.render.stored.bakedFolder,
       "Brick maps of gathered light: made, or added to; with --gi baked used instead of gathering, by any camera")
      ->type_name("FOLDER");
  c->add_option("--allow-program", in.render.input.trust.program,
                "The RIB may start this program, by this very command, and no other")
      ->type_name("COMMAND");
  addMemoryLimit(*c, in.render, "(default: no limit)");
  addTarget(*c, in.render.quality);
  addAnimationTarget(*c, in.render.quality);
  c->add_option("SCENE", in.render.input.files, "RIB files")->required();
  c->callback([&] { code = renderCommand(in.render); });
}

void buildHide(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("hide", "Geometry to a deep frame buffer of visible micropolygons");
  addParsed(*c, "-o", in.render.picture.output, parseNamed(".dfb"), "SHOT.dfb",
            "Write here; # stands for the frame number")
      ->required();
  addPictureOptions(*c, in.render);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  c->add_flag("--resume", in.render.picture.resume, "Keep the buckets that an interrupted run has finished");
  c->add_option("SCENE", in.render.input.files, "RIB files")->required();
  c->callback([&] { code = hideCommand(in.render); });
}

/// "3/8" is the third of eight parts.
std::optional<WorkPart> parsePart(const std::string& text) {
  int index = 0, count = 0, end = 0;
  const bool good = std::sscanf(text.c_str(), "%d/%d%n", &index, &count, &end) == 2 &&
                    static_cast<size_t>(end) == text.size() && index >= 1 && index <= count && count <= kMostParts;
  return good ? std::optional(WorkPart{index - 1, count}) : std::nullopt;
}

void buildPrepare(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("prepare", "The maps of light that frames share, for --gi atlas and radiosity");
  addPictureOptions(*c, in.render);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  c->add_option_function<std::string>(
       "--pass",
       [&in](const std::string& name) {
         in.prepare.pass = name == "photons" ? AtlasPass::Photons : name == "join" ? AtlasPass::Join : AtlasPass::Maps;
       },
       "One pass of the atlas alone: a part of the photons, the photon maps of all parts, or a part of the maps of "
       "these (default: all that is missing)")
      ->check(CLI::IsMember({"photons", "join", "maps"}))
      ->type_name("photons|join|maps");
  addParsed(*c, "--part", in.prepare.part, parsePart, "3/8",
            "The part of the pass, if several processes share it; for join, how many parts there are")
      ->needs("--pass");
  c->add_option("SCENE", in.render.input.files, "RIB files")->required();
  c->callback([&] { code = prepareCommand(in.render, in.prepare); });
}

void addShotOptions(CLI::App& app, RenderSettings& s, const char* what = "A deep frame buffer",
                    const char* named = "SHOT.dfb") {
  app.add_option("--edit", s.input.edits,
                 "Changes to shaders, lights and attributes: RIB requests after Attribute \"identifier\" \"name\"")
      ->expected(1)
      ->take_all()
      ->type_name("EDIT.rib");
  app.add_option("SHOT", s.input.files, what)->required()->expected(1)->type_name(named);
}

void buildGather(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("gather", "Compute the irradiance cache of a shot, and what else its rays find");
  addParsed(*c, "-o", in.render.picture.output, parseNamed(".icf"), "SHOT.icf", "Write here")->required();
  c->add_option("--irradiance", in.render.stored.irradiance,
                "Start from these records and add where they leave points uncovered or disagree; with --crop "
                "those inside are gathered anew")
      ->type_name("OTHER.icf");
  c->add_flag_callback(
      "--no-answers", [&in] { in.render.stored.keepsAnswers = false; },
      "Store irradiance records alone, and not what rays of shaders and lights find: shade traces these itself, with "
      "the same bits");
  c->add_flag("--by-light", in.render.stored.byLight,
              "Keep what each light brings, so that shade and relight can dim and colour a light together with its "
              "bounced light");
  addCrop(*c, in.render.picture);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  c->add_flag("--resume", in.render.picture.resume, "Keep what is gathered, and use that of an interrupted run");
  addFramesApart(*c, in.render.input);
  addShotOptions(*c, in.render);
  c->callback([&] { code = gatherCommand(in.render); });
}

void buildShade(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("shade", "The picture of a shot, without hiding it again");
  addOutput(*c, in.render.picture);
  c->add_option("--irradiance", in.render.stored.irradiance,
                "Indirect light and shadows of tomales gather: no rays are traced")
      ->type_name("SHOT.icf");
  addCrop(*c, in.render.picture);
  addLightOptions(*c, in.render);
  addRunOptions(*c, in.render);
  addWatching(*c, in.render);
  addTarget(*c, in.render.quality);
  addFramesApart(*c, in.render.input);
  addShotOptions(*c, in.render);
  c->callback([&] { code = shadeCommand(in.render); });
}

void buildRelight(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("relight", "Change the lights of a shot in a browser, and see the frame");
  RelightCommand& r = in.relight;
  c->add_option("--irradiance", r.render.stored.irradiance,
                "Indirect light and shadows of tomales gather --by-light (default: they are gathered first)")
      ->type_name("SHOT.icf");
  c->add_option("--port", r.port, "Port of the page's address (default: any that is free)")
      ->check(CLI::Range(1, 65535));
  c->add_option("--folder", r.folder, "Edits are saved and loaded here (default: the working folder)")
      ->check(CLI::ExistingDirectory)
      ->type_name("FOLDER");
  c->add_flag_callback(
      "--no-browser", [&r] { r.opens = false; }, "Print the address alone");
  addCrop(*c, r.render.picture);
  addLightOptions(*c, r.render);
  addRunOptions(*c, r.render);
  addMemoryLimit(*c, r.render, "(default: 640 MB of buckets)");
  addShotOptions(*c, r.render, "A deep frame buffer, or a scene, which is hidden first", "SHOT.dfb|SCENE.rib");
  c->callback([&] { code = relightFirst(in.relight); });
}

/// Returns some options as the user wrote them, so that they can be written again.
std::vector<std::string> givenOf(const std::vector<CLI::Option*>& options) {
  std::vector<std::string> out;
  for (const CLI::Option* o : options) {
    if (o->count() == 0) continue;
    const bool isFlag = o->get_items_expected_max() == 0;
    for (const std::string& value : o->results()) {
      out.push_back(o->get_name());
      if (!isFlag) out.push_back(value);
    }
  }
  return out;
}

/// Returns the options that `add` adds to the command.
template <class Add>
std::vector<CLI::Option*> added(CLI::App& app, const Add& add) {
  const auto before = app.get_options();
  add();
  std::vector<CLI::Option*> out;
  for (CLI::Option* o : app.get_options())
    if (std::find(before.begin(), before.end(), o) == before.end()) out.push_back(o);
  return out;
}

/// Options that say which tasks a plan has.
void addTasks(CLI::App& c, BatchCommand& b) {
  RenderSettings& s = b.plan.render;
  addParsed(c, "-o", s.picture.output, parseOutput, pictureNames(),
            "As for render; # stands for the number of the frame");
  addParsed(c, "--frames", s.input.frames, parseFrames, "1-10x2,15", "Only these frames (default: all)");
  addParsed(
      c, "--tiles", b.plan.tiles, [](const std::string& t) { return parsePair(t, 1, 64); }, "NxM",
      "Hide and gather each frame once, shade it in tiles, and join them")
      ->needs("-o");
  c.add_option("--share-records", b.plan.sharedRecords,
               "Frames in a row that share the records of gathered light, for less flicker: each adds to those of the "
               "one before (default 1)")
      ->check(CLI::Range(1, 100000))
      ->needs("-o");
  c.add_option("--photon-parts", b.plan.photonParts,
               "Tasks that trace the photons of --gi atlas and make its maps (default: one for each million photons)")
      ->check(CLI::Range(1, kMostParts));
  c.add_option("--plan", b.folder, "Folder of the plan, its states and logs (default: SCENE.batch)")
      ->type_name("FOLDER");
  c.add_flag("--plan-only", b.planOnly, "Make the plan, to be read or edited, and run nothing");
}

/// Options that say where tasks run.
void addEngine(CLI::App& c, BatchCommand& b) {
  c.add_option_function<std::string>(
       "--engine", [&b](const std::string& name) { b.onSlurm = name == "slurm"; },
       "Where tasks run: local (here, the default) or slurm")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->type_name("local|slurm");
  c.add_option("-j", b.processes, "Maximum number of tasks at a time (default: one on each processor; slurm: no limit)")
      ->check(CLI::Range(1, 100000));
  c.add_option("-t", b.slurm.cpus, "Threads of each task (default 1)")->check(CLI::Range(1, 4096));
  c.add_option("--partition", b.slurm.partition, "Partition of Slurm (default: the cluster's)");
  c.add_option("--time", b.slurm.time, "Time limit of a task, as sbatch takes it (default: the partition's)");
  c.add_option("--mem", b.slurm.memory, "Memory of a task, as sbatch takes it (default: the partition's)");
}

void buildBatch(CLI::App& app, Invocation& in, int& code) {
  CLI::App* c = app.add_subcommand("batch", "Frames as tasks of a plan, by processes here or on a Slurm cluster");
  BatchCommand& b = in.batch;
  RenderSettings& s = b.plan.render;
  addTasks(*c, b);
  addEngine(*c, b);
  c->add_flag("--json", b.json, "Report as JSON");
  addParsed(*c, "--html", b.page, parseNamed(".html"), "FILE.html", "Write the report as a page with small pictures");
  const auto picture = added(*c, [&] { addFrameSize(*c, s); });
  const auto light = added(*c, [&] {
    addLightOptions(*c, s);
    addTrust(*c, s.input.trust);
  });
  const auto target = added(*c, [&] {
    addTarget(*c, s.quality);
    addAnimationTarget(*c, s.quality);
  });
  for (const char* passes : {"--tiles", "--share-records"})
    for (const char* chooses : {"--target-error", "--time-budget"})
      c->get_option(passes)->excludes(c->get_option(chooses));
  c->add_option("SCENE", b.what,
                "RIB files, or a plan to go on with; or status, cancel, retry, log with a PLAN (log PLAN FRAME)")
      ->required();
  c->callback([&, picture, light, target] {
    b.plan.pictureArguments = givenOf(picture);
    b.plan.lightArguments = givenOf(light);
    b.plan.targetArguments = givenOf(target);
    b.plan.lightArguments.insert(b.plan.lightArguments.end(), {"-t", std::to_string(b.slurm.cpus)});
    b.slurm.atOnce = b.processes;
    code = batchCommand(b);
  });
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
  c->add_flag(
       "--stability", in.stability,
       "SCENEs are laboratory scenes with a knob (docs/measured/limits.md), or folders of them: error against the knob")
      ->excludes(sweep);
  addParsed(*c, "--budget", s.budget_s, parseSeconds, "10m", "Wall time, as 90s, 10m or 2h (default 10m)");
  addParsed(
      *c, "--format", s.format, [](const std::string& t) { return parsePair(t, 1, 65536); }, "WxH",
      "Resolution in pixels");
  c->add_option("--batches", s.batches, "Maximum number of independent pictures that make the reference")
      ->check(CLI::Range(2, 10000));
  c->add_option("--bounces", s.bounces, "Maximum number of diffuse bounces")->check(CLI::Range(1, kMostBounces));
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
        throw CLI::ValidationError("SCENE", "\"" + file + "\" cannot be read more than once: " + problem +
                                                " (only --stability takes folders)");
    code = chartCommand(in.chart);
  });
}

}  // namespace

void addFrameCommands(CLI::App& app, Invocation& in, int& code) {
  buildRender(app, in, code);
  buildHide(app, in, code);
  buildPrepare(app, in, code);
  buildGather(app, in, code);
  buildShade(app, in, code);
  buildRelight(app, in, code);
  buildBatch(app, in, code);
  buildChart(app, in, code);
}

}  // namespace tomales
