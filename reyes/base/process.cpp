#include "reyes/base/process.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ctime>
#include <fstream>

namespace tomales {

int64_t residentBytes() {
  int64_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

// getrusage() would include the peak of the image before exec, which is the memory of the process that started this
// one.
int64_t peakResidentBytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (int64_t kB = 0; word == "VmHWM:" && status >> kB) return kB * 1024;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * int64_t{1024};
}

void restartPeak() { std::ofstream("/proc/self/clear_refs") << 5; }  // proc(5)

std::string hostName() {
  char name[256] = {};
  return ::gethostname(name, sizeof(name) - 1) == 0 ? name : "";
}

std::string timeNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char out[32] = {};
  std::strftime(out, sizeof out, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return out;
}

void keepFreedMemory() {
#ifdef __GLIBC__
  // glibc raises its limits up to this by itself, but only after blocks of this size have been freed.
  constexpr int kMmapped_bytes = 32 << 20;
  mallopt(M_MMAP_THRESHOLD, kMmapped_bytes);
  mallopt(M_TRIM_THRESHOLD, 2 * kMmapped_bytes);
#endif
}

void returnFreeMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::vector<std::filesystem::path> besideProgram(const std::string& name) {
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  std::vector<std::filesystem::path> out;
  for (const auto& path : {folder / name, folder / ".." / "lib" / "tomales" / name})
    if (std::filesystem::exists(path, none)) out.push_back(path);
  return out;
}

}  // namespace tomales
