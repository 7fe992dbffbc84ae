#include "reyes/app/frame/granted.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <cstring>

namespace tomales {
namespace {

/// The rest of the granted memory is for data that --memory-limit does not bound.
constexpr double kShareOfMemory = 0.8;
constexpr int64_t kMegabyte = 1 << 20;

/// Returns 0 where the variable is not a positive number.
int64_t numberOf(const char* variable) {
  const char* text = std::getenv(variable);
  int64_t out = 0;
  if (text) std::from_chars(text, text + std::strlen(text), out);
  return std::max<int64_t>(0, out);
}

int64_t grantedThreads() {
  const int64_t ofTask = numberOf("SLURM_CPUS_PER_TASK");
  return ofTask > 0 ? ofTask : numberOf("SLURM_CPUS_ON_NODE");
}

int64_t grantedBytes() {
  const int64_t ofNode = numberOf("SLURM_MEM_PER_NODE");
  return kMegabyte * (ofNode > 0 ? ofNode : numberOf("SLURM_MEM_PER_CPU") * grantedThreads());
}

}  // namespace

RenderSettings asGranted(RenderSettings settings, Log& log) {
  if (!std::getenv("SLURM_JOB_ID")) return settings;
  std::string said;
  if (const int64_t threads = grantedThreads(); settings.resources.threads == 0 && threads > 0) {
    settings.resources.threads = static_cast<int>(std::min<int64_t>(threads, 4096));
    said = fmt::format("-t {}", settings.resources.threads);
  }
  if (const int64_t bytes = grantedBytes(); !settings.resources.memoryLimit && bytes > 0) {
    settings.resources.memoryLimit = static_cast<int64_t>(kShareOfMemory * static_cast<double>(bytes));
    settings.resources.memoryIsGranted = true;
    said +=
        fmt::format("{}--memory-limit {}M", said.empty() ? "" : " and ", *settings.resources.memoryLimit / kMegabyte);
  }
  if (!said.empty()) log.report(Severity::Info, "slurm-grant", {}, "the resources that Slurm has granted set " + said);
  return settings;
}

}  // namespace tomales
