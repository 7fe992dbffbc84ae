// The main function of every program of tests/unit.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

// ctest runs the suites of one program at the same time. Each process has a folder for temporary files of its own, so
// that two suites of a fixture may write files of the same name. It is no TemporaryFolder (reyes/base), which child
// processes that a test ends abruptly would remove. It comes before GoogleTest, which makes the parameters of tests
// when it starts: some of them are the names of files.
int main(int argc, char** argv) {
  std::string folder = (std::filesystem::temp_directory_path() / "tomales_unit_XXXXXX").string();
  if (!::mkdtemp(folder.data())) return EXIT_FAILURE;
  ::setenv("TMPDIR", folder.c_str(), 1);
  ::setenv("TEST_TMPDIR", folder.c_str(), 1);
  ::setenv("RC_PARAMS", "seed=1", 0);  // Makes up the same values always, unless a developer names another seed.
  testing::InitGoogleTest(&argc, argv);
  const int result = RUN_ALL_TESTS();
  std::filesystem::remove_all(folder);
  return result;
}
