// Texts that nobody has written: the compiler and the machine, with all passes, give the bits that a point gives that
// walks through the tree.
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/rsl/shaded.h"
#include "tests/unit/rsl/tree_walk.h"
#include "tests/unit/rsl/written_program.h"

namespace tomales::compiler {
namespace {

/// Point i of the grid alone.
TreeWalk walked(const Shader& shader, const ServedGrid& g, int i) {
  TreeWalk::Globals globals{{Global::s, g.grid.s[i]},
                            {Global::t, g.grid.t[i]},
                            {Global::u, g.grid.u[i]},
                            {Global::P, rsl::get(g.grid.P, i)},
                            {Global::Cs, rsl::get(g.grid.Cs, i)}};
  std::vector<TreeWalk::Light> lights;
  for (const auto& light : g.lights) lights.push_back({light.lit(i), light.L, light.Cl});
  return TreeWalk(shader, std::move(globals), std::move(lights));
}

class Differential : public ::testing::TestWithParam<uint32_t> {};

TEST_P(Differential, WrittenTextsMeanToTheCompilerWhatTheyMeanToAPlainWalk) {
  for (uint32_t seed = GetParam(); seed < GetParam() + 50; ++seed) {
    std::mt19937 random(seed);
    const WrittenProgram program([&](uint32_t below) { return static_cast<uint32_t>(random() % below); });
    const CompiledText compiled(program.text());
    ASSERT_TRUE(compiled.good()) << compiled.said() << program.text();
    const Shader& shader = *compiled.checked.file.shaders[0];
    ServedGrid g(37);
    g.maskAtRandom();
    g.run(compiled.shader());
    for (int i = 0; i < g.grid.count; ++i) {
      if (!g.active[static_cast<size_t>(i)]) continue;
      const TreeWalk walk = walked(shader, g, i);
      for (size_t k = 1; k < shader.parameters.size(); ++k)
        for (int c = 0; c < (shader.parameters[k]->type.isTriple() ? 3 : 1); ++c)
          ASSERT_EQ(g.output(k, c)[i], walk.valueOf(*shader.parameters[k]).x[c])
              << "seed " << seed << ", point " << i << ", " << shader.parameters[k]->name << "\n"
              << program.text();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Differential, ::testing::Values(1u, 51u, 101u, 151u));

}  // namespace
}  // namespace tomales::compiler
