#include "reyes/app/batch/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "reyes/app/chart/html.h"
#include "reyes/base/temporary_folder.h"
#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr size_t kLogLines = 6;
constexpr int kThumbnail = 160;  ///< Pixels of the longer edge.

/// A state that a frame may have, and the list of the frames that are in it.
struct FrameState {
  const char* name;
  std::vector<int> BatchReport::*frames;
};
constexpr FrameState kFinished{"finished", &BatchReport::finished}, kRunning{"running", &BatchReport::running},
    kWaiting{"waiting", &BatchReport::waiting}, kFailed{"failed", &BatchReport::failed},
    kBlocked{"blocked", &BatchReport::blocked};
constexpr FrameState kUnfinished[] = {kRunning, kWaiting, kFailed, kBlocked};

struct FrameFigures {
  bool allDone = true, anyFailed = false, anyBlocked = false, anyRunning = false, anyDone = false;
  double cpu_s = 0, wall_s = 0;
  int64_t peak_bytes = 0;
  int worstCode = 0;

  const FrameState& state() const {
    return anyFailed               ? kFailed
           : allDone               ? kFinished
           : anyBlocked            ? kBlocked
           : anyRunning || anyDone ? kRunning
                                   : kWaiting;
  }
};

/// Returns for each task the failed task that it waits for, directly or through others; null if there is none.
std::vector<const BatchTask*> blockersOf(const BatchPlan& plan, const std::vector<TaskState>& states) {
  std::map<std::string, const BatchTask*> blockerOfThose;  // of tasks that need the one of this name
  std::vector<const BatchTask*> out;
  for (size_t i = 0; i < states.size(); ++i) {
    const BatchTask& task = plan.tasks[i];
    const BatchTask*& blocker = out.emplace_back();
    for (const std::string& need : task.needs)
      if (!blocker) blocker = blockerOfThose[need];
    if (states[i].kind == TaskState::Done || states[i].kind == TaskState::Running) blocker = nullptr;
    blockerOfThose[task.name] = states[i].kind == TaskState::Failed ? &task : blocker;
  }
  return out;
}

std::map<int, FrameFigures> figuresOf(const BatchPlan& plan, const std::vector<TaskState>& states) {
  std::map<int, FrameFigures> out;
  const std::vector<const BatchTask*> blockers = blockersOf(plan, states);
  for (size_t i = 0; i < states.size(); ++i) {
    FrameFigures& f = out[plan.tasks[i].frame];
    const TaskState& s = states[i];
    f.allDone &= s.kind == TaskState::Done;
    f.anyDone |= s.kind == TaskState::Done;
    f.anyFailed |= s.kind == TaskState::Failed;
    f.anyBlocked |= blockers[i] != nullptr;
    f.anyRunning |= s.kind == TaskState::Running;
    f.cpu_s += s.cpu_s;
    f.wall_s += s.wall_s;
    f.peak_bytes = std::max(f.peak_bytes, s.peak_bytes);
    f.worstCode = std::max(f.worstCode, s.code);
  }
  return out;
}

/// Returns the numbers of the other frames that task `failed` holds up.
std::vector<int> framesBehind(const BatchPlan& plan, size_t failed, const std::vector<const BatchTask*>& blockers) {
  std::set<int> out;
  for (size_t i = failed + 1; i < blockers.size(); ++i)
    if (blockers[i] == &plan.tasks[failed] && plan.tasks[i].frame != plan.tasks[failed].frame)
      out.insert(plan.tasks[i].frame);
  return {out.begin(), out.end()};
}

/// Returns numbers of frames in the form of --frames.
std::string rangesOf(const std::vector<int>& numbers) {
  std::string out;
  for (size_t i = 0; i < numbers.size();) {
    size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    out += (out.empty() ? "" : ",") + std::to_string(numbers[i]);
    if (last > i) out += "-" + std::to_string(numbers[last]);
    i = last + 1;
  }
  return out;
}

/// Writes a small picture to a PNG file. Returns false if there is no picture.
bool writeThumbnail(const std::string& picture, const std::string& file) {
  std::string error;
  const auto whole = readImage(picture, error);
  if (!whole || whole->width <= 0 || whole->height <= 0) return false;
  const int step = std::max(1, (std::max(whole->width, whole->height) + kThumbnail - 1) / kThumbnail);
  Image small{std::max(1, whole->width / step), std::max(1, whole->height / step), {"R", "G", "B"}, {}};
  small.pixels.resize(static_cast<size_t>(small.width) * static_cast<size_t>(small.height) * 3);
  for (int c = 0; c < 3; ++c) {
    const int from = std::max(0, whole->channelIndex(small.channels[static_cast<size_t>(c)]));
    for (int y = 0; y < small.height; ++y)
      for (int x = 0; x < small.width; ++x) {
        float sum = 0;
        int count = 0;
        for (int j = y * step; j < std::min((y + 1) * step, whole->height); ++j)
          for (int i = x * step; i < std::min((x + 1) * step, whole->width); ++i, ++count)
            sum += std::clamp(whole->at(i, j)[from], 0.0f, 1.0f);
        small.at(x, y)[c] = count > 0 ? sum / static_cast<float>(count) : 0;
      }
  }
  Log log(Log::Verbosity::Quiet);
  return writeImage(file, small, true, log);
}

}  // namespace

