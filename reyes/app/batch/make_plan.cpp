#include "reyes/app/batch/make_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "reyes/app/batch/frames.h"
#include "reyes/app/batch/plan_light.h"
#include "reyes/app/frame/held_quality.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

std::string cropText(const std::array<int, 2>& tiles, int index) {
  const auto share = [](int i, int count) { return fmt::format("{:.9g}", static_cast<double>(i) / count); };
  const int x = index % tiles[0], y = index / tiles[0];
  return fmt::format("{},{},{},{}", share(x, tiles[0]), share(x + 1, tiles[0]), share(y, tiles[1]),
                     share(y + 1, tiles[1]));
}

class PlanMaker {
 public:
  PlanMaker(const PlanOptions& options, Log& log) : options_(options), log_(log) {
    plan_.file = fs::absolute(options.file).lexically_normal();
    plan_.workingFolder = fs::current_path().string();
  }

  std::optional<BatchPlan> make() {
    auto frames = readFrames(options_, plan_, log_);
    if (!frames) return std::nullopt;
    scene_ = std::move(*frames);
    const std::vector<std::string> maps = addMaps();
    addLight(maps);
    const std::vector<std::string> settings = addSettings(maps);
    for (const auto& [number, frame] : scene_.frames) {
      if (frame.maps) continue;
      plan_.pictures.push_back(frame.files.front());
      if (!options_.inPasses()) addRender("render", number, frame, settings, options_.render.picture.output);
    }
    if (options_.inPasses()) addPasses(maps);
    checkPlan(plan_);
    return plan_;
  }

 private:
  /// Adds frames that make maps, and Make requests, in the order of the stream. Returns the tasks that all other frames
  /// need.
  std::vector<std::string> addMaps() {
    std::vector<std::string> needs, since;  // needs: the last Make requests; since: the frames after them
    int make = 0, makes = 0;
    const auto addMakes = [&](int first, int end) {
      if (first == end) return;
      append(since, needs);
      const std::string name = fmt::format("make{:03}", makes++);
      const std::string range = first + 1 == end ? std::to_string(first) : fmt::format("{}-{}", first, end - 1);
      std::vector<std::string> arguments{"render", "--frames", "none", "--makes", range};
      append(arguments, options_.lightArguments);
      append(arguments, options_.render.input.files);
      plan_.tasks.push_back({name, name, scene_.frames.begin()->first, arguments, std::exchange(since, {}), {}, {}});
      needs = {name};
    };
    int done = 0;
    std::set<int> added;
    for (const int event : scene_.events) {
      if (event == BatchFrames::kMake) {
        ++make;
        continue;
      }
      const FrameFiles& frame = scene_.frames.at(event);
      if (!frame.maps || !added.insert(event).second) continue;
      addMakes(std::exchange(done, make), make);
      since.push_back(addRender("maps", event, frame, needs, ""));
    }
    addMakes(done, make);
    append(since, needs);
    return since;
  }

