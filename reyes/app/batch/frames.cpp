#include "reyes/app/batch/frames.h"

#include <fmt/format.h>

#include <algorithm>

#include "reyes/app/frame/outputs.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

std::string tileEnd(int tile) { return fmt::format(".t{:03}.exr", tile); }

class FrameReader {
 public:
  FrameReader(const PlanOptions& options, const BatchPlan& plan, Log& log) : options_(options), plan_(plan), log_(log) {
    options_.render.input.sources = makeSources(options_.render.input.files);
  }

  std::optional<BatchFrames> read() {
    RibSettings rib;
    rib.trust = options_.render.input.trust;
    rib.onScene = [this](Scene&& scene) { take(scene); };
    rib.onMake = [this](const Request&) {
      out_.events.push_back(BatchFrames::kMake);
      out_.hasMakes = true;
    };
    rib.onOutliving = [this](const Request&) { out_.apart = false; };
    if (!readRib(options_.render.input.files, rib, log_)) return std::nullopt;
    if (out_.frames.empty())
      refuse("no-frame",
             "there is no frame to render: the scene has no world, or none of the frames that --frames names");
    else if (writesApart() && suitsPasses())
      return std::move(out_);
    return std::nullopt;
  }

 private:
  void refuse(const char* code, const std::string& why) const {
    log_.report(Severity::Error, code, {std::make_shared<std::string>(options_.render.input.files.front()), 0}, why);
  }

  void take(Scene& scene) {
    const int number = scene.options.frame;
    const auto& wanted = options_.render.input.frames;
    if (wanted && !std::binary_search(wanted->begin(), wanted->end(), number)) return;
    applyOverrides(scene, options_.render);
    FrameFiles& frame = out_.frames[number];
    out_.events.push_back(number);
    frame.maps = (frame.worlds == 0 || frame.maps) && writesMapsAlone(scene.options, options_.render);
    ++frame.worlds;
    for (const std::string& file : filesOf(scene.options, options_.render.picture.output)) frame.files.push_back(file);
    for (const DisplayCall& d : scene.options.displays)
      frame.joins = frame.joins && !writesMap(d) && driverOf(d, scene.options, pluginTrust(options_.render)).empty();
    frame.light.reset();  // worlds of one frame have no folder of their own
    Log quiet(Log::Verbosity::Quiet);
    if (frame.worlds == 1 && !frame.maps) frame.light = sharedLightOf(scene, options_.render, quiet);
    if (!options_.inPasses() || frame.maps) return;
    for (int i = 0; i < options_.tileCount(); ++i)
      frame.tiles.push_back(filesOf(scene.options, plan_.workOf(number, tileEnd(i)).string()));
    for (const std::string& file : frame.files) frame.joins = frame.joins && file.ends_with(".exr");
  }

  std::vector<std::string> filesOf(Options options, const std::string& output) const {
    RenderSettings settings = options_.render;
    settings.picture.output = output;
    Log quiet(Log::Verbosity::Quiet);
    nameOutputs(options, settings, quiet);
    std::vector<std::string> out;
    for (const DisplayCall& d : options.displays)
      out.push_back(driverOf(d, options, pluginTrust(settings)).empty() ? fileOf(d) : d.name);
    return out;
  }

  // The checks that follow find problems that would otherwise be found only after frames have been rendered.

  bool writesApart() const {
    std::map<std::string, int> writers;
    for (const auto& [number, frame] : out_.frames)
      for (const std::string& file : frame.files)
        if (const auto [at, isNew] = writers.emplace(placeOf(file), number); !isNew && at->second != number) {
          refuse("batch-same-file", fmt::format("frames {} and {} both write \"{}\": # in the name of -o stands "
                                                "for the number of the frame; nothing was begun",
                                                at->second, number, file));
          return false;
        }
    return true;
  }

  bool suitsPasses() const {
    if (!options_.inPasses()) return true;
    for (const auto& [number, frame] : out_.frames)
      if (!frame.maps && (!frame.joins || frame.worlds > 1)) {
        const char* has = frame.worlds > 1 ? "several worlds" : "pictures that are not OpenEXR files, or maps";
        refuse("batch-tiles", fmt::format("{}: frame {} has {}; nothing was begun",
                                          options_.tileCount() > 1 ? "--tiles" : "--share-records", number, has));
        return false;
      }
    return true;
  }

  PlanOptions options_;
  const BatchPlan& plan_;
  Log& log_;
  BatchFrames out_;
};

}  // namespace

std::optional<BatchFrames> readFrames(const PlanOptions& options, const BatchPlan& plan, Log& log) {
  return FrameReader(options, plan, log).read();
}

}  // namespace tomales
