#include "reyes/app/chart/lab.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "reyes/app/exit_code.h"
#include "reyes/app/watch/cpu_time.h"
#include "reyes/base/checksum.h"
#include "reyes/base/child_process.h"
#include "reyes/base/stop.h"
#include "reyes/base/temporary_folder.h"
#include "reyes/base/unfinished_file.h"
#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr const char* kSelf = "/proc/self/exe";

std::string readAll(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

uint64_t sumOf(const std::string& text) { return checksum(std::as_bytes(std::span(text))); }

/// Returns the texts between quotation marks.
std::vector<std::string> stringsIn(const std::string& text) {
  std::vector<std::string> out;
  for (size_t begin = text.find('"'); begin != std::string::npos;) {
    const size_t end = text.find('"', begin + 1);
    if (end == std::string::npos) break;
    out.push_back(text.substr(begin + 1, end - begin - 1));
    begin = text.find('"', end + 1);
  }
  return out;
}

/// Adds each file once, and the files that it names.
void addContents(const fs::path& path, std::set<fs::path>& seen, std::string& sums) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || !seen.insert(fs::weakly_canonical(path, error)).second) return;
  const std::string text = readAll(path.string());
  sums += fmt::format("{:016x}", sumOf(text));
  if (path.extension() != ".rib") return;
  for (const std::string& name : stringsIn(text)) {
    if (name.empty() || name.size() > 1024) continue;
    addContents(name, seen, sums);
    addContents(path.parent_path() / name, seen, sums);
  }
}

/// Returns the first error of the renderer's messages, or else their first line.
std::string complaint(const std::string& messages) {
  const size_t error = std::min(messages.find(": error: "), messages.find(": output error: ")),
               before = error == std::string::npos ? error : messages.rfind('\n', error);
  const size_t begin = before == std::string::npos ? 0 : before + 1;
  return messages.substr(begin, messages.find('\n', begin) - begin);
}

struct Ended {
  bool good = false;
  std::string why;
  double cpu_s = 0, wall_s = 0;
};

pid_t start(const std::vector<std::string>& arguments, const std::string& messages) {
  const int file = open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return -1;
  int problem = 0;
  const pid_t child = startChild({kSelf, arguments, {{file, STDOUT_FILENO}, {file, STDERR_FILENO}}}, problem);
  close(file);
  return child;
}

