#include "reyes/app/batch/batch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "reyes/app/batch/local.h"
#include "reyes/app/batch/owner.h"
#include "reyes/app/batch/report.h"
#include "reyes/app/batch/task.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/parallel.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlanName = "plan.json";

/// A plan is given by its file or its folder.
fs::path planFile(const std::string& given) {
  std::error_code none;
  return fs::is_directory(given, none) ? fs::path(given) / kPlanName : fs::path(given);
}

/// Reports how many frames are finished, a few times a second, because counting takes time. Farms get the share in
/// lines that they read; a terminal gets a sentence.
class ProgressLines {
 public:
  explicit ProgressLines(const BatchPlan& plan) : plan_(plan) {}
  void tell(const std::vector<TaskState>& states, bool isLast) {
    constexpr std::chrono::milliseconds kPause{300};
    const auto now = std::chrono::steady_clock::now();
    if (!isLast && now - told_ < kPause) return;
    told_ = now;
    const BatchReport report = reportOf(plan_, states);
    const size_t finished = report.finished.size();
    const std::string line = terminal_
                                 ? fmt::format("{} of {} frames are finished", finished, report.frames())
                                 : fmt::format("R90000 {:>4}%", 100 * finished / std::max<size_t>(1, report.frames()));
    if (line == shown_) return;
    shown_ = line;
    std::puts(line.c_str());
    std::fflush(stdout);
  }

 private:
  const BatchPlan& plan_;
  const bool terminal_ = isatty(STDOUT_FILENO) == 1;
  std::string shown_;
  std::chrono::steady_clock::time_point told_{};
};

class BatchRun {
 public:
  explicit BatchRun(BatchCommand& command) : command_(command) {}

  int run() {
    guarded(log_, [this] { code_ = act(); });
    const int interrupt = interruptExitCode();
    return interrupt ? interrupt : std::max<int>(code_, exitCodeOf(log_));
  }

 private:
  using Action = int (BatchRun::*)(const BatchPlan&);

  int act() {
    static constexpr std::pair<const char*, Action> kActions[] = {{"status", &BatchRun::status},
                                                                  {"cancel", &BatchRun::cancel},
                                                                  {"retry", &BatchRun::submit},
                                                                  {"log", &BatchRun::showLog},
                                                                  {"task", &BatchRun::task}};
    const std::vector<std::string>& what = command_.what;
    for (const auto& [name, action] : kActions)
      if (what.front() == name) {
        if (what.size() < 2) throw FileError(fmt::format("batch {} needs a plan: its file or its folder", name));
        return (this->*action)(readPlan(planFile(what[1])));
      }
    if (what.size() == 1 && (what.front().ends_with(".json") || fs::is_directory(what.front())))
      return submit(readPlan(planFile(what.front())));
    const auto plan = planned();
    if (plan && command_.planOnly)
      std::puts(fmt::format("{} tasks are in \"{}\"", plan->tasks.size(), plan->file.string()).c_str());
    return plan && !command_.planOnly ? submit(*plan) : exitCodeOf(log_);
  }

  /// Makes the plan. An existing plan is kept if it is the same, and otherwise refused, because it may be running.
  std::optional<BatchPlan> planned() {
    if (command_.folder.empty()) command_.folder = fs::path(command_.what.front()).stem().string() + ".batch";
    command_.plan.file = fs::path(command_.folder) / kPlanName;
    command_.plan.render.input.files = command_.what;
    auto plan = makePlan(command_.plan, log_);
    if (!plan) return std::nullopt;
    if (command_.plan.tileCount() > 1 && !command_.onSlurm && static_cast<int>(plan->pictures.size()) >= processes())
      log_.report(
          Severity::Note, "batch-tiles-cost", {},
          fmt::format(
              "--tiles: {} frames keep {} tasks at a time busy without tiles, and frames in tiles take more CPU time",
              plan->pictures.size(), processes()));
    if (command_.onSlurm) {
      checkSlurm(command_.slurm);
      refuseIfOnCluster(*plan);
    }
    if (!fs::exists(plan->file)) {
      writePlan(*plan);
      return plan;
    }
    if (planText(readPlan(plan->file)) != planText(*plan))
      throw FileError(
          fmt::format("\"{}\" is another plan: go on with it by tomales batch {}, or give a new one a folder "
                      "by --plan",
                      plan->file.string(), command_.folder));
    return plan;
  }

  int submit(const BatchPlan& plan) {
    PlanOwner owner(plan);
    makeFolders(plan);
    refuseIfOnCluster(plan);
    if (command_.onSlurm) {
      checkSlurm(command_.slurm);
      std::puts(fmt::format("{} tasks are on the cluster; tomales batch status {}", submitToSlurm(plan, command_.slurm),
                            plan.folder().string())
                    .c_str());
      return kDone;
    }
    const OrderlyEnd orderly;
    ProgressLines lines(plan);
    const auto states = runLocally(plan, processes(), [&](const std::vector<TaskState>& now) {
      owner.renew();
      lines.tell(now, false);
    });
    lines.tell(states, true);
    return show(plan, states);
  }

  /// Returns the greatest number of tasks at a time on this machine.
  int processes() const { return command_.processes > 0 ? command_.processes : threadCount(); }

  /// Prints the report. Returns the exit code, which is that of missing output if tasks have failed.
  int show(const BatchPlan& plan, const std::vector<TaskState>& states) {
    const BatchReport report = reportOf(plan, states);
    std::fputs((command_.json ? jsonOf(plan, states) + "\n" : textOf(plan, report)).c_str(), stdout);
    std::string why;
    if (!command_.page.empty() && !writeFile(command_.page, pageOf(plan, states), why))
      throw WriteError(fmt::format("\"{}\" could not be written: {}", command_.page, why));
    if (!report.failures.empty())
      log_.report(
          Severity::Output, "batch-failed", {},
          fmt::format("{} of {} frames have failed, each tried {} times{}; tomales batch retry {} tries again",
                      report.failed.size(), report.frames(), kMostAttempts,
                      report.blocked.empty() ? "" : fmt::format(", and {} wait for them", report.blocked.size()),
                      plan.folder().string()));
    return kDone;
  }

  int status(const BatchPlan& plan) { return show(plan, statesOf(plan)); }

  int cancel(const BatchPlan& plan) {
    if (hasJobs(plan)) {
      cancelJobs(plan);
      return kDone;
    }
    if (!PlanOwner::endOther(plan))
      throw FileError(fmt::format("nothing works on the plan \"{}\" here", plan.file.string()));
    return kDone;
  }

  int showLog(const BatchPlan& plan) {
    if (command_.what.size() < 3) throw FileError("batch log needs the number of a frame");
    bool any = false;
    for (const BatchTask& t : plan.tasks) {
      if (std::to_string(t.frame) != command_.what[2]) continue;
      any = true;
      std::puts(fmt::format("{}:\n{}", t.name, lastLines(plan.logOf(t), 1000)).c_str());
    }
    if (!any) throw FileError(fmt::format("the plan has no frame {}", command_.what[2]));
    return kDone;
  }

  int task(const BatchPlan& plan) {
    if (command_.what.size() < 3) throw FileError("batch task needs the name of a task");
    return runTask(plan, command_.what[2]);
  }

  BatchCommand& command_;
  Log log_;
  int code_ = kDone;
};

}  // namespace

int batchCommand(BatchCommand command) { return BatchRun(command).run(); }

}  // namespace tomales
