#include "reyes/app/batch/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "reyes/base/checksum.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kPlanVersion = 1;
constexpr const char* kStates[] = {"waiting", "running", "done", "failed"};

[[noreturn]] void refusePlan(const BatchPlan& plan, const std::string& why) {
  throw FileError(fmt::format("the plan \"{}\" cannot be run: {}", plan.file.string(), why));
}

std::optional<std::string> contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool isPlainName(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && name.front() != '.' && name.front() != '-' && std::all_of(name.begin(), name.end(), plain);
}

/// Returns the tasks in topological order (Kahn's algorithm). Tasks that are ready at the same time keep their order.
std::vector<BatchTask> inOrder(const BatchPlan& plan) {
  std::map<std::string, std::vector<size_t>> followers;
  std::vector<size_t> missing(plan.tasks.size());
  for (size_t i = 0; i < plan.tasks.size(); ++i) {
    missing[i] = plan.tasks[i].needs.size();
    for (const std::string& n : plan.tasks[i].needs) followers[n].push_back(i);
  }
  std::deque<size_t> ready;
  for (size_t i = 0; i < missing.size(); ++i)
    if (missing[i] == 0) ready.push_back(i);
  std::vector<BatchTask> out;
  for (; !ready.empty(); ready.pop_front()) {
    const BatchTask& task = out.emplace_back(plan.tasks[ready.front()]);
    for (const size_t i : followers[task.name])
      if (--missing[i] == 0) ready.push_back(i);
  }
  for (size_t i = 0; i < missing.size(); ++i)
    if (missing[i] > 0)
      refusePlan(plan,
                 fmt::format("task \"{}\" waits for itself by way of the tasks that it needs", plan.tasks[i].name));
  return out;
}

bool isJoin(const BatchTask& task) { return task.arguments.front() == "join"; }

}  // namespace

const BatchTask* BatchPlan::find(const std::string& name) const {
  const auto it = std::find_if(tasks.begin(), tasks.end(), [&](const BatchTask& t) { return t.name == name; });
  return it == tasks.end() ? nullptr : &*it;
}

fs::path BatchPlan::workOf(int frame, const std::string& end) const {
  return folder() / "work" / fmt::format("{:04}{}", frame, end);
}

void checkPlan(BatchPlan& plan) {
  std::set<std::string> names;
  std::map<std::string, std::string> makers;
  for (const BatchTask& t : plan.tasks) {
    if (!isPlainName(t.name))
      refusePlan(plan,
                 fmt::format("\"{}\" is no name of a task: such a name has letters, digits, - _ and . only", t.name));
    if (!names.insert(t.name).second) refusePlan(plan, fmt::format("two tasks are called \"{}\"", t.name));
    if (t.arguments.empty()) refusePlan(plan, fmt::format("task \"{}\" has no arguments", t.name));
    for (const std::string& file : t.makes) {
      const fs::path place = (fs::path(plan.workingFolder) / file).lexically_normal();
      if (const auto [at, isNew] = makers.emplace(place.string(), t.name); !isNew)
        refusePlan(plan, fmt::format("\"{}\" and \"{}\" both make \"{}\"", at->second, t.name, file));
    }
  }
  for (const BatchTask& t : plan.tasks)
    for (const std::string& n : t.needs)
      if (!names.contains(n)) refusePlan(plan, fmt::format("task \"{}\" needs \"{}\", which is not there", t.name, n));
  plan.tasks = inOrder(plan);
}

BatchPlan readPlan(const fs::path& file) {
  BatchPlan plan;
  plan.file = fs::absolute(file).lexically_normal();
  const auto text = contentOf(plan.file);
  if (!text) throw FileError(fmt::format("there is no plan \"{}\"", file.string()));
  try {
    const Json json = Json::parse(*text);
    if (json.at("version").get<int>() != kPlanVersion)
      refusePlan(plan, fmt::format("its version is {}, and this program reads version {}", json["version"].dump(),
                                   kPlanVersion));
    json.at("working_folder").get_to(plan.workingFolder);
    json.at("pictures").get_to(plan.pictures);
    for (const Json& t : json.at("tasks"))
      plan.tasks.push_back({t.at("name"), t.at("stage"), t.at("frame"), t.at("arguments"), t.at("needs"), t.at("makes"),
                            t.value("removes", std::vector<std::string>())});
  } catch (const Json::exception& e) {
    refusePlan(plan, e.what());
  }
  checkPlan(plan);
  return plan;
}

