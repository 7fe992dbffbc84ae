#include "reyes/app/batch/make_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <map>
#include <set>

#include "reyes/app/batch/plan_light.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/image.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// What a frame of the scene writes.
struct FrameFiles {
  int worlds = 0;
  bool maps = false;                            ///< It writes maps for later frames, and nothing else.
  bool joins = true;                            ///< All are pictures in OpenEXR that can be made of tiles.
  std::vector<std::string> files;               ///< The first is the picture.
  std::vector<std::vector<std::string>> tiles;  ///< The same for each tile.
  std::optional<SharedLight> light;
};

std::string cropText(const std::array<int, 2>& tiles, int index) {
  const auto share = [](int i, int count) { return fmt::format("{:.9g}", static_cast<double>(i) / count); };
  const int x = index % tiles[0], y = index / tiles[0];
  return fmt::format("{},{},{},{}", share(x, tiles[0]), share(x + 1, tiles[0]), share(y, tiles[1]),
                     share(y + 1, tiles[1]));
}

class PlanMaker {
 public:
  PlanMaker(const PlanOptions& options, Log& log) : options_(options), log_(log) {
    options_.render.sources = makeSources(options_.render.files);
    plan_.file = fs::absolute(options.file).lexically_normal();
    plan_.workingFolder = fs::current_path().string();
  }

  std::optional<BatchPlan> make() {
    RibSettings rib;
    rib.trust = options_.render.trust;
    rib.onScene = [this](Scene&& scene) { take(scene); };
    rib.onMake = [this](const Request&) {
      events_.push_back(kMake);
      hasMakes_ = true;
    };
    rib.onOutliving = [this](const Request&) { apart_ = false; };
    if (!readRib(options_.render.files, rib, log_)) return std::nullopt;
    if (frames_.empty())
      return refuse("no-frame",
                    "there is no frame to render: the scene has no world, or none of the frames that --frames names");
    if (!suits()) return std::nullopt;
    const std::vector<std::string> maps = addMaps();
    addLight(maps);
    for (const auto& [number, frame] : frames_) {
      if (frame.maps) continue;
      plan_.pictures.push_back(frame.files.front());
      if (!inPasses()) addRender("render", number, frame, maps, options_.render.output);
    }
    if (inPasses()) addPasses(maps);
    checkPlan(plan_);
    return plan_;
  }

 private:
  std::nullopt_t refuse(const char* code, const std::string& why) const {
    log_.report(Severity::Error, code, {std::make_shared<std::string>(options_.render.files.front()), 0}, why);
    return std::nullopt;
  }
  int tileCount() const { return options_.tiles[0] * options_.tiles[1]; }
  bool inPasses() const { return tileCount() > 1 || options_.sharedRecords > 1; }

  /// Frames that make maps, and Make requests, as they follow each other. Returns the tasks that all other frames need.
  std::vector<std::string> addMaps() {
    std::vector<std::string> needs, since;  // the last Make requests; the frames after them
    int make = 0, makes = 0;
    const auto addMakes = [&](int first, int end) {
      if (first == end) return;
      append(since, needs);
      const std::string name = fmt::format("make{:03}", makes++);
      const std::string range = first + 1 == end ? std::to_string(first) : fmt::format("{}-{}", first, end - 1);
      std::vector<std::string> arguments{"render", "--frames", "none", "--makes", range};
      append(arguments, options_.lightArguments);
      append(arguments, options_.render.files);
      plan_.tasks.push_back({name, name, frames_.begin()->first, arguments, std::exchange(since, {}), {}, {}});
      needs = {name};
    };
    int done = 0;
    std::set<int> added;
    for (const int event : events_) {
      if (event == kMake) {
        ++make;
        continue;
      }
      const FrameFiles& frame = frames_.at(event);
      if (!frame.maps || !added.insert(event).second) continue;
      addMakes(std::exchange(done, make), make);
      since.push_back(addRender("maps", event, frame, needs, ""));
    }
    addMakes(done, make);
    append(since, needs);
    return since;
  }

