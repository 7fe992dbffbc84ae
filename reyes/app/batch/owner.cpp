#include "reyes/app/batch/owner.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>

#include "reyes/base/chunk_file.h"
#include "reyes/base/process.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::seconds kRenewal{10}, kDead{60};

struct Owner {
  pid_t process = 0;
  std::string host;
};

fs::path ownerFile(const BatchPlan& plan) { return plan.folder() / "owner"; }

std::optional<Owner> readOwner(const fs::path& file) {
  std::ifstream in(file);
  Owner out;
  return in >> out.process >> out.host ? std::optional(out) : std::nullopt;
}

/// Throws FileError if a process of another machine has written the file a moment ago. Its time and that of a new file
/// are both of the file system's clock.
void refuseOtherHost(const fs::path& file) {
  const auto owner = readOwner(file);
  if (!owner || owner->host == hostName()) return;
  const fs::path probe = file.string() + "." + hostName();
  std::ofstream(probe) << "\n";
  std::error_code none;
  const auto age = fs::last_write_time(probe, none) - fs::last_write_time(file, none);
  fs::remove(probe, none);
  if (age < kDead)
    throw FileError(
        fmt::format("process {} of {} works on the plan \"{}\"; if that machine has died, try again in a minute",
                    owner->process, owner->host, file.parent_path().string()));
}

}  // namespace

PlanOwner::PlanOwner(const BatchPlan& plan)
    : file_(ownerFile(plan)), lock_(plan.folder(), [&] {
        throw FileError(fmt::format("another process works on the plan \"{}\"", plan.file.string()));
      }) {
  refuseOtherHost(file_);
  write();
}

PlanOwner::~PlanOwner() {
  std::error_code none;
  fs::remove(file_, none);
}

void PlanOwner::write() {
  std::string why;
  if (!writeFile(file_.string(), fmt::format("{} {}\n", ::getpid(), hostName()), why))
    throw WriteError(fmt::format("\"{}\" could not be written: {}", file_.string(), why));
  written_ = std::chrono::steady_clock::now();
}

void PlanOwner::renew() {
  if (std::chrono::steady_clock::now() - written_ >= kRenewal) write();
}

bool PlanOwner::endOther(const BatchPlan& plan) {
  bool free = true;
  try {
    const FolderLock lock(plan.folder(), [] { throw FileError(""); });
  } catch (const FileError&) {
    free = false;
  }
  const auto owner = readOwner(ownerFile(plan));
  return !free && owner && owner->host == hostName() && ::kill(owner->process, SIGTERM) == 0;
}

}  // namespace tomales
