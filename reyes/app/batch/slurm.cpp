#include "reyes/app/batch/slurm.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "reyes/app/batch/job_arrays.h"
#include "reyes/app/batch/task.h"
#include "reyes/base/child_process.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

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
  if (::pipe2(ends, O_CLOEXEC) != 0) throw FileError("a pipe cannot be made");
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

/// Returns a plan of these tasks alone, because the plan of a long animation has many megabytes, which each task would
/// read.
BatchPlan partOfPlan(const BatchPlan& plan, const JobArray& array) {
  BatchPlan out{plan.folder() / (array.name + ".json"), plan.workingFolder, {}, {}};
  for (const BatchTask* t : array.tasks) {
    out.tasks.push_back(*t);
    out.tasks.back().needs.clear();
  }
  return out;
}

std::string scriptOf(const BatchPlan& plan, const JobArray& array, const SlurmOptions& options) {
  std::string out = fmt::format(
      "#!/bin/bash\n# Tasks of {} for Slurm. A task ends with exit code 75 if it is to begin again.\n"
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
                           quoted(fs::read_symlink("/proc/self/exe").string()),
                           quoted(partOfPlan(plan, array).file.string()), kMostAttempts, kRequeue);
}

/// Returns the tasks that are not done, without their needs that are done.
std::vector<BatchTask> wantedOf(const BatchPlan& plan) {
  const std::vector<TaskState> states = statesOf(plan);
  std::set<std::string> done;
  std::vector<BatchTask> out;
  for (size_t i = 0; i < states.size(); ++i) {
    if (states[i].kind == TaskState::Done)
      done.insert(plan.tasks[i].name);
    else
      out.push_back(plan.tasks[i]);
  }
  for (BatchTask& t : out) std::erase_if(t.needs, [&](const std::string& n) { return done.contains(n); });
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

void checkSlurm(const SlurmOptions& options) {
  int code = 0;
  const std::string partitions = outputOf({"sinfo", "-h", "-o", "%R"}, code);
  if (code != 0) throw FileError("Slurm does not answer: " + partitions);
  std::istringstream lines(partitions);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);) names.push_back(line);
  if (!options.partition.empty() && std::find(names.begin(), names.end(), options.partition) == names.end())
    throw FileError(fmt::format("Slurm has no partition \"{}\"; it has {}", options.partition, fmt::join(names, ", ")));
}

void refuseIfOnCluster(const BatchPlan& plan) {
  if (!jobsOf(plan).empty() && !found("squeue"))
    throw FileError(
        fmt::format("the plan was given to a cluster, and there is no \"squeue\" here to ask whether that is "
                    "over; if it is, remove \"{}\"",
                    jobsFile(plan).string()));
  if (hasJobs(plan))
    throw FileError(fmt::format("the plan \"{}\" is on the cluster already: see tomales batch status, or cancel it",
                                plan.file.string()));
}

size_t submitToSlurm(const BatchPlan& plan, const SlurmOptions& options) {
  std::error_code problem;
  fs::create_directories(plan.folder() / "slurm", problem);
  const std::vector<BatchTask> wanted = wantedOf(plan);
  const JobArrays arrays = jobArraysOf(wanted);
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
    writePlan(partOfPlan(plan, *array));
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
