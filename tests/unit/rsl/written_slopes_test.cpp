// Derivatives of texts that nobody has written: smooth functions of z = s / 1000 through branches, loops, functions and
// arrays, against differences of what the same text gives at other s. Conditions are of t alone, so that no point takes
// another way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/rsl/shaded.h"

namespace tomales::compiler {
namespace {

class SmoothText {
 public:
  explicit SmoothText(uint32_t seed) : random_(seed) {
    text_ =
        "float g(float a, b) { float l = sin(a); if (t < -5) return l * b; l += cos(b); return l; }\n"
        "void h(float a; output float b) { b = b * a; if (mod(-t, 2) == 1) b = sin(a + b); }\n"
        "surface test(output varying float x = 0, y = 0) {\n"
        "float z = s / 1000; float v0 = z, v1 = 0.5, v2 = z * z; color c0 = color (z, 1, 0.5); float n[3];\n"
        "matrix m = rotate(translate((matrix 1), vector (0.1, 0.2, 0.3)), 0.5, vector (1, 2, 3));\n"
        "n[0] = z; n[1] = 0.3; n[2] = sin(z);\n";
    block(0);
    text_ += "x = v0 + v1 + v2 + comp(c0, 0) + comp(c0, 1) + n[0] + n[1] + n[2]; y = Du(x) * 1000; }\n";
  }
  const std::string& text() const { return text_; }

 private:
  uint32_t pick(uint32_t below) { return static_cast<uint32_t>(random_() % below); }
  std::string variable() { return fmt::format("v{}", pick(3)); }
  std::string simple() {
    static constexpr const char* kSimple[] = {"z", "v0", "v1", "v2", "0.7", "comp(c0, 0)", "n[1]", "n[mod(-t, 3)]"};
    return kSimple[pick(8)];
  }
  std::string smooth(int depth) {
    if (depth == 0) return simple();
    const auto a = [&] { return smooth(depth - 1); };
    static constexpr const char* kOne[] = {"sin({})",
                                           "cos({})",
                                           "exp(sin({}))",
                                           "sqrt(2 + sin({}))",
                                           "inversesqrt(2 + cos({}))",
                                           "log(2 + sin({}))",
                                           "tan(0.5 * sin({}))",
                                           "atan({})",
                                           "asin(0.7 * sin({}))",
                                           "acos(0.7 * cos({}))",
                                           "erf({})",
                                           "pow(2 + sin({}), 1.5)",
                                           "smoothstep(-2, 2, sin({}))",
                                           "noise({})",
                                           "noise(point ({}, 0.3, 0.4))",
                                           "comp(color noise(point (0.2, {}, 0.4)), 1)",
                                           "length(vector ({}, 1, 2))",
                                           "ycomp(normalize(vector (1, {}, 2)))",
                                           "xcomp(transform(m, point ({}, 1, 2)))",
                                           "spline(0.5 + 0.3 * sin({}), 0, 0.2, 0.5, 0.3, 1, 0.4)",
                                           "zcomp(rotate(point ({}, 1, 2), 0.5, point (0, 0, 0), point (1, 1, 1)))",
                                           "xcomp(reflect(vector ({}, 1, 0), vector (0, 0.6, 0.8)))",
                                           "-{}",
                                           "degrees(radians({}))"};
    static constexpr const char* kTwo[] = {"({} + {})",
                                           "({} - {})",
                                           "({} * {})",
                                           "({} / (2 + sin({})))",
                                           "mix({}, {}, 0.3)",
                                           "mix(0.2, {}, sin({}))",
                                           "atan({}, 3 + sin({}))",
                                           "noise({}, {})",
                                           "pow(2 + sin({}), cos({}))",
                                           "(vector ({}, 1, 2) . vector (2, {}, 1))",
                                           "zcomp(vector ({}, 1, 2) ^ vector (2, {}, 1))",
                                           "(t < -4 ? {} : {})",
                                           "g({}, {})",
                                           "noise(point ({}, {}, 0.1), 0.6)",
                                           "distance(point ({}, 0, 1), point (0, {}, 3))"};
    if (pick(2)) return fmt::format(fmt::runtime(kOne[pick(std::size(kOne))]), a());
    const std::string first = a();
    return fmt::format(fmt::runtime(kTwo[pick(std::size(kTwo))]), first, a());
  }
  void block(int depth) {
    for (uint32_t count = 2 + pick(3); count > 0; --count) {
      switch (pick(depth < 3 ? 9 : 6)) {
        case 0:
          text_ += fmt::format("setcomp(c0, {}, sin({}));\n", pick(2), smooth(1));
          break;
        case 1:
          text_ += fmt::format("n[{}] = sin({});\n", pick(2) ? "1" : "mod(-t, 3)", smooth(2));
          break;
        case 2:
          text_ += fmt::format("h({}, v{});\n", pick(2) ? "z" : "comp(c0, 1)", pick(3));
          break;
        case 3:
          text_ += fmt::format("c0 = 0.5 * c0 * color ({}, z, 1) + color (0, 0.1, 0);\n", smooth(1));
          break;
        case 4:
        case 5:
          text_ += fmt::format("{} {} sin({});\n", variable(), pick(3) ? "=" : "+=", smooth(2));
          break;
        case 6:
          text_ += fmt::format("if (mod(-t, {}) < 1) {{\n", 2 + pick(3));
          block(depth + 1);
          text_ += "} else {\n";
          block(depth + 1);
          text_ += "}\n";
          break;
        default: {
          const std::string k = fmt::format("k{}", counters_++);
          text_ +=
              fmt::format("{{ float {0}; for ({0} = 0; {0} < {1}; {0} += 1) {{\n", k, pick(2) ? "2" : "mod(-t, 3)");
          if (pick(2)) text_ += fmt::format("if ({} > 0 && t < -6) {};\n", k, pick(2) ? "break" : "continue");
          block(depth + 1);
          text_ += "} }\n";
        }
      }
    }
  }
  std::mt19937 random_;
  std::string text_;
  int counters_ = 0;
};

/// x or y of all points, where s is greater by `more`.
std::vector<float> given(const CompiledText& compiled, const char* output, float more) {
  ServedGrid g(20);
  float* const s = const_cast<float*>(g.grid.s);
  for (int i = 0; i < g.n; ++i) s[i] += 0.25f + more;
  g.run(compiled.shader());
  const float* const out = g.output(outputNamed(compiled, output));
  return {out, out + g.grid.count};
}

TEST(WrittenSlopes, AreThoseOfDifferences) {
  int steep = 0;
  for (uint32_t seed = 0; seed < 100; ++seed) {
    const SmoothText text(seed);
    const CompiledText compiled(text.text());
    ASSERT_TRUE(compiled.good()) << compiled.said() << text.text();
    constexpr float kAside = 4;
    const std::vector<float> slope = given(compiled, "y", 0), below = given(compiled, "x", -kAside),
                             above = given(compiled, "x", kAside);
    for (size_t i = 0; i < slope.size(); ++i) {
      const float should = 1000 * 4 * (above[i] - below[i]) / (2 * kAside);  // du is 1/4
      ASSERT_NEAR(slope[i], should, 0.02f + 0.02f * std::abs(should)) << "seed " << seed << ", point " << i << "\n"
                                                                      << text.text();
      steep += std::abs(should) > 1;
    }
  }
  EXPECT_GT(steep, 1000);
}

}  // namespace
}  // namespace tomales::compiler
