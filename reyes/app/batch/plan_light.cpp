#include "reyes/app/batch/plan_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kPhotonsOfPart = 1'000'000;

/// Frames that follow each other and share maps.
struct LitFrames {
  SharedLight light;
  std::vector<int> frames;
};

std::vector<LitFrames> litFrames(const std::vector<std::pair<int, SharedLight>>& frames) {
  std::vector<LitFrames> out;
  for (const auto& [number, light] : frames) {
    const auto shares = [&, &l = light](const SharedLight& o) {
      return !l.folder.empty() && l.folder == o.folder && l.world == o.world && l.photons == o.photons;
    };
    if (out.empty() || !shares(out.back().light)) out.push_back({light, {}});
    out.back().frames.push_back(number);
  }
  return out;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// The tasks that make the maps of some frames in a folder.
class MapTasks {
 public:
  MapTasks(const LitFrames& lit, const std::string& folder, int parts)
      : light_(lit.light),
        maps_(light_.maps.begin(), light_.maps.end()),
        frame_(lit.frames.front()),
        folder_(folder),
        parts_(parts) {}

  std::vector<BatchTask> make() {
    if (parts_ == 1)
      add("lightmaps", {}, {}, everything());
    else
      addParts();
    return std::move(tasks_);
  }

 private:
  std::vector<std::string> photons() const {
    std::vector<std::string> out;
    for (const std::string& map : maps_)
      if (light_.photons) out.push_back(photonsOfMap(folder_, map));
    return out;
  }
  std::vector<std::string> everything() const {
    std::vector<std::string> out = photons();
    for (const std::string& map : maps_) append(out, filesOfMap(light_, folder_, map));
    return out;
  }

  void addParts() {
    std::vector<std::string> traced, pieces;
    for (int i = 0; i < parts_; ++i) {
      pieces.push_back(photonPart(folder_, {i, parts_}).string());
      traced.push_back(add(fmt::format("photons{:04}", i), {"--pass", "photons", "--part", partText(i, parts_)}, {},
                           {pieces.back()}, "photons"));
    }
    const std::string join =
        add("joinphotons", {"--pass", "join", "--part", partText(parts_ - 1, parts_)}, traced, photons());
    tasks_.back().removes = pieces;
    const int shares = std::min(parts_, static_cast<int>(maps_.size()));
    for (int i = 0; i < shares; ++i) {
      std::vector<std::string> makes;
      for (size_t m = static_cast<size_t>(i); m < maps_.size(); m += static_cast<size_t>(shares))
        append(makes, filesOfMap(light_, folder_, maps_[m]));
      add(fmt::format("lightmaps{:04}", i), {"--pass", "maps", "--part", partText(i, shares)}, {join}, makes,
          "lightmaps");
    }
  }
  static std::string partText(int index, int count) { return fmt::format("{}/{}", index + 1, count); }

  std::string add(const std::string& name, const std::vector<std::string>& pass, const std::vector<std::string>& needs,
                  const std::vector<std::string>& makes, const std::string& stage = "") {
    BatchTask task{taskName(frame_, name), stage.empty() ? name : stage, frame_, {"prepare"}, needs, makes, {}};
    append(task.arguments, pass);
    tasks_.push_back(task);
    return task.name;
  }

  const SharedLight& light_;
  const std::vector<std::string> maps_;
  const int frame_;
  const std::string folder_;
  const int parts_;
  std::vector<BatchTask> tasks_;
};

/// Returns the number of tasks that trace the photons of one world.
int partsOf(const SharedLight& light, const PlanOptions& options) {
  if (!light.photons) return 1;
  if (options.photonParts > 0) return options.photonParts;
  return static_cast<int>(
      std::clamp<int64_t>((options.render.light.photons + kPhotonsOfPart - 1) / kPhotonsOfPart, 1, kMostParts));
}

}  // namespace

std::map<int, LightOfFrame> planLight(const std::vector<std::pair<int, SharedLight>>& frames,
                                      const PlanOptions& options, const fs::path& work) {
  std::map<int, LightOfFrame> out;
  const std::vector<LitFrames> all = litFrames(frames);
  for (const LitFrames& lit : all) {
    const int first = lit.frames.front(), parts = partsOf(lit.light, options);
    const bool named = !lit.light.folder.empty();
    if (!named && (options.photonParts == 0 || !lit.light.photons)) continue;
    LightOfFrame light;
    light.folder = !named           ? (work / fmt::format("{:04}.atlas", first)).string()
                   : all.size() > 1 ? (fs::path(lit.light.folder) / fmt::format("{:04}", first)).string()
                                    : lit.light.folder;
    const bool doesItself = lit.frames.size() == 1 && parts == 1;
    const std::vector<BatchTask> tasks =
        doesItself ? std::vector<BatchTask>() : MapTasks(lit, light.folder, parts).make();
    for (const BatchTask& t : tasks) {
      const bool isLast = t.stage == "lightmaps";
      if (isLast) light.needs.push_back(t.name);
      if (!named && t.stage != "photons") append(light.removes, t.makes);
    }
    for (const int frame : lit.frames) out[frame] = light;
    out[first].tasks = tasks;
  }
  return out;
}

}  // namespace tomales