  static void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }
  std::vector<std::string> withScene(std::vector<std::string> arguments, int frame) const {
    append(arguments, options_.pictureArguments);
    append(arguments, lightArguments(frame));
    append(arguments, {"--frames", std::to_string(frame), "--progress"});
    if (scene_.apart) arguments.push_back("--frames-apart");
    if (scene_.hasMakes) append(arguments, {"--makes", "none"});
    append(arguments, options_.render.input.files);
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
    for (const auto& [number, frame] : scene_.frames)
      if (frame.light) lit.emplace_back(number, *frame.light);
    light_ = planLight(lit, options_, plan_.folder() / "work");
    for (auto& [number, light] : light_)
      for (BatchTask& task : light.tasks) {
        if (task.needs.empty()) task.needs = needs;
        task.arguments = withScene(std::move(task.arguments), number);
        plan_.tasks.push_back(std::move(task));
      }
  }

  /// Adds the task that finds settings of light for all frames, if they need one. Returns the tasks that frames then
  /// need.
  std::vector<std::string> addSettings(const std::vector<std::string>& needs) {
    target_ = options_.targetArguments;
    const RenderSettings& render = options_.render;
    const bool isOneFrame =
        scene_.frames.size() == 1 && render.quality.animationSettings.empty() && !render.quality.pilotFrames;
    if (!render.quality.chooses() || isOneFrame) return needs;
    std::vector<int> numbers;
    for (const auto& [number, frame] : scene_.frames) numbers.push_back(number);
    const std::vector<int> pilots =
        render.quality.pilotFrames.value_or(pilotsOf(render.input.frames.value_or(numbers)));
    const std::string file = render.quality.animationSettings.empty()
                                 ? (plan_.folder() / "work" / "settings.json").string()
                                 : render.quality.animationSettings;
    if (render.quality.animationSettings.empty()) append(target_, {"--animation-settings", file});
    if (!render.quality.pilotFrames) append(target_, {"--pilot-frames", fmt::format("{}", fmt::join(pilots, ","))});
    std::vector<std::string> arguments{"render", "--frames", "none", "--makes", "none"};
    append(arguments, options_.pictureArguments);
    append(arguments, options_.lightArguments);
    append(arguments, target_);
    append(arguments, render.input.files);
    const std::string name = "settings";
    plan_.tasks.push_back({name, name, numbers.front(), arguments, needs, {file}, {}});
    return {name};
  }

  std::string addRender(const char* stage, int number, const FrameFiles& frame, const std::vector<std::string>& needs,
                        const std::string& output) {
    std::vector<std::string> arguments{"render"};
    if (!output.empty()) append(arguments, {"-o", output});
    if (!frame.maps) append(arguments, target_);
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
    for (const auto& [number, frame] : scene_.frames) {
      if (frame.maps) continue;
      group.push_back(number);
      if (static_cast<int>(group.size()) == options_.sharedRecords) end();
    }
    end();
  }

  std::string shotOf(int frame) const { return plan_.workOf(frame, ".dfb").string(); }
  std::string recordsOf(int frame) const { return plan_.workOf(frame, ".icf").string(); }

  /// `before`: the frame whose records it begins with; its own number if there is none. `place`: its place in the
  /// group, which ends the names of its stages.
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
    // Tiles trace the rays of shading themselves, unless each had to make maps of light for them.
    if (!scene_.frames.at(number).light || !shared.folder.empty()) gather.arguments.push_back("--no-answers");
    append(gather.arguments, lightArguments(number));
    if (scene_.apart) gather.arguments.push_back("--frames-apart");
    gather.arguments.push_back(shotOf(number));
    append(gather.needs, shared.needs);
    plan_.tasks.push_back(std::move(gather));
  }

  /// `records`: the frame whose records it is shaded with. They are kept if `others` are shaded with them too.
  void addShade(int number, int records, bool others) {
    const FrameFiles& frame = scene_.frames.at(number);
    std::vector<std::string> before, unneeded{shotOf(number)};
    if (!others) unneeded.push_back(recordsOf(records));
    append(unneeded, lightOf(number).removes);
    for (int i = 0; i < options_.tileCount(); ++i) {
      const bool whole = options_.tileCount() == 1;
      const std::vector<std::string>& files = whole ? frame.files : frame.tiles[static_cast<size_t>(i)];
      std::vector<std::string> shade{"shade", "--irradiance", recordsOf(records), "-o", files.front()};
      if (!whole) append(shade, {"--crop", cropText(options_.tiles, i)});
      append(shade, lightArguments(number));
      if (scene_.apart) shade.push_back("--frames-apart");
      shade.push_back(shotOf(number));
      before.push_back(taskName(number, fmt::format("t{:03}", i)));
      plan_.tasks.push_back({before.back(),
                             fmt::format("shade{:03}", i),
                             number,
                             shade,
                             {taskName(number, "hide"), taskName(records, "gather")},
                             files,
                             whole ? unneeded : std::vector<std::string>()});
      if (!whole) append(unneeded, files);
    }
    if (options_.tileCount() > 1) addJoins(number, before, unneeded);
  }

  void addJoins(int number, const std::vector<std::string>& tiles, const std::vector<std::string>& unneeded) {
    const FrameFiles& frame = scene_.frames.at(number);
    std::vector<std::string> before = tiles;
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
      before = tiles;
      before.push_back(name);
    }
  }

  PlanOptions options_;
  Log& log_;
  BatchPlan plan_;
  BatchFrames scene_;
  /// Arguments for frames that are no maps: the target that their light has to reach.
  std::vector<std::string> target_;
  std::map<int, LightOfFrame> light_;
};

}  // namespace

std::optional<BatchPlan> makePlan(const PlanOptions& options, Log& log) { return PlanMaker(options, log).make(); }

}  // namespace tomales