  void take(Scene& scene) {
    const int number = scene.options.frame;
    const auto& wanted = options_.render.frames;
    if (wanted && !std::binary_search(wanted->begin(), wanted->end(), number)) return;
    applyOverrides(scene, options_.render);
    FrameFiles& frame = frames_[number];
    events_.push_back(number);
    frame.maps = (frame.worlds == 0 || frame.maps) && writesMapsAlone(scene.options, options_.render);
    ++frame.worlds;
    for (const std::string& file : filesOf(scene.options, options_.render.output)) frame.files.push_back(file);
    for (const DisplayCall& d : scene.options.displays)
      frame.joins = frame.joins && !writesMap(d) && driverOf(d, scene.options, pluginTrust(options_.render)).empty();
    frame.light.reset();  // worlds of one frame have no folder of their own
    Log quiet(Log::Verbosity::Quiet);
    if (frame.worlds == 1 && !frame.maps) frame.light = sharedLightOf(scene, options_.render, quiet);
    if (!inPasses() || frame.maps) return;
    for (int i = 0; i < tileCount(); ++i) frame.tiles.push_back(filesOf(scene.options, work(number, tileEnd(i))));
    for (const std::string& file : frame.files) frame.joins = frame.joins && file.ends_with(".exr");
  }

  std::vector<std::string> filesOf(Options options, const std::string& output) const {
    RenderSettings settings = options_.render;
    settings.output = output;
    Log quiet(Log::Verbosity::Quiet);
    nameOutputs(options, settings, quiet);
    std::vector<std::string> out;
    for (const DisplayCall& d : options.displays)
      out.push_back(driverOf(d, options, pluginTrust(settings)).empty() ? fileOf(d) : d.name);
    return out;
  }

  /// Reports what would be found only when frames have been rendered.
  bool suits() const {
    std::map<std::string, int> writers;
    for (const auto& [number, frame] : frames_)
      for (const std::string& file : frame.files)
        if (const auto [at, isNew] = writers.emplace(fs::path(file).lexically_normal().string(), number);
            !isNew && at->second != number) {
          refuse("batch-same-file", fmt::format("frames {} and {} both write \"{}\": # in the name of -o stands "
                                                "for the number of the frame; nothing was begun",
                                                at->second, number, file));
          return false;
        }
    if (!inPasses()) return true;
    for (const auto& [number, frame] : frames_)
      if (!frame.maps && (!frame.joins || frame.worlds > 1)) {
        refuse(
            "batch-tiles",
            fmt::format("{}: frame {} has {}; nothing was begun", tileCount() > 1 ? "--tiles" : "--share-records",
                        number, frame.worlds > 1 ? "several worlds" : "pictures that are not OpenEXR files, or maps"));
        return false;
      }
    return true;
  }

  std::string work(int frame, const std::string& end) const {
    return (plan_.folder() / "work" / fmt::format("{:04}{}", frame, end)).string();
  }
  static std::string tileEnd(int tile) { return fmt::format(".t{:03}.exr", tile); }