BatchReport reportOf(const BatchPlan& plan, const std::vector<TaskState>& states) {
  BatchReport out;
  for (const auto& [number, f] : figuresOf(plan, states)) {
    (out.*f.state().frames).push_back(number);
    out.cpu_s += f.cpu_s;
    out.peak_bytes = std::max(out.peak_bytes, f.peak_bytes);
  }
  const std::vector<const BatchTask*> blockers = blockersOf(plan, states);
  std::map<std::string, std::pair<double, int>> timesOfStage;
  int atOnce = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    if (states[i].kind == TaskState::Failed)
      out.failures.push_back({plan.tasks[i].name, framesBehind(plan, i, blockers)});
    if (states[i].kind == TaskState::Running) ++atOnce;
    if (states[i].kind != TaskState::Done) continue;
    auto& [sum, count] = timesOfStage[plan.tasks[i].stage];
    sum += states[i].wall_s;
    ++count;
  }
  double left = 0;
  bool known = !timesOfStage.empty();
  for (size_t i = 0; i < states.size(); ++i) {
    if (states[i].kind == TaskState::Done || states[i].kind == TaskState::Failed || blockers[i]) continue;
    const auto stage = timesOfStage.find(plan.tasks[i].stage);
    known &= stage != timesOfStage.end();
    if (stage != timesOfStage.end()) left += stage->second.first / stage->second.second;
  }
  if (known) out.left_s = left / std::max(1, atOnce);
  return out;
}

std::string textOf(const BatchPlan& plan, const BatchReport& report) {
  std::string out = fmt::format("finished {} of {} frames, {} %\n", report.finished.size(), report.frames(),
                                report.frames() > 0 ? 100 * report.finished.size() / report.frames() : 100);
  for (const auto& [name, frames] : kUnfinished)
    if (const std::vector<int>& numbers = report.*frames; !numbers.empty())
      out += fmt::format("{} {}: {}\n", name, numbers.size(), rangesOf(numbers));
  if (report.left_s > 0) out += fmt::format("about {:.0f} s are left\n", report.left_s);
  for (const auto& [task, blocks] : report.failures) {
    const std::string waits = blocks.empty() ? "" : fmt::format(", and frames {} wait for it", rangesOf(blocks));
    out += fmt::format("task {} failed{}; its log ends with\n{}", task, waits,
                       lastLines(plan.logOf(*plan.find(task)), kLogLines));
  }
  return out;
}

std::string jsonOf(const BatchPlan& plan, const std::vector<TaskState>& states) {
  const BatchReport report = reportOf(plan, states);
  Json frames = Json::array();
  for (const auto& [number, f] : figuresOf(plan, states))
    frames.push_back({{"frame", number},
                      {"state", f.state().name},
                      {"cpu_s", f.cpu_s},
                      {"wall_s", f.wall_s},
                      {"peak_bytes", f.peak_bytes},
                      {"exit_code", f.worstCode}});
  Json failures = Json::array();
  for (const auto& [task, blocks] : report.failures)
    failures.push_back({{"task", task},
                        {"blocks", blocks},
                        {"log", plan.logOf(*plan.find(task)).string()},
                        {"last_lines", lastLines(plan.logOf(*plan.find(task)), kLogLines)}});
  Json out{{"plan", plan.file.string()},
           {"frames", report.frames()},
           {"finished", report.finished.size()},
           {"cpu_s", report.cpu_s},
           {"peak_bytes", report.peak_bytes},
           {"left_s", report.left_s < 0 ? Json() : Json(report.left_s)},
           {"failures", failures},
           {"by_frame", frames}};
  for (const auto& [name, numbers] : kUnfinished) out[name] = (report.*numbers).size();
  return out.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string pageOf(const BatchPlan& plan, const std::vector<TaskState>& states) {
  const BatchReport report = reportOf(plan, states);
  const std::string title = "Batch " + plan.folder().filename().string();
  Markup page;
  page.openPage(title, title,
                "figure{display:inline-block;margin:4px;font-size:small}.failed{color:#c00}.blocked{color:#c00}td,th{"
                "padding:0 8px}");
  page.put("<pre>{}</pre>\n", escapeXml(textOf(plan, report)));
  const TemporaryFolder folder(fs::temp_directory_path());
  const std::string png = (folder.path() / "small.png").string();
  for (const std::string& picture : plan.pictures) {
    if (writeThumbnail((fs::path(plan.workingFolder) / picture).string(), png))
      page.put("<figure><img src=\"{}\"><figcaption>{}</figcaption></figure>\n", embedded(png),
               escapeXml(fs::path(picture).filename().string()));
  }
  page.put("<table><tr><th>frame<th>state<th>CPU s<th>wall s<th>memory<th>exit code</tr>\n");
  for (const auto& [number, f] : figuresOf(plan, states))
    page.put("<tr class=\"{}\"><td>{}<td>{}<td>{:.2f}<td>{:.2f}<td>{}<td>{}</tr>\n", f.state().name, number,
             f.state().name, f.cpu_s, f.wall_s, megabytes(static_cast<double>(f.peak_bytes)), f.worstCode);
  page.put("</table>\n");
  page.closePage();
  return page.take();
}

}  // namespace tomales
