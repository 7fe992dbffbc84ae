// Noun: the plan of a batch, which is a graph of tasks in a JSON file (docs/batch.md). Each task runs this program
// once. Threads: plain object.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tomales {

struct BatchTask {
  std::string name;   ///< Names its files beside the plan: letters, digits, - _ and . alone.
  std::string stage;  ///< maps, render, hide, gather, shade000, join ...: an array of jobs has tasks of one stage.
  int frame = 0;
  std::vector<std::string> arguments;  ///< The arguments that this program gets.
  std::vector<std::string> needs;      ///< Names of tasks that come before.
  std::vector<std::string> makes;      ///< Files that exist when the task is finished, until a task `removes` them.
  std::vector<std::string> removes;    ///< Files that nobody needs after the task.
};

struct BatchPlan {
  std::filesystem::path file;         ///< The plan itself; its folder has states and logs.
  std::string workingFolder;          ///< Relative names start there.
  std::vector<std::string> pictures;  ///< The first picture of each frame, for people.
  std::vector<BatchTask> tasks;       ///< A task stands after those that it needs.

  std::filesystem::path folder() const { return file.parent_path(); }
  std::filesystem::path logOf(const BatchTask& task) const { return folder() / "log" / (task.name + ".log"); }
  /// Returns the path of an intermediate file, which one task of a frame writes for another.
  std::filesystem::path workOf(int frame, const std::string& end) const;
  std::filesystem::path stateOf(const BatchTask& task) const { return folder() / "state" / (task.name + ".json"); }
  /// Returns null if there is none.
  const BatchTask* find(const std::string& name) const;
};

/// Throws FileError if the file is no plan, names a task twice or one that it lacks, has two tasks that make one file,
/// or if tasks wait for each other in a circle. Tasks come in an order in which they can run.
BatchPlan readPlan(const std::filesystem::path& file);
/// Makes the same checks, and puts the tasks in order. Throws FileError.
void checkPlan(BatchPlan& plan);
std::string planText(const BatchPlan& plan);
/// Makes the folders of states, logs and intermediate files beside the plan. Throws WriteError.
void makeFolders(const BatchPlan& plan);
/// Throws WriteError.
void writePlan(const BatchPlan& plan);

/// The known facts about a task: the contents of its file of state.
struct TaskState {
  enum Kind { Waiting, Running, Done, Failed } kind = Waiting;
  int attempts = 0;  ///< Number of runs since the task was last started anew.
  int code = 0;      ///< Exit code, or 128 plus the signal.
  double wall_s = 0, cpu_s = 0;
  int64_t peak_bytes = 0;
  std::string host;
  uint64_t sum = 0;            ///< taskSum() of the task that ran.
  std::vector<int64_t> sizes;  ///< Bytes of the files that it has made.
};
/// Returns the name of a frame's task.
std::string taskName(int frame, const std::string& stage);
uint64_t taskSum(const BatchTask& task);
/// Returns the state of a task. It is Waiting if there is no file of state, or if the task has been edited since.
TaskState readState(const BatchPlan& plan, const BatchTask& task);
/// Returns the bytes of the files that a task makes, or nothing if one of them is not there.
std::optional<std::vector<int64_t>> sizesOf(const BatchPlan& plan, const BatchTask& task);
/// Returns the states of all tasks. A task is done only if what it made is still there, or if all tasks that need it
/// are done. Files that other tasks need must have the size that they were made with.
std::vector<TaskState> statesOf(const BatchPlan& plan);
/// Throws WriteError.
void writeState(const BatchPlan& plan, const BatchTask& task, const TaskState& state);
/// Returns the last lines of a task's log.
std::string lastLines(const std::filesystem::path& log, size_t lines);

}  // namespace tomales
