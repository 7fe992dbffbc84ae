#include "reyes/app/batch/job_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "reyes/base/chunk_file.h"

namespace tomales {
namespace {

constexpr size_t kMostOfArray = 1000;  ///< Slurm's MaxArraySize is 1001 unless it is set.

/// Returns the needs that all tasks have.
std::vector<std::string> commonNeeds(const std::vector<const BatchTask*>& tasks) {
  std::map<std::string, size_t> counts;
  for (const BatchTask* t : tasks)
    for (const std::string& n : t->needs) ++counts[n];
  std::vector<std::string> out = tasks.front()->needs;
  std::erase_if(out, [&](const std::string& n) { return counts[n] < tasks.size(); });
  return out;
}

/// Returns the arrays such that task i of these needs task i of each array, besides common needs. Returns nothing if
/// the needs are not of this form.
std::optional<std::vector<const JobArray*>> leadersOf(const std::vector<const BatchTask*>& tasks,
                                                      const JobArrays& arrays) {
  const std::vector<std::string> common = commonNeeds(tasks);
  const auto ownNeeds = [&](const BatchTask* t) {
    std::vector<std::string> out = t->needs;
    std::erase_if(out,
                  [&](const std::string& n) { return std::find(common.begin(), common.end(), n) != common.end(); });
    return out;
  };
  std::vector<const JobArray*> out;
  for (const std::string& first : ownNeeds(tasks.front())) {
    const auto leader = std::find_if(arrays.begin(), arrays.end(), [&](const auto& a) {
      return a->tasks.size() == tasks.size() && a->tasks.front()->name == first;
    });
    if (leader == arrays.end()) return std::nullopt;
    out.push_back(leader->get());
  }
  for (size_t i = 0; i < tasks.size(); ++i) {
    const std::vector<std::string> own = ownNeeds(tasks[i]);
    const bool follows = std::equal(own.begin(), own.end(), out.begin(), out.end(),
                                    [&](const std::string& n, const JobArray* a) { return a->tasks[i]->name == n; });
    if (!follows) return std::nullopt;
  }
  return out;
}

/// Divides tasks into parts that are no larger than an array may be.
std::vector<std::vector<const BatchTask*>> inParts(const std::vector<const BatchTask*>& tasks) {
  std::vector<std::vector<const BatchTask*>> out;
  for (size_t i = 0; i < tasks.size(); ++i) {
    if (i % kMostOfArray == 0) out.emplace_back();
    out.back().push_back(tasks[i]);
  }
  return out;
}

}  // namespace

JobArrays jobArraysOf(const std::vector<BatchTask>& wanted) {
  std::vector<std::string> stages;  // tasks that can begin at once are separate from waiting ones of the same stage
  std::map<std::string, std::vector<const BatchTask*>> byStage;
  for (const BatchTask& t : wanted) {
    const std::string stage = t.needs.empty() ? t.stage : t.stage + ".later";
    if (byStage[stage].empty()) stages.push_back(stage);
    byStage[stage].push_back(&t);
  }
  JobArrays out;
  const auto add = [&](const std::string& stage, const std::vector<const BatchTask*>& tasks,
                       const std::vector<const JobArray*>& leaders) {
    out.push_back(std::make_unique<JobArray>(
        JobArray{fmt::format("{:04}.{}", out.size(), stage), tasks, commonNeeds(tasks), leaders, {}}));
  };
  for (const std::string& stage : stages) {
    const std::vector<std::vector<const BatchTask*>> parts = inParts(byStage[stage]);
    std::vector<std::vector<const JobArray*>> leaders;
    for (const auto& part : parts)
      if (const auto of = leadersOf(part, out)) leaders.push_back(*of);
    for (size_t i = 0; i < parts.size() && leaders.size() == parts.size(); ++i) add(stage, parts[i], leaders[i]);
    if (leaders.size() == parts.size()) continue;
    std::map<std::vector<std::string>, std::vector<const BatchTask*>> byNeeds;
    for (const BatchTask* task : byStage[stage]) byNeeds[task->needs].push_back(task);
    for (const auto& [needs, some] : byNeeds)
      for (const auto& part : inParts(some)) add(stage, part, {});
  }
  return out;
}

std::string dependencyOf(const JobArray& array, const JobArrays& all) {
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
  for (const JobArray* leader : array.follows)
    out += (leader != array.follows.front() ? ":" : out.empty() ? "aftercorr:" : ",aftercorr:") + leader->job;
  return out;
}

}  // namespace tomales
