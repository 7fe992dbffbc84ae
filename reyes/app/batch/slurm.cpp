#include "reyes/app/batch/slurm.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "reyes/app/batch/task.h"
#include "reyes/base/child_process.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostOfArray = 1000;  ///< Slurm's MaxArraySize is 1001 unless it is set.

/// Returns the program's path, or nothing if PATH has none.
std::optional<std::string> found(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = folder + "/" + program; ::access(file.c_str(), X_OK) == 0) return file;
  return std::nullopt;
}

/// Runs a program of Slurm. Returns what it prints, errors included.
std::string outputOf(const std::vector<std::string>& command, int& code) {
  const auto program = found(command.front());
  if (!program)
    throw FileError("there is no \"" + command.front() +
                    "\" here: --engine slurm needs Slurm's programs (Debian: slurm-client), --engine local does not");
  int ends[2], problem = 0;
  if (::pipe2(ends, O_CLOEXEC) != 0) throw FileError("no pipe can be made");
  const pid_t child = startChild({*program, command, {{ends[1], 1}, {ends[1], 2}}}, problem);
  ::close(ends[1]);
  std::string out;
  char part[4096];
  for (ssize_t n = 0; child > 0 && (n = ::read(ends[0], part, sizeof(part))) != 0;)
    if (n > 0) out.append(part, static_cast<size_t>(n));
  ::close(ends[0]);
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) throw FileError("\"" + *program + "\" cannot be run");
  code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  while (!out.empty() && out.back() == '\n') out.pop_back();
  return out;
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

fs::path jobsFile(const BatchPlan& plan) { return plan.folder() / "jobs"; }

std::vector<std::string> jobsOf(const BatchPlan& plan) {
  std::ifstream in(jobsFile(plan));
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

/// Tasks that are submitted as one array of jobs.
struct JobArray {
  std::string name;
  std::vector<const BatchTask*> tasks;
  std::vector<std::string> needs;     ///< Names of tasks that all of them need.
  const JobArray* follows = nullptr;  ///< Each task needs the one of the same number there, and nothing else.
  std::string job;                    ///< Slurm's number, once it is submitted.
};

using Arrays = std::vector<std::unique_ptr<JobArray>>;

bool follows(const std::vector<const BatchTask*>& tasks, const JobArray& other) {
  return tasks.size() == other.tasks.size() &&
         std::equal(tasks.begin(), tasks.end(), other.tasks.begin(),
                    [](const BatchTask* t, const BatchTask* o) { return t->needs == std::vector{o->name}; });
}

/// Puts tasks of one stage together that need the same tasks, or each its own one of the same array.
Arrays arraysOf(const BatchPlan& plan, const std::vector<bool>& wanted) {
  std::vector<std::string> stages;
  std::map<std::string, std::vector<const BatchTask*>> byStage;
  for (size_t i = 0; i < plan.tasks.size(); ++i) {
    if (!wanted[i]) continue;
    auto& of = byStage[plan.tasks[i].stage];
    if (of.empty()) stages.push_back(plan.tasks[i].stage);
    of.push_back(&plan.tasks[i]);
  }
  Arrays out;
  const auto add = [&](const std::string& stage, std::vector<const BatchTask*> tasks, const JobArray* leader) {
    for (size_t first = 0; first < tasks.size(); first += kMostOfArray) {
      const size_t count = std::min(kMostOfArray, tasks.size() - first);
      const auto begin = tasks.begin() + static_cast<ptrdiff_t>(first);
      out.push_back(std::make_unique<JobArray>(JobArray{fmt::format("{:04}.{}", out.size(), stage),
                                                        {begin, begin + static_cast<ptrdiff_t>(count)},
                                                        leader ? std::vector<std::string>() : tasks.front()->needs,
                                                        leader,
                                                        {}}));
    }
  };
  for (const std::string& stage : stages) {
    const auto& tasks = byStage[stage];
    const auto leader = std::find_if(out.begin(), out.end(), [&](const auto& a) { return follows(tasks, *a); });
    if (leader != out.end()) {
      add(stage, tasks, leader->get());
      continue;
    }
    std::map<std::vector<std::string>, std::vector<const BatchTask*>> byNeeds;
    for (const BatchTask* task : tasks) byNeeds[task->needs].push_back(task);
    for (const auto& [needs, some] : byNeeds) add(stage, some, nullptr);
  }
  return out;
}

std::string scriptOf(const BatchPlan& plan, const JobArray& array, const SlurmOptions& options) {
  std::string out = fmt::format(
      "#!/bin/bash\n# Tasks of {} for Slurm. A task ends with exit code 75 when it shall begin again.\n"
      "#SBATCH --job-name={}\n#SBATCH --array=0-{}{}\n#SBATCH --ntasks=1 --cpus-per-task={}\n"
      "#SBATCH --requeue --open-mode=append --signal=B:TERM@60\n#SBATCH --output={}\n",
      plan.file.string(), array.name, array.tasks.size() - 1,
      options.atOnce > 0 ? fmt::format("%{}", options.atOnce) : "", options.cpus,
      quoted((plan.folder() / "slurm" / (array.name + ".log")).string()));
  for (const auto& [option, value] :
       {std::pair{"partition", options.partition}, {"time", options.time}, {"mem", options.memory}})
    if (!value.empty()) out += fmt::format("#SBATCH --{}={}\n", option, value);
  out += "tasks=(";
  for (const BatchTask* t : array.tasks) out += (t == array.tasks.front() ? "" : " ") + t->name;
  return out + fmt::format(R"()
trap 'kill -TERM $child' TERM  # comes a minute before the end of the time
{} batch task {} "${{tasks[$SLURM_ARRAY_TASK_ID]}}" &
child=$!
wait $child; code=$?
while kill -0 $child 2>/dev/null; do wait $child; code=$?; done  # the trap has ended the first wait
if [ $code -gt 128 ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt {} ]; then code={}; fi  # it was killed: once more
exit $code
)",
                           quoted(fs::read_symlink("/proc/self/exe").string()), quoted(plan.file.string()),
                           kMostAttempts, kRequeue);
}

