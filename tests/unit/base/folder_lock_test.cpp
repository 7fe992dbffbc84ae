#include "reyes/base/folder_lock.h"

#include <gtest/gtest.h>

#include <optional>
#include <thread>

#include "reyes/base/stop.h"
#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

TEST(FolderLocks, LetTheSecondWaitUntilTheFirstIsGone) {
  const TemporaryFolder folder(std::filesystem::temp_directory_path());
  std::optional<FolderLock> first(std::in_place, folder.path(), [] { FAIL() << "nobody has it"; });
  std::atomic<bool> waited{false}, released{false};
  std::thread second([&] {
    const FolderLock lock(folder.path(), [&] { waited = true; });
    EXPECT_TRUE(released);
  });
  while (!waited) std::this_thread::yield();
  released = true;
  first.reset();
  second.join();
}

TEST(FolderLocks, AreNotWaitedForWhenTheProcessIsToEnd) {
  const TemporaryFolder folder(std::filesystem::temp_directory_path());
  const FolderLock first(folder.path(), [] {});
  EXPECT_THROW(FolderLock(folder.path(), [] { requestStop(); }), Stopped);
  requestStop(false);
}

}  // namespace
}  // namespace tomales
