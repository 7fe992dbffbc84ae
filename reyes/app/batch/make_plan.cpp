#include "reyes/app/batch/make_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

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
    if (!readRib(options_.render.files, rib, log_)) return std::nullopt;
    if (frames_.empty())
      return refuse("no-frame",
                    "there is no frame to render: the scene has no world, or none of the frames that --frames names");
    if (!suits()) return std::nullopt;
    std::vector<std::string> maps;
    for (const auto& [number, frame] : frames_)
      if (frame.maps) maps.push_back(addRender("maps", number, frame, {}, ""));
    for (const auto& [number, frame] : frames_) {
      if (frame.maps) continue;
      plan_.pictures.push_back(frame.files.front());
      if (tileCount() == 1)
        addRender("render", number, frame, maps, options_.render.output);
      else
        addTiled(number, frame, maps);
    }
    checkPlan(plan_);
    return plan_;
  }

 private:
  std::nullopt_t refuse(const char* code, const std::string& why) const {
    log_.report(Severity::Error, code, {std::make_shared<std::string>(options_.render.files.front()), 0}, why);
    return std::nullopt;
  }
  int tileCount() const { return options_.tiles[0] * options_.tiles[1]; }

  void take(Scene& scene) {
    const int number = scene.options.frame;
    const auto& wanted = options_.render.frames;
    if (wanted && !std::binary_search(wanted->begin(), wanted->end(), number)) return;
    applyOverrides(scene, options_.render);
    FrameFiles& frame = frames_[number];
    frame.maps = (frame.worlds == 0 || frame.maps) && writesMapsAlone(scene.options, options_.render);
    ++frame.worlds;
    for (const std::string& file : filesOf(scene.options, options_.render.output)) frame.files.push_back(file);
    for (const DisplayCall& d : scene.options.displays)
      frame.joins = frame.joins && !writesMap(d) && driverOf(d, scene.options, pluginTrust(options_.render)).empty();
    if (tileCount() == 1 || frame.maps) return;
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
    if (tileCount() == 1) return true;
    for (const auto& [number, frame] : frames_)
      if (!frame.maps && (!frame.joins || frame.worlds > 1)) {
        refuse("batch-tiles",
               fmt::format("--tiles: frame {} has {}; nothing was begun", number,
                           frame.worlds > 1 ? "several worlds" : "pictures that are not OpenEXR files, or maps"));
        return false;
      }
    return true;
  }

  std::string work(int frame, const std::string& end) const {
    return (plan_.folder() / "work" / fmt::format("{:04}{}", frame, end)).string();
  }
  static std::string tileEnd(int tile) { return fmt::format(".t{:03}.exr", tile); }
  static std::string nameOf(int frame, const std::string& stage) { return fmt::format("{:04}.{}", frame, stage); }

  static void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }
  std::vector<std::string> withScene(std::vector<std::string> arguments, int frame) const {
    append(arguments, options_.pictureArguments);
    append(arguments, options_.lightArguments);
    append(arguments, {"--frames", std::to_string(frame), "--progress"});
    append(arguments, options_.render.files);
    return arguments;
  }

  std::string addRender(const char* stage, int number, const FrameFiles& frame, const std::vector<std::string>& needs,
                        const std::string& output) {
    std::vector<std::string> arguments{"render"};
    if (!output.empty()) append(arguments, {"-o", output});
    std::string name = nameOf(number, stage);
    plan_.tasks.push_back({name, stage, number, withScene(std::move(arguments), number), needs, frame.files, {}});
    return name;
  }

  void addTiled(int number, const FrameFiles& frame, const std::vector<std::string>& maps) {
    const std::string shot = work(number, ".dfb"), cache = work(number, ".icf");
    const std::string hide = nameOf(number, "hide"), gather = nameOf(number, "gather");
    plan_.tasks.push_back(
        {hide, "hide", number, withScene({"hide", "--resume", "-o", shot}, number), maps, {shot}, {}});
    std::vector<std::string> light{"gather", "-o", cache};
    append(light, options_.lightArguments);
    light.push_back(shot);
    plan_.tasks.push_back({gather, "gather", number, light, {hide}, {cache}, {}});
    std::vector<std::string> before, unneeded{shot, cache};
    for (int i = 0; i < tileCount(); ++i) {
      const std::vector<std::string>& files = frame.tiles[static_cast<size_t>(i)];
      std::vector<std::string> shade{"shade", "--irradiance", cache, "--crop", cropText(options_.tiles, i),
                                     "-o",    files.front()};
      append(shade, options_.lightArguments);
      shade.push_back(shot);
      before.push_back(nameOf(number, fmt::format("t{:03}", i)));
      plan_.tasks.push_back({before.back(), "shade", number, shade, {gather}, files, {}});
      append(unneeded, files);
    }
    for (size_t f = 0; f < frame.files.size(); ++f) {  // one after the other, as the last one clears up
      const bool last = f + 1 == frame.files.size();
      std::vector<std::string> arguments{"join", "-o", frame.files[f]};
      for (const auto& files : frame.tiles) arguments.push_back(files[f]);
      const std::string name = nameOf(number, f == 0 ? "join" : fmt::format("join{}", f));
      plan_.tasks.push_back({name,
                             f == 0 ? "join" : fmt::format("join{}", f),
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
  std::map<int, FrameFiles> frames_;
};

}  // namespace

std::optional<BatchPlan> makePlan(const PlanOptions& options, Log& log) { return PlanMaker(options, log).make(); }

}  // namespace tomales
