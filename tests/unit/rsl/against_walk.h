// A text through the compiler and the machine, and point by point through its tree.
#pragma once
#include <fmt/format.h>

#include "tests/unit/rsl/shaded.h"
#include "tests/unit/rsl/tree_walk.h"

namespace tomales::compiler {

/// Point i of the grid alone.
inline TreeWalk walked(const Shader& shader, const ServedGrid& g, int i) {
  TreeWalk::Globals globals{{Global::s, g.grid.s[i]},
                            {Global::t, g.grid.t[i]},
                            {Global::u, g.grid.u[i]},
                            {Global::P, rsl::get(g.grid.P, i)},
                            {Global::Cs, rsl::get(g.grid.Cs, i)}};
  std::vector<TreeWalk::Light> lights;
  for (const auto& light : g.lights) lights.push_back({light.lit(i), light.L, light.Cl});
  return TreeWalk(shader, std::move(globals), std::move(lights));
}

/// Where the two differ, in any bit of an output (all parameters but the first); empty: nowhere.
inline std::string difference(const std::string& text) {
  const CompiledText compiled(text);
  if (!compiled.good()) return compiled.said() + text;
  const Shader& shader = *compiled.checked.file.shaders[0];
  ServedGrid g(37);
  g.maskAtRandom();
  g.run(compiled.shader());
  for (int i = 0; i < g.grid.count; ++i) {
    if (!g.active[static_cast<size_t>(i)]) continue;
    const TreeWalk walk = walked(shader, g, i);
    for (size_t k = 1; k < shader.parameters.size(); ++k)
      for (int c = 0; c < (shader.parameters[k]->type.isTriple() ? 3 : 1); ++c) {
        const float is = g.output(outputNamed(compiled, shader.parameters[k]->name), c)[i],
                    should = walk.valueOf(*shader.parameters[k]).x[c];
        if (is != should)
          return fmt::format("point {}, {}: {} where {} is right\n{}", i, shader.parameters[k]->name, is, should, text);
      }
  }
  return {};
}

}  // namespace tomales::compiler
