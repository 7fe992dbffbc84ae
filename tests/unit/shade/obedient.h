// A surface shader that does what a test says, in RSL's manner, at half of its points.
#pragma once
#include <functional>

#include "reyes/sl.h"
#include "tests/unit/shade/stage.h"

namespace tomales {

/// The body of the one shader; set by the test, on whose thread it runs.
inline std::function<void(sl::Surface&)> body;
struct obedient : sl::Surface {
  void main() {
    Ci = sl::Color(-1.0);
    Oi = sl::Color(1.0);
    body(*this);
  }
};
inline rsl::FloatParam lift("lift", 3, "");
inline const rsl::Shader obedientShader(TM_SURFACE, "obedient", "", TM_TRACES | TM_DERIVATIVES, sl::shade<obedient>,
                                        {&lift});

class BatchServices : public Stage {
 protected:
  BatchServices() {
    static const TmShader* const shaders[] = {obedientShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    surface("obedient");
  }
  /// Ci of `n` points at z = 5, of which those with u < 1/2 are asked.
  std::vector<vec3> asked(int n, const std::function<void(sl::Surface&)>& what, const ShadeContext& context = {}) {
    body = [&](sl::Surface& s) { sl::If(s.u < 0.5, [&] { what(s); }); };
    const ShadedPoints out = shade(points(std::vector<vec3>(static_cast<size_t>(n), vec3(0, 0, 5))), context);
    std::vector<vec3> colors;
    for (int i = 0; i < n; ++i) colors.push_back(out.color(i));
    for (int i = (n + 1) / 2; i < n; ++i)
      EXPECT_EQ(colors[static_cast<size_t>(i)], vec3(-1)) << "nobody asked at " << i;
    return colors;
  }
};

}  // namespace tomales