  static void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }
  std::vector<std::string> withScene(std::vector<std::string> arguments, int frame) const {
    append(arguments, options_.pictureArguments);
    append(arguments, lightArguments(frame));
    append(arguments, {"--frames", std::to_string(frame), "--progress"});
    if (apart_) arguments.push_back("--frames-apart");
    if (hasMakes_) append(arguments, {"--makes", "none"});
    append(arguments, options_.render.files);
    return arguments;
  }

  LightOfFrame lightOf(int frame) const {
    const auto light = light_.find(frame);
    return light == light_.end() ? LightOfFrame() : light->second;
  }
  std::vector<std::string> lightArguments(int frame) const {
    std::vector<std::string> out = options_.lightArguments;
    const std::string folder = lightOf(frame).folder;
    if (folder.empty()) return out;
    if (const auto given = std::find(out.begin(), out.end(), "--atlas"); given != out.end())
      out.erase(given, given + 2);
    append(out, {"--atlas", folder});
    return out;
  }

  void addLight(const std::vector<std::string>& needs) {
    std::vector<std::pair<int, SharedLight>> lit;
    for (const auto& [number, frame] : frames_)
      if (frame.light) lit.emplace_back(number, *frame.light);
    light_ = planLight(lit, options_, plan_.folder() / "work");
    for (auto& [number, light] : light_)
      for (BatchTask& task : light.tasks) {
        if (task.needs.empty()) task.needs = needs;
        task.arguments = withScene(std::move(task.arguments), number);
        plan_.tasks.push_back(std::move(task));
      }
  }

  std::string addRender(const char* stage, int number, const FrameFiles& frame, const std::vector<std::string>& needs,
                        const std::string& output) {
    std::vector<std::string> arguments{"render"};
    if (!output.empty()) append(arguments, {"-o", output});
    std::string name = taskName(number, stage);
    const LightOfFrame light = lightOf(number);
    std::vector<std::string> before = needs;
    append(before, light.needs);
    plan_.tasks.push_back(
        {name, stage, number, withScene(std::move(arguments), number), before, frame.files, light.removes});
    return name;
  }

  /// Hides and gathers frames, and then shades them: in groups of those that share records.
  void addPasses(const std::vector<std::string>& maps) {
    std::vector<int> group;
    const auto end = [&] {
      for (size_t i = 0; i < group.size(); ++i) {
        const std::string place = options_.sharedRecords > 1 ? fmt::format("{:03}", i) : "";
        addGather(group[i], i > 0 ? group[i - 1] : group[i], place, maps);
      }
      for (const int number : group) addShade(number, group.back(), group.size() > 1);
      group.clear();
    };
    for (const auto& [number, frame] : frames_) {
      if (frame.maps) continue;
      group.push_back(number);
      if (static_cast<int>(group.size()) == options_.sharedRecords) end();
    }
    end();
  }

  std::string shotOf(int frame) const { return work(frame, ".dfb"); }
  std::string recordsOf(int frame) const { return work(frame, ".icf"); }

  /// `before`: the frame whose records it begins with, or itself; `place`: in its group, as a part of stages.
  void addGather(int number, int before, const std::string& place, const std::vector<std::string>& maps) {
    const LightOfFrame shared = lightOf(number);
    const std::string hide = taskName(number, "hide");
    plan_.tasks.push_back({hide,
                           "hide" + place,
                           number,
                           withScene({"hide", "--resume", "-o", shotOf(number)}, number),
                           maps,
                           {shotOf(number)},
                           {}});
    BatchTask gather{taskName(number, "gather"),
                     "gather" + place,
                     number,
                     {"gather", "-o", recordsOf(number)},
                     {hide},
                     {recordsOf(number)},
                     {}};
    if (before != number) {
      append(gather.arguments, {"--irradiance", recordsOf(before)});
      gather.needs.push_back(taskName(before, "gather"));
      gather.removes = {recordsOf(before)};
    }
    append(gather.arguments, lightArguments(number));
    if (apart_) gather.arguments.push_back("--frames-apart");
    gather.arguments.push_back(shotOf(number));
    append(gather.needs, shared.needs);
    plan_.tasks.push_back(std::move(gather));
  }

  /// `records`: the frame whose records it is shaded with; they stay if others are, too.
  void addShade(int number, int records, bool others) {
    const FrameFiles& frame = frames_.at(number);
    std::vector<std::string> before, unneeded{shotOf(number)};
    if (!others) unneeded.push_back(recordsOf(records));
    append(unneeded, lightOf(number).removes);
    for (int i = 0; i < tileCount(); ++i) {
      const bool whole = tileCount() == 1;
      const std::vector<std::string>& files = whole ? frame.files : frame.tiles[static_cast<size_t>(i)];
      std::vector<std::string> shade{"shade", "--irradiance", recordsOf(records), "-o", files.front()};
      if (!whole) append(shade, {"--crop", cropText(options_.tiles, i)});
      append(shade, lightArguments(number));
      if (apart_) shade.push_back("--frames-apart");
      shade.push_back(shotOf(number));
      before.push_back(taskName(number, fmt::format("t{:03}", i)));
      plan_.tasks.push_back({before.back(),
                             fmt::format("shade{:03}", i),
                             number,
                             shade,
                             {taskName(records, "gather")},
                             files,
                             whole ? unneeded : std::vector<std::string>()});
      if (!whole) append(unneeded, files);
    }
    if (tileCount() > 1) addJoins(number, before, unneeded);
  }

  void addJoins(int number, std::vector<std::string> before, const std::vector<std::string>& unneeded) {
    const FrameFiles& frame = frames_.at(number);
    for (size_t f = 0; f < frame.files.size(); ++f) {  // one after the other, as the last one clears up
      const bool last = f + 1 == frame.files.size();
      std::vector<std::string> arguments{"join", "-o", frame.files[f]};
      for (const auto& files : frame.tiles) arguments.push_back(files[f]);
      const std::string stage = f == 0 ? "join" : fmt::format("join{}", f), name = taskName(number, stage);
      plan_.tasks.push_back({name,
                             stage,
                             number,
                             std::move(arguments),
                             before,
                             {frame.files[f]},
                             last ? unneeded : std::vector<std::string>()});
      before = {name};
    }
  }

  PlanOptions options_;
  Log& log_;
  BatchPlan plan_;
  static constexpr int kMake = INT_MIN;
  std::vector<int> events_;  ///< Numbers of frames, and kMake, in the order of the stream.
  bool hasMakes_ = false;    ///< Some of them are kMake.
  bool apart_ = true;        ///< Frames do not depend on each other.
  std::map<int, FrameFiles> frames_;
  std::map<int, LightOfFrame> light_;
};

}  // namespace

std::optional<BatchPlan> makePlan(const PlanOptions& options, Log& log) { return PlanMaker(options, log).make(); }

}  // namespace tomales
