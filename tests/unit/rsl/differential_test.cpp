// Texts that nobody has written: the compiler and the machine, with all passes, give the bits that a point gives that
// walks through the tree.
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/rsl/against_walk.h"
#include "tests/unit/rsl/written_program.h"

namespace tomales::compiler {
namespace {

class Differential : public ::testing::TestWithParam<uint32_t> {};

TEST_P(Differential, WrittenTextsMeanToTheCompilerWhatTheyMeanToAPlainWalk) {
  for (uint32_t seed = GetParam(); seed < GetParam() + 50; ++seed) {
    std::mt19937 random(seed);
    const Choose choose = [&](uint32_t below) { return static_cast<uint32_t>(random() % below); };
    ASSERT_EQ(difference(WrittenProgram(choose).text()), "") << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Differential, ::testing::Values(1u, 51u, 101u, 151u));

}  // namespace
}  // namespace tomales::compiler
