#include "reyes/base/folder_lock.h"

#include <gtest/gtest.h>

#include <optional>
#include <thread>

#include "reyes/base/stop.h"
#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

TEST(FolderLocks, LetTheSecondWaitUntilTheFirstIsGone) {
  const TemporaryFolder parent(std::filesystem::temp_directory_path());
  const std::filesystem::path folder = parent.path() / "shared";
  std::filesystem::create_directory(folder);
  std::optional<FolderLock> first(std::in_place, folder, [] { FAIL() << "nobody has it"; });
  std::atomic<bool> waited{false}, released{false};
  std::thread second([&] {
    const FolderLock lock(folder, [&] { waited = true; });
    EXPECT_TRUE(released);
  });
  while (!waited) std::this_thread::yield();
  released = true;
  first.reset();
  second.join();
}

TEST(FolderLocks, AreNotWaitedForWhenTheProcessIsToEnd) {
  const TemporaryFolder parent(std::filesystem::temp_directory_path());
  const std::filesystem::path folder = parent.path() / "shared";
  std::filesystem::create_directory(folder);
  const FolderLock first(folder, [] {});
  EXPECT_THROW(FolderLock(folder, [] { requestStop(); }), Stopped);
  requestStop(false);
}

}  // namespace
}  // namespace tomales