/// What sbatch shall wait for; empty for nothing.
std::string dependencyOf(const JobArray& array, const Arrays& all) {
  if (array.follows) return "aftercorr:" + array.follows->job;
  std::string out;
  for (const auto& other : all) {
    std::vector<std::string> jobs;
    for (size_t i = 0; i < other->tasks.size(); ++i)
      if (std::find(array.needs.begin(), array.needs.end(), other->tasks[i]->name) != array.needs.end())
        jobs.push_back(fmt::format("{}_{}", other->job, i));
    if (!jobs.empty() && other->job.empty())
      throw FileError(fmt::format("tasks of one stage wait for each other (\"{}\"): give them stages of their own",
                                  array.tasks.front()->name));
    if (jobs.size() == other->tasks.size()) jobs = {other->job};
    for (const std::string& job : jobs) out += (out.empty() ? "afterok:" : ":") + job;
  }
  return out;
}

/// Tasks that are not done, and those before them: these end at once if what they make is there.
std::vector<bool> wantedOf(const BatchPlan& plan) {
  const std::vector<TaskState> states = statesOf(plan);
  std::map<int, bool> frames;
  for (size_t i = 0; i < states.size(); ++i) frames[plan.tasks[i].frame] |= states[i].kind != TaskState::Done;
  std::vector<bool> out;
  for (const BatchTask& t : plan.tasks) out.push_back(frames[t.frame]);
  return out;
}

}  // namespace

bool hasJobs(const BatchPlan& plan) {
  const std::vector<std::string> jobs = jobsOf(plan);
  if (jobs.empty()) return false;
  int code = 0;
  const std::string lines = outputOf({"squeue", "-h", "-o", "%A", "-j", fmt::format("{}", fmt::join(jobs, ","))}, code);
  return code == 0 && !lines.empty();
}

void checkSlurm(const BatchPlan& plan, const SlurmOptions& options) {
  int code = 0;
  const std::string partitions = outputOf({"sinfo", "-h", "-o", "%R"}, code);
  if (code != 0) throw FileError("Slurm does not answer: " + partitions);
  std::istringstream lines(partitions);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) names.push_back(line);
  if (!options.partition.empty() && std::find(names.begin(), names.end(), options.partition) == names.end())
    throw FileError(fmt::format("Slurm has no partition \"{}\"; it has {}", options.partition, fmt::join(names, ", ")));
  if (hasJobs(plan))
    throw FileError(fmt::format("the plan \"{}\" is on the cluster already: see tomales batch status, or cancel it",
                                plan.file.string()));
}

size_t submitToSlurm(const BatchPlan& plan, const SlurmOptions& options) {
  std::error_code problem;
  fs::create_directories(plan.folder() / "slurm", problem);
  const Arrays arrays = arraysOf(plan, wantedOf(plan));
  std::vector<std::string> jobs;
  const auto takeBack = [&](const std::string& why) {
    int code = 0;
    std::vector<std::string> cancel{"scancel"};
    cancel.insert(cancel.end(), jobs.begin(), jobs.end());
    if (!jobs.empty()) outputOf(cancel, code);
    throw FileError(why + "; nothing is on the cluster");
  };
  size_t tasks = 0;
  for (const auto& array : arrays) {
    const std::string script = (plan.folder() / "slurm" / (array->name + ".sh")).string();
    std::string why;
    if (!writeFile(script, scriptOf(plan, *array, options), why))
      takeBack(fmt::format("\"{}\" could not be written: {}", script, why));
    std::vector<std::string> command{"sbatch", "--parsable", "--chdir=" + plan.workingFolder};
    const std::string after = dependencyOf(*array, arrays);
    if (!after.empty()) {
      command.push_back("--dependency=" + after);
      command.push_back("--kill-on-invalid-dep=yes");
    }
    command.push_back(script);
    int code = 0;
    const std::string said = outputOf(command, code);
    if (code != 0) takeBack("Slurm refuses \"" + script + "\": " + said);
    array->job = said.substr(0, said.find(';'));
    jobs.push_back(array->job);
    tasks += array->tasks.size();
  }
  std::string why;
  if (!writeFile(jobsFile(plan).string(), fmt::format("{}\n", fmt::join(jobs, "\n")), why))
    takeBack(fmt::format("\"{}\" could not be written: {}", jobsFile(plan).string(), why));
  return tasks;
}

void cancelJobs(const BatchPlan& plan) {
  int code = 0;
  std::vector<std::string> command{"scancel"};
  for (const std::string& job : jobsOf(plan)) command.push_back(job);
  const std::string said = outputOf(command, code);
  if (code != 0) throw FileError("Slurm does not cancel the jobs: " + said);
}

}  // namespace tomales