/// Ends the child when this process is interrupted or at the deadline.
Ended await(pid_t child, Clock::time_point deadline) {
  Ended out;
  std::optional<ChildGuard> guard(child);
  const auto begin = Clock::now();
  rusage usage{};
  int status = 0;
  const auto hasEnded = [child] {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == child;
  };
  while (!hasEnded()) {
    if (out.why.empty() && (stopRequested() || Clock::now() > deadline)) {
      out.why = stopRequested() ? "interrupted" : "over the budget";
      kill(-child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  guard.reset();
  wait4(child, &status, 0, &usage);
  out.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  out.cpu_s = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
  out.good = WIFEXITED(status) && succeeded(WEXITSTATUS(status));
  if (!out.good && out.why.empty()) out.why = "the renderer failed";
  return out;
}

}  // namespace

std::string placesProblem(const std::string& page, const std::string& folder) {
  std::error_code error;
  const auto isWritable = [&error](const fs::path& path) {
    return fs::is_directory(path, error) && access(path.c_str(), W_OK) == 0;
  };
  const fs::path beside = fs::path(page).parent_path();
  if (!isWritable(beside.empty() ? "." : beside))
    return "\"" + page + "\" cannot be written: its folder is missing, or you may not write to it";
  fs::create_directories(folder, error);
  return isWritable(folder) ? ""
                            : "\"" + folder + "\" cannot hold measurements: it is no folder that can be written to";
}

uint64_t contentsOf(const std::vector<std::string>& files) {
  std::set<fs::path> seen;
  std::string sums;
  for (const std::string& file : files) addContents(file, seen, sums);
  return sumOf(sums);
}

Lab::Lab(LabSettings settings)
    : settings_(std::move(settings)),
      contents_(contentsOf(settings_.scene) ^ sumOf(readAll(kSelf))),
      start_(Clock::now()) {
  std::error_code error;
  fs::create_directories(settings_.folder, error);  // placesProblem() reports a failure
}

double Lab::secondsUsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
double Lab::secondsLeft() const { return settings_.budget_s - secondsUsed(); }

std::optional<Run> Lab::run(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = settings_.arguments;
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::string name = fmt::format("{:016x}", contents_);
  for (const std::string& a : all) name += '\n' + a;
  const std::string stem = (fs::path(settings_.folder) / fmt::format("{:016x}", sumOf(name))).string();
  if (auto known = recall(stem, arguments)) return known;
  why_ = stopRequested() ? "interrupted" : "over the budget";
  if (stopRequested() || secondsLeft() <= 0) return std::nullopt;

  const TemporaryFolder folder(settings_.folder);
  const std::string picture = folder.path() / "picture.exr", statistics = folder.path() / "stats.json",
                    messages = folder.path() / "messages";
  all.insert(all.begin(), {"tomales", "render", "-q"});
  all.insert(all.end(), {"-o", picture, "--one-picture", "--stats", statistics});
  all.insert(all.end(), settings_.scene.begin(), settings_.scene.end());
  const pid_t child = start(all, messages);
  why_ = "the renderer could not be started";
  if (child < 0) return std::nullopt;
  const Ended ended = await(
      child, Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(secondsLeft())));
  why_ = ended.why;
  if (std::string why; !ended.good || !moveFinished(picture, stem + ".exr", why)) {
    if (!stopRequested() && why_ != "over the budget") {
      const std::string said = complaint(readAll(messages));
      why_ += said.empty() ? " and said nothing (is \"" + settings_.folder + "\" on a full disk?)" : ": " + said;
    }
    return std::nullopt;
  }
  const Json counted = Json::parse(readAll(statistics), nullptr, false);
  Run out{arguments, stem + ".exr", ended.cpu_s, ended.wall_s, 0, 0, {}, false};
  if (counted.is_object()) {
    out.peakBytes = counted.value("/memory_bytes/peak_rss"_json_pointer,
                                  0.0);  // wait4() would count this process's memory at the fork
    out.records = counted.value("/irradiance_cache/samples"_json_pointer, int64_t{0});
    for (const Json& w : counted.value("warnings", Json::array()))
      if (w.value("severity", "") != "info") out.warnings.push_back(w.value("code", ""));
  }
  if (remember(stem, out)) return out;
  why_ = "\"" + settings_.folder + "\" cannot be written";
  return std::nullopt;
}

std::optional<Run> Lab::recall(const std::string& stem, const std::vector<std::string>& arguments) const {
  const std::string figures = stem + ".json", picture = stem + ".exr";
  std::error_code none;
  if (!fs::exists(figures, none) || !fs::exists(picture, none)) return std::nullopt;
  std::string problem;
  try {
    const Json j = Json::parse(readAll(figures));
    Run known{.arguments = arguments,
              .picture = picture,
              .cpu_s = j.at("cpu_s"),
              .wall_s = j.at("wall_s"),
              .peakBytes = j.at("peak_bytes"),
              .records = j.at("records"),
              .warnings = j.at("warnings"),
              .recalled = true};
    if (readImage(picture, problem)) return known;
  } catch (const Json::exception& e) {
    problem = e.what();
  }
  fmt::print(stderr, "\"{}\" of earlier measurements is damaged ({}): measured anew\n", stem, problem);
  return std::nullopt;
}

bool Lab::remember(const std::string& stem, const Run& run) const {
  const Json j{{"cpu_s", run.cpu_s},
               {"wall_s", run.wall_s},
               {"peak_bytes", run.peakBytes},
               {"records", run.records},
               {"warnings", run.warnings}};
  std::string why;
  return writeFile(stem + ".json", j.dump(2) + '\n', why);
}

}  // namespace tomales
