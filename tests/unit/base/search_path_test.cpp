#include "reyes/base/file_guesses.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

TEST(CandidateFiles, OfAnotherMachinesFoldersAreFoundByTheEndsOfTheirNames) {
  const TemporaryFolder temporary(testing::TempDir());
  const fs::path bowl = fs::weakly_canonical(temporary.path()) / "bowl";
  for (const char* folder : {"maps", "rib", "rib/maps"}) fs::create_directories(bowl / folder);
  for (const char* file : {"maps/a.tx", "rib/maps/b.tif", "maps/b.tx", "rib/c.tx"}) std::ofstream(bowl / file) << "x";
  const auto best = [&](const std::string& name) {
    const auto found = candidateFiles(name, (bowl / "rib").string(), {".tif"});
    return found.empty() ? "" : fs::path(found[0]).lexically_relative(bowl).string();
  };
  EXPECT_EQ(best("/home/ann/bowl/maps/a.tx"), "maps/a.tx") << "beside the folder of the scene";
  EXPECT_EQ(best("C:\\ann\\bowl\\maps\\a.tx"), "maps/a.tx");
  EXPECT_EQ(best("/home/ann/cup/maps/a.tx"), "") << "another folder's";
  EXPECT_EQ(best("/home/ann/cup/maps/b.tx"), "rib/maps/b.tif") << "below the folder of the scene";
  EXPECT_EQ(best("/home/ann/bowl/maps/b.tx"), "maps/b.tx") << "the longer end comes first";
  EXPECT_EQ(best("maps/a.tx"), "maps/a.tx") << "as seen from a folder above";
  EXPECT_EQ(best("a.tx"), "") << "a name alone is sought where the scene says";
  EXPECT_EQ(best("/home/ann/bowl/maps/c.tx"), "rib/c.tx") << "the last part alone comes last";
}

}  // namespace
}  // namespace tomales