std::string planText(const BatchPlan& plan) {
  Json tasks = Json::array();
  for (const BatchTask& t : plan.tasks) {
    Json task{{"name", t.name},           {"stage", t.stage}, {"frame", t.frame},
              {"arguments", t.arguments}, {"needs", t.needs}, {"makes", t.makes}};
    if (!t.removes.empty()) task["removes"] = t.removes;
    tasks.push_back(std::move(task));
  }
  const Json json{{"version", kPlanVersion},
                  {"working_folder", plan.workingFolder},
                  {"pictures", plan.pictures},
                  {"tasks", std::move(tasks)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void makeFolders(const BatchPlan& plan) {
  std::error_code problem;
  for (const char* name : {"log", "state", "work"}) {
    fs::create_directories(plan.folder() / name, problem);
    if (problem)
      throw WriteError(fmt::format("\"{}\" could not be made: {}", (plan.folder() / name).string(), problem.message()));
  }
}

void writePlan(const BatchPlan& plan) {
  makeFolders(plan);
  std::string why;
  if (!writeFile(plan.file.string(), planText(plan), why))
    throw WriteError(fmt::format("\"{}\" could not be written: {}", plan.file.string(), why));
}

std::string taskName(int frame, const std::string& stage) { return fmt::format("{:04}.{}", frame, stage); }

uint64_t taskSum(const BatchTask& task) {
  std::string text;
  for (const std::string& a : task.arguments) text += a + '\0';
  return checksum(std::as_bytes(std::span(text)));
}

TaskState readState(const BatchPlan& plan, const BatchTask& task) {
  TaskState out;
  const auto text = contentOf(plan.stateOf(task));
  const Json json = text ? Json::parse(*text, nullptr, false) : Json();
  try {
    const auto kind = std::find(std::begin(kStates), std::end(kStates), json.at("state").get<std::string>());
    if (kind == std::end(kStates)) return {};
    out.kind = static_cast<TaskState::Kind>(kind - std::begin(kStates));
    out.attempts = json.at("attempts");
    out.code = json.at("exit_code");
    out.wall_s = json.at("wall_s");
    out.cpu_s = json.at("cpu_s");
    out.peak_bytes = json.at("peak_bytes");
    out.host = json.at("host");
    out.sum = json.at("sum");
    out.sizes = json.value("bytes", std::vector<int64_t>());
  } catch (const Json::exception&) {
    return {};
  }
  if (out.sum != taskSum(task)) return {};
  return out;
}

std::optional<std::vector<int64_t>> sizesOf(const BatchPlan& plan, const BatchTask& task) {
  std::vector<int64_t> out;
  for (const std::string& file : task.makes) {
    std::error_code missing;
    const fs::path path = fs::path(plan.workingFolder) / file;
    const bool isFolder = fs::is_directory(path, missing);
    out.push_back(isFolder ? 0 : static_cast<int64_t>(fs::file_size(path, missing)));
    if (missing) return std::nullopt;
  }
  return out;
}

std::vector<TaskState> statesOf(const BatchPlan& plan) {
  std::map<std::string, bool> stillNeeded;
  std::vector<TaskState> out(plan.tasks.size());
  for (size_t i = plan.tasks.size(); i-- > 0;) {
    const BatchTask& task = plan.tasks[i];
    const auto needed = stillNeeded.find(task.name);
    out[i] = readState(plan, task);
    // One picture of a frame is joined after the other, and each must be there.
    const bool isBetween = needed != stillNeeded.end() && !isJoin(task);
    if (isBetween && !needed->second)
      out[i].kind = TaskState::Done;
    else if (out[i].kind == TaskState::Done) {
      const auto sizes = sizesOf(plan, task);
      const bool isWhole = sizes && (!isBetween || *sizes == out[i].sizes);
      if (!isWhole) out[i].kind = TaskState::Waiting;
    }
    for (const std::string& n : task.needs) stillNeeded[n] |= out[i].kind != TaskState::Done;
  }
  // The last join of a frame removes the tiles that the others need.
  std::set<int> joining;
  for (size_t i = 0; i < out.size(); ++i)
    if (isJoin(plan.tasks[i]) && out[i].kind != TaskState::Done) joining.insert(plan.tasks[i].frame);
  for (size_t i = 0; i < out.size(); ++i)
    if (isJoin(plan.tasks[i]) && !plan.tasks[i].removes.empty() && joining.contains(plan.tasks[i].frame) &&
        out[i].kind == TaskState::Done)
      out[i].kind = TaskState::Waiting;
  return out;
}

void writeState(const BatchPlan& plan, const BatchTask& task, const TaskState& state) {
  const Json json{{"state", kStates[state.kind]}, {"attempts", state.attempts}, {"exit_code", state.code},
                  {"wall_s", state.wall_s},       {"cpu_s", state.cpu_s},       {"peak_bytes", state.peak_bytes},
                  {"host", state.host},           {"sum", taskSum(task)},       {"bytes", state.sizes}};
  std::string why;
  if (!writeFile(plan.stateOf(task).string(), json.dump(1) + "\n", why))
    throw WriteError(fmt::format("\"{}\" could not be written: {}", plan.stateOf(task).string(), why));
}

std::string lastLines(const fs::path& log, size_t lines) {
  std::ifstream in(log);
  std::deque<std::string> kept;
  for (std::string line; std::getline(in, line);) {
    kept.push_back(line);
    if (kept.size() > lines) kept.pop_front();
  }
  std::string out;
  for (const std::string& line : kept) out += "    " + line + "\n";
  return out;
}

}  // namespace tomales
