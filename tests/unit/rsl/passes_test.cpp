// What the passes leave of a shader, and what they find of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/rsl/shaded.h"

namespace tomales::compiler {
namespace {

class Passes : public ::testing::Test {
 protected:
  const Code& code(const std::string& body, const std::string& kind = "surface") {
    compiled_ = std::make_unique<CompiledText>(fmt::format(
        "{} test(float p = 3; output varying float x = 0; output varying color c = 0) {{ {} }}", kind, body));
    EXPECT_TRUE(compiled_->good()) << compiled_->said();
    return compiled_->shader().code();
  }
  /// How many instructions of this name are left.
  int count(const std::string& op, const std::string& body) {
    const std::string text = dump(code(body));
    int n = 0;
    for (size_t at = 0; (at = text.find("= " + op + " ", at)) != text.npos; ++at) ++n;
    return n;
  }
  uint32_t found(const std::string& body, const std::string& kind = "surface") { return code(body, kind).capabilities; }

 private:
  std::unique_ptr<CompiledText> compiled_;
};

TEST_F(Passes, ConstantsAreFolded) {
  EXPECT_EQ(count("Mul", "x = 2 * 3 + s;"), 0);
  EXPECT_EQ(count("Sin", "float a = 0.5; x = sin(a) + s;"), 0);
  EXPECT_EQ(count("ColorTransform", "c = color \"hsv\" (0.2, 0.3, 0.4) * s;"), 0);
  EXPECT_EQ(count("Concat", "c = texture(concat(\"a\", \".tx\"));"), 0);
  EXPECT_EQ(count("Mul", "x = 1 * s;"), 0);
  EXPECT_EQ(count("Add", "x = s + 0;"), 0);
  EXPECT_EQ(count("Mul", "x = s * t;"), 1) << "what varies stays";
}

TEST_F(Passes, WhatIsComputedTwiceIsComputedOnce) {
  EXPECT_EQ(count("Noise3F", "x = noise(P) + noise(P);"), 1);
  EXPECT_EQ(count("Noise3F", "float a = noise(P); if (s > 2) x = noise(P); x += a;"), 1);
  EXPECT_EQ(count("Mul", "float a = s; x = a * t; a = a + p; x += a * t;"), 2) << "a has changed";
  EXPECT_EQ(count("RandomF", "x = random() + random();"), 2) << "another number each time";
}

TEST_F(Passes, WhatNobodyReadsIsNotComputed) {
  EXPECT_EQ(count("Noise3F", "float a = noise(P); float b = a * a; x = 1;"), 0);
  EXPECT_EQ(count("Noise3F", "float a = 0; if (s > 2) a = noise(P); x = 1;"), 0);
  EXPECT_EQ(count("Diffuse", "color a = diffuse(N); x = 1;"), 0);
  EXPECT_EQ(count("Bake3d", "bake3d(\"a\", \"b\", P, N, \"b\", s); x = 1;"), 1) << "it has an effect";
}

TEST_F(Passes, WhatIsAssignedOnceIsComputedInItsPlace) {
  const auto copies = [&](const std::string& body) {
    const std::string text = dump(code(body, "light"));
    size_t n = 0;
    for (size_t at = 0; (at = text.find(".L = Copy", at)) != text.npos; ++at) ++n;
    return n;
  };
  const std::string cone = "illuminate(point \"current\" (0, 0, 1), vector \"current\" (0, 0, 1), .5) Cl = length(L);";
  EXPECT_EQ(copies(cone), 0u) << "the cone is asked of L itself";
  EXPECT_EQ(copies(cone + cone), 4u) << "L changes";
}

TEST_F(Passes, WhatIsTheSameForAllPointsIsComputedOnce) {
  EXPECT_NE(dump(code("x = sin(p) * s;")).find("uf"), std::string::npos);
  for (const Register& r : code("float a = p * 2; if (s > 2) a = 1; x = a;").registers)
    if (r.name == "a") {
      EXPECT_TRUE(r.varying) << "it is set at some points";
    }
  for (const Register& r : code("float k; for (k = 0; k < p; k += 1) x += s;").registers)
    if (r.name == "k") {
      EXPECT_FALSE(r.varying);
    }
  for (const Register& r : code("float k; for (k = 0; k < s; k += 1) x += 1;").registers)
    if (r.name == "k") {
      EXPECT_TRUE(r.varying) << "some points leave earlier";
    }
}

TEST_F(Passes, OnlyWhatAStepReachesIsDifferentiated) {
  EXPECT_EQ(count("StepU", "x = Du(s * s);"), 1);
  EXPECT_EQ(count("StepV", "x = Du(s * s);"), 0);
  EXPECT_EQ(count("StepU", "x = Du(s * s) + t * t;"), 1) << "nobody asks how t changes";
  EXPECT_EQ(count("Slope3F", "x = Du(noise(P));"), 1);
  EXPECT_EQ(count("Noise3F", "x = Du(noise(P));"), 0) << "the value itself is not asked for";
}

TEST_F(Passes, RegistersShareSlots) {
  std::string body = "float a = s;";
  for (int k = 0; k < 100; ++k)
    body += fmt::format("float a{0} = sin({1}) * t; x += a{0};", k, k == 0 ? "a" : fmt::format("a{}", k - 1));
  EXPECT_LT(code(body).varyingFloats, 20);
}

TEST_F(Passes, SurfacesThatKeepOpacityAreFound) {
  EXPECT_TRUE(found("Oi = Os; Ci = Cs;") & TM_KEEPS_OPACITY);
  EXPECT_TRUE(found("Ci = Cs;") & TM_KEEPS_OPACITY) << "Oi stays Os";
  EXPECT_TRUE(found("if (s > 2) Oi = Os;") & TM_KEEPS_OPACITY);
  EXPECT_FALSE(found("Oi = 0.5 * Os;") & TM_KEEPS_OPACITY);
  EXPECT_FALSE(found("Oi = Os; if (s > 2) Oi = 0;") & TM_KEEPS_OPACITY);
  EXPECT_FALSE(found("setcomp(Oi, 0, 0);") & TM_KEEPS_OPACITY);
  EXPECT_FALSE(found("void f(output color a) { a = 0; } f(Oi);") & TM_KEEPS_OPACITY);
}

TEST_F(Passes, SurfacesThatEmitAreFound) {
  EXPECT_TRUE(found("Ci = Cs;") & TM_EMITS);
  EXPECT_TRUE(found("x = 1;") & TM_EMITS) << "Ci stays Cs";
  EXPECT_TRUE(found("Ci = Cs * diffuse(N) + 0.1;") & TM_EMITS);
  EXPECT_FALSE(found("if (s > 2) Ci = Cs * diffuse(N);") & TM_EMITS) << "elsewhere Ci is black";
  EXPECT_FALSE(found("Ci = Os * Cs * (ambient() + diffuse(N)) + specular(N, -I, 0.1);") & TM_EMITS);
  EXPECT_FALSE(found("color a = 0; illuminance (P, N, PI / 2) a += Cl * (normalize(L) . N); Ci = a * Cs;") & TM_EMITS);
  EXPECT_FALSE(found("Ci = 0; float k; for (k = 0; k < 3; k += 1) Ci += k * diffuse(N);") & TM_EMITS);
  EXPECT_FALSE(found("Ci = 0;") & TM_EMITS);
  EXPECT_TRUE(found("color a = 0; illuminance (P) a += 1; Ci = a;") & TM_EMITS);
}

TEST_F(Passes, SurfacesThatAreEvenAreFound) {
  EXPECT_TRUE(found("Ci = Cs * diffuse(faceforward(normalize(N), I));") & TM_EVEN);
  EXPECT_FALSE(found("Ci = Cs * diffuse(N);") & TM_EVEN) << "N may face away from the eye";
  EXPECT_TRUE(found("Ci = Cs * p; if (p > 2) Ci = 0;") & TM_EVEN);
  EXPECT_FALSE(found("Ci = Cs * noise(P);") & TM_EVEN);
  EXPECT_FALSE(found("Ci = Cs; if (s > 2) Ci = 0;") & TM_EVEN) << "where it is chosen by places";
  EXPECT_FALSE(found("Ci = s > 2 ? Cs : Os;") & TM_EVEN);
  EXPECT_FALSE(found("Ci = texture(\"a\");") & TM_EVEN);
  EXPECT_FALSE(found("float k = 0; while (k < s) k += 1; Ci = k;") & TM_EVEN);
  EXPECT_FALSE(found("Ci = Cs; Oi = s;") & TM_EVEN);
  EXPECT_FALSE(found("Ci = Cs; if (s > 2) return; Ci = 0;") & TM_EVEN) << "the end of it is reached at some places";
  EXPECT_FALSE(found("float k; Ci = 0; for (k = 0; k < 3; k += 1) { if (s > k) break; Ci += 1; }") & TM_EVEN);
}

TEST_F(Passes, WhoTracesAndWhoDifferentiatesIsFound) {
  EXPECT_TRUE(found("Ci = trace(P, N);") & TM_TRACES);
  EXPECT_TRUE(found("Ci = occlusion(P, N, 4);") & TM_TRACES);
  EXPECT_TRUE(found("gather(\"\", P, N, 1, 4) { Ci += 1; }") & TM_TRACES);
  EXPECT_FALSE(found("float a = occlusion(P, N, 4); x = 1;") & TM_TRACES) << "nobody reads it";
  EXPECT_TRUE(found("x = Du(s);") & TM_DERIVATIVES);
  EXPECT_TRUE(found("Ci = texture(\"a\");") & TM_DERIVATIVES);
  EXPECT_TRUE(found("x = filterstep(0.5, s);") & TM_DERIVATIVES);
  EXPECT_FALSE(found("x = step(0.5, s);") & TM_DERIVATIVES);
}

TEST_F(Passes, WhoseHemispheresMayBeInterpolatedIsFound) {
  constexpr uint32_t kUnasked = TM_INTERPOLATED | TM_INTERPOLATED_UNASKED;
  EXPECT_EQ(found("Ci = occlusion(P, N, 4);") & kUnasked, static_cast<uint32_t>(TM_INTERPOLATED));
  EXPECT_EQ(found("Ci = occlusion(P, N, 4, \"maxvariation\", 0.1);") & kUnasked, kUnasked);
  EXPECT_EQ(found("Ci = indirectdiffuse(P, N, 4);") & kUnasked, kUnasked);
  EXPECT_EQ(found("Ci = occlusion(P, N, 4) * trace(P, N);") & kUnasked, static_cast<uint32_t>(TM_INTERPOLATED));
  EXPECT_EQ(found("Ci = indirectdiffuse(P, N, 4, \"pointbased\", 1, \"filename\", \"a\");") & kUnasked, 0u);
  EXPECT_EQ(found("Ci = trace(P, N);") & kUnasked, 0u);
  EXPECT_EQ(found("illuminate (point (0, 0, 0)) Cl = 1 - occlusion(Ps, Ns, 4);", "light") & kUnasked,
            static_cast<uint32_t>(TM_INTERPOLATED));
}

TEST_F(Passes, KindsOfLightsAreFound) {
  EXPECT_EQ(found("Cl = 1;", "light"), static_cast<uint32_t>(TM_LIGHT_AMBIENT));
  EXPECT_EQ(found("illuminate (point (0, 0, 0)) Cl = 1;", "light"), 0u);
  EXPECT_EQ(found("illuminate (point (0, 0, 0), vector (0, 0, 1), 1) Cl = 1;", "light"), 0u);
  EXPECT_EQ(found("L = 0; Cl = 1;", "light"), static_cast<uint32_t>(TM_LIGHT_AMBIENT)) << "nowhere is no direction";
  EXPECT_EQ(found("L = vector (0, 0, p); Cl = 1;", "light"), 0u);
  EXPECT_EQ(found("solar (vector (0, 0, 1), 0) Cl = 1;", "light"), static_cast<uint32_t>(TM_LIGHT_SOLAR));
  EXPECT_EQ(found("solar () Cl = 1;", "light"), static_cast<uint32_t>(TM_LIGHT_SOLAR | TM_LIGHT_SKY));
  EXPECT_EQ(found("if (p > 2) illuminate (point (0, 0, 0)) Cl = 1;", "light"), 0u);
  EXPECT_TRUE(found("illuminate (point (0, 0, 0)) Cl = transmission(Ps, point (0, 0, 0));", "light") & TM_TRACES);
}

TEST(Printed, PrintfWritesALineForEachActivePoint) {
  const CompiledText compiled("surface test() { if (s > 2) printf(\"%d: %f of %s\\n\", s, s / 2, \"a\"); }");
  ServedGrid g(5);
  g.active[4] = 0;
  g.run(compiled.shader());
  EXPECT_EQ(g.printed, (std::vector<std::string>{"3: 1.500000 of a\n"}));
}

// RenderMan Companion, listing 16.26: a glow that assigns Oi = 0 alone where it is not to be seen.
TEST(Uncoloured, WhatIsTransparentAndWasGivenNoColourShowsNothing) {
  const auto Ci = [](const std::string& body, int point) {
    const CompiledText compiled("surface test() { " + body + " }");
    EXPECT_TRUE(compiled.good()) << compiled.said();
    ServedGrid g(5);
    g.run(compiled.shader());
    return g.grid.Ci.x[point];
  };
  const std::string glow = "if (s > 2) { Ci = Cs * 0.5; Oi = 0.5; } else Oi = 0;";
  EXPECT_EQ(Ci(glow, 3), 0.125f);
  EXPECT_EQ(Ci(glow, 1), 0);
  EXPECT_EQ(Ci("Oi = 0;", 1), 0);
  EXPECT_EQ(Ci("if (s > 2) return; Oi = 0;", 1), 0);
  EXPECT_EQ(Ci("if (s > 2) return; Oi = 0;", 3), 0.25f);
  EXPECT_EQ(Ci("Oi = 0.5;", 1), 0.25f);
  EXPECT_EQ(Ci("Ci = Cs; Oi = 0;", 1), 0.25f) << "light that covers nothing is added";
}

TEST(Given, ParametersOfPrimitiveVariablesVary) {
  const CompiledText compiled(
      "surface test(float p = 3; color q = 1; output varying float x = 0; output varying color c = 0) {"
      " float k; for (k = 0; k < p; k += 1) x += 1; c = q * p; }");
  const size_t x = outputNamed(compiled, "x"), c = outputNamed(compiled, "c");
  for (const int count : {1, 17, 1000}) {
    ServedGrid g(count);
    g.maskAtRandom();
    g.bindOutputs(compiled.shader().lowered());
    float *const p = g.array(), *const q = g.array();
    for (int i = 0; i < count; ++i) {
      p[i] = static_cast<float>(i % 4);
      q[i] = static_cast<float>(i);
    }
    g.params[0].c[0] = p;
    g.params[0].step = 1;
    g.runBound(compiled.shader());
    for (int i = 0; i < count; ++i) {
      const bool on = g.active[static_cast<size_t>(i)] != 0;
      EXPECT_EQ(g.output(x)[i], on ? p[i] : FakeGrid::kBefore.x);
      EXPECT_EQ(g.output(c)[i], on ? p[i] : FakeGrid::kBefore.x);
    }
    g.bindOutputs(compiled.shader().lowered());
    g.params[1].c[0] = g.params[1].c[1] = g.params[1].c[2] = q;
    g.params[1].step = 1;
    g.runBound(compiled.shader());
    for (int i = 0; i < count; ++i)
      EXPECT_EQ(g.output(c)[i], g.active[static_cast<size_t>(i)] ? 3 * q[i] : FakeGrid::kBefore.x);
  }
}

/// What the compiler says of a surface, without the lines that it shows.
std::string saidOf(const std::string& body, const std::string& before = "") {
  const CompiledText compiled(before + "surface test() {" + body + "}");
  std::string out;
  for (const Message& m : compiled.messages.all()) out += m.text + "\n";
  return out;
}

TEST(Said, IsWhatIsLegalAndDoubtful) {
  EXPECT_EQ(saidOf("uniform float k = s; Ci = k;"),
            "\"k\" is declared uniform and is given values that vary; it varies\n");
  EXPECT_EQ(saidOf("uniform float k = 2, i; for (i = 0; i < k; i += 1) Ci *= k;"), "");
  EXPECT_EQ(saidOf("uniform float k = 0; illuminance (P) { lightsource(\"a\", k); Ci += k; }"), "");
  EXPECT_EQ(saidOf("float k = 1; if (k = 2) Ci = k;"), "this assigns \"k\"; '==' compares\n");
  EXPECT_EQ(saidOf("Ci = f(1);", "float f(float x) { float y = x; y += 1; }\n"),
            "\"f\" gives a float, and has no 'return': it gives 0\n");
}

TEST(Said, IsWhatIsWrong) {
  EXPECT_EQ(saidOf("Ci = Oss; Oi = OS;"),
            "there is no variable \"Oss\"; did you mean \"Os\"?\nthere is no variable \"OS\"; did you mean \"Os\"?\n");
  EXPECT_EQ(saidOf("break;"), "'break' stands in no loop\n");
  EXPECT_EQ(saidOf("while (1 == 1) continue 2;"), "'continue 2' has only 1 loops around it\n");
  EXPECT_EQ(saidOf("float k = 1; Ci = k(2);"), "\"k\" is a variable, and no function\n");
  EXPECT_EQ(saidOf("color k = setcomp(Ci, 0, 1);"),
            "a color is needed for \"k\", and setcomp() gives nothing\nthe variable \"k\" is never read\n");
  EXPECT_EQ(saidOf("Ci = Color (1, 0, 0);"),
            "there is no function \"Color\" (did you mean \"color\"?): its value is a loud one\n");
}

TEST(Said, IsThatAShaderNeedsMoreMemoryThanItMay) {
  EXPECT_EQ(saidOf("float a[131072]; a[0] = s; Ci = a[s];"),
            "the variables of this shader need 129 MB for 256 points, \"a\" most of it; 128 MB are the limit\n");
  EXPECT_EQ(saidOf("uniform float a[200000]; a[0] = 3; Ci = a[1];"), "") << "one for all points";
  EXPECT_NE(saidOf("uniform float a[1000000], b[1000000], c[1000000]; a[0] = b[0] = c[0] = 1;"
                   " Ci = a[1] + b[1] + c[1];"),
            "");
  EXPECT_EQ(saidOf("float a[10000]; a[0] = s; Ci = a[s];"), "");
}

TEST(Given, OutputsStartAsWhatTheSceneGives) {
  const CompiledText compiled(
      "light test(output varying float fog = 2; output color tint = 1; output float size[2] = {1, 2}) {"
      " fog += size[1]; Cl = tint * fog; }");
  const auto given = [&](const char* name) -> size_t {
    const auto& all = compiled.shader().lowered().parameters;
    return static_cast<size_t>(
        std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name && !p.output; }) -
        all.begin());
  };
  ServedGrid g(20);
  g.bindOutputs(compiled.shader().lowered());
  const float fog = 5, tint[] = {1, 2, 4}, size[] = {10, 20};
  g.params[given("fog")].c[0] = &fog;
  for (size_t k = 0; k < 3; ++k) g.params[given("tint")].c[k] = tint + k;
  g.params[given("size")].c[0] = size;
  g.runBound(compiled.shader());
  EXPECT_EQ(g.output(outputNamed(compiled, "fog"))[7], 25);
  EXPECT_EQ(g.output(outputNamed(compiled, "tint"), 2)[7], 4) << "nobody assigns it";
  EXPECT_EQ(g.grid.Cl.y[7], 50);
}

}  // namespace
}  // namespace tomales::compiler
