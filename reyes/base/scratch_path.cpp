#include "reyes/base/scratch_path.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".part";
constexpr size_t kRandomDigits = 16;
constexpr size_t kMostOfStem = 200;  ///< Longer names could exceed the 255 bytes that file systems allow.

std::string prefixOf(const std::string& stem) { return "." + stem.substr(0, kMostOfStem) + "."; }

std::string randomDigits() {
  uint64_t random = 0;
  while (::getrandom(&random, sizeof random, 0) != sizeof random) {  // it fails only if a signal arrives
  }
  return fmt::format("{:016x}", random);
}

bool isScratchName(const std::string& name, const std::string& prefix) {
  if (name.size() != prefix.size() + kRandomDigits + kSuffix.size() || !name.starts_with(prefix) ||
      !name.ends_with(kSuffix))
    return false;
  const auto digits = name.begin() + static_cast<std::ptrdiff_t>(prefix.size());
  return std::all_of(digits, digits + kRandomDigits, [](unsigned char c) { return std::isxdigit(c); });
}

/// Opens a path for its lock. Network file systems lock only files that are open for writing, which folders cannot be.
int openToLock(const fs::path& path) {
  constexpr int kFlags = O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
  const int file = ::open(path.c_str(), O_RDWR | kFlags);
  return file >= 0 || errno != EISDIR ? file : ::open(path.c_str(), O_RDONLY | O_DIRECTORY | kFlags);
}

void removeIfStale(const fs::path& path) {
  const int descriptor = openToLock(path);
  if (descriptor < 0) return;
  std::error_code none;
  struct stat s {};
  const bool own = ::fstat(descriptor, &s) == 0 && s.st_uid == ::geteuid();
  if (own && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(path, none);
  ::close(descriptor);
}

void removeStale(const fs::path& folder, const std::string& prefix) {
  std::error_code none;
  for (fs::directory_iterator it(folder, none), end; !none && it != end; it.increment(none))
    if (isScratchName(it->path().filename().string(), prefix)) removeIfStale(it->path());
}

/// Returns an open file, or -1 with EEXIST if another process took the folder for stale before it was open.
int makeFolder(const fs::path& path) {
  if (::mkdir(path.c_str(), 0700) != 0) return -1;
  const int file = openToLock(path);
  if (file >= 0) return file;
  const int problem = errno == ENOENT ? EEXIST : errno;
  ::rmdir(path.c_str());
  errno = problem;
  return -1;
}

}  // namespace

ScratchPath::ScratchPath(const fs::path& folder, const std::string& stem, Kind kind) {
  const fs::path place = folder.empty() ? "." : folder;
  const std::string prefix = prefixOf(stem);
  removeStale(place, prefix);
  do {
    path_ = (folder / (prefix + randomDigits())).concat(kSuffix);
    // It is known before the file exists, so that a signal at any time leaves none.
    removal_.emplace([path = path_] {
      std::error_code none;
      fs::remove_all(path, none);
    });
  } while (!create(kind));
}

/// Returns false if the name is taken, or if another process took this for stale before it was locked.
bool ScratchPath::create(Kind kind) {
  constexpr int kNewFile = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  descriptor_ = kind == Kind::File ? ::open(path_.c_str(), kNewFile, 0666) : makeFolder(path_);
  if (descriptor_ < 0 && errno != EEXIST)
    throw fs::filesystem_error("cannot be made", path_, {errno, std::generic_category()});
  if (descriptor_ < 0) return false;
  ::flock(descriptor_, LOCK_EX);  // waits only for a process that tests whether the folder is stale
  struct stat s {};
  if (::fstat(descriptor_, &s) == 0 && s.st_nlink > 0) return true;
  ::close(descriptor_);
  descriptor_ = -1;
  return false;
}

ScratchPath::~ScratchPath() {
  std::error_code none;
  if (removal_) fs::remove_all(path_, none);
  if (descriptor_ >= 0) ::close(descriptor_);
}

void ScratchPath::release() { removal_.reset(); }

}  // namespace tomales
