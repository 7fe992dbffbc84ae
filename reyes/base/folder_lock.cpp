#include "reyes/base/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "reyes/base/stop.h"

namespace tomales {
namespace {

/// Returns true if another process has the lock.
bool isTaken(int descriptor) { return ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; }

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::function<void()>& waits)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || !isTaken(descriptor_)) return;
  waits();
  do {
    if (stopRequested()) {
      ::close(descriptor_);
      throw Stopped();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  } while (isTaken(descriptor_));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace tomales
