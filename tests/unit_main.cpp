// The main function of every program of tests/unit.
#include <gtest/gtest.h>

#include <cstdlib>

#include "reyes/base/temporary_folder.h"

// ctest runs the tests of one program at the same time. Each process has a folder for temporary files of its own, so
// that two tests of a fixture may write files of the same name.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const tomales::TemporaryFolder folder(std::filesystem::temp_directory_path());
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  ::setenv("TEST_TMPDIR", folder.path().c_str(), 1);
  return RUN_ALL_TESTS();
}
