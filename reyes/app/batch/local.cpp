#include "reyes/app/batch/local.h"

#include <sys/wait.h>

#include <list>
#include <map>
#include <thread>

#include "reyes/app/batch/task.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPoll{3};
constexpr std::chrono::seconds kRetryAfter{1}, kTell{10};

/// The tasks that are neither done nor given up, in the plan's order.
class LocalRun {
 public:
  LocalRun(const BatchPlan& plan, int processes) : plan_(plan), processes_(processes), states_(statesOf(plan)) {
    for (size_t i = 0; i < states_.size(); ++i) {
      index_[plan.tasks[i].name] = i;
      if (states_[i].kind != TaskState::Done) {
        states_[i] = {};
        open_.push_back(i);
      }
    }
  }

  bool finished() const { return running_.empty() && (stopRequested() || !hasNext()); }
  void startSome() {
    while (!stopRequested() && static_cast<int>(running_.size()) < processes_) {
      const auto next = std::find_if(open_.begin(), open_.end(), [&](size_t i) { return mayStart(i); });
      if (next == open_.end()) return;
      const size_t i = *next;
      open_.erase(next);
      running_.emplace_back(i, std::make_unique<RunningTask>(plan_, plan_.tasks[i], states_[i].attempts + 1));
      states_[i] = running_.back().second->state();
    }
  }
  /// Returns true if some task has ended.
  bool collect() {
    bool any = false;
    for (auto it = running_.begin(); it != running_.end();) {
      auto& [i, task] = *it;
      if (stopRequested()) task->stop();
      if (!task->ended()) {
        ++it;
        continue;
      }
      states_[i] = task->state();
      any = true;
      if (states_[i].kind == TaskState::Failed && states_[i].attempts < kMostAttempts) {
        notBefore_[i] = Clock::now() + kRetryAfter;
        open_.push_back(i);
      }
      it = running_.erase(it);
    }
    reapOrphans();
    return any;
  }
  const std::vector<TaskState>& states() const { return states_; }

 private:
  /// Ends the zombies of processes that tasks have left running. These become children of this process when their task
  /// ends (openNursery()).
  void reapOrphans() const {
    const auto isTask = [&](pid_t child) {
      return std::ranges::any_of(running_, [&](const auto& r) { return r.second->child() == child; });
    };
    for (siginfo_t info{}; ::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0; info = {}) {
      if (info.si_pid == 0 || isTask(info.si_pid)) return;
      ::waitpid(info.si_pid, nullptr, 0);
    }
  }
  bool isReady(size_t i) const {
    const auto& needs = plan_.tasks[i].needs;
    return std::all_of(needs.begin(), needs.end(),
                       [&](const std::string& n) { return states_[index_.at(n)].kind == TaskState::Done; });
  }
  bool mayStart(size_t i) const {
    const auto wait = notBefore_.find(i);
    return isReady(i) && (wait == notBefore_.end() || wait->second <= Clock::now());
  }
  bool hasNext() const {
    return std::any_of(open_.begin(), open_.end(), [&](size_t i) { return isReady(i); });
  }

  const BatchPlan& plan_;
  const int processes_;
  std::vector<TaskState> states_;
  std::map<std::string, size_t> index_;
  std::list<size_t> open_;
  std::map<size_t, Clock::time_point> notBefore_;
  std::list<std::pair<size_t, std::unique_ptr<RunningTask>>> running_;
};

}  // namespace

std::vector<TaskState> runLocally(const BatchPlan& plan, int processes,
                                  const std::function<void(const std::vector<TaskState>&)>& changed) {
  std::filesystem::current_path(plan.workingFolder);
  LocalRun run(plan, processes);
  for (auto told = Clock::now(); !run.finished();) {
    run.startSome();
    if (run.collect() || Clock::now() - told >= kTell) {
      changed(run.states());
      told = Clock::now();
    } else {
      std::this_thread::sleep_for(kPoll);
    }
  }
  return run.states();
}

}  // namespace tomales
