// The headers that come with the renderer for shaders that include them by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "front_test_tools.h"
#include "places.h"

namespace tomales::compiler {
namespace {

const std::string kFolder = TOMALES_SOURCE_DIR "/shaders/include";

std::vector<std::string> headers() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    out.push_back(entry.path().filename().string());
  std::ranges::sort(out);
  return out;
}

std::string messagesWith(const std::string& text) {
  PreprocessOptions options;
  Front front(text, options);
  return front.parsed().messages.rendered(front.sources);
}

std::string included(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += "#include \"" + name + "\"\n";
  return out;
}

TEST(Headers, AreReadAloneAndTogetherInAnyOrder) {
  std::vector<std::string> names = headers();
  EXPECT_GE(names.size(), 10u);
  for (const std::string& name : names) EXPECT_EQ(messagesWith(included({name, name})), "") << name;
  EXPECT_EQ(messagesWith(included(names)), "");
  std::ranges::reverse(names);
  EXPECT_EQ(messagesWith(included(names)), "");
}

TEST(Headers, HaveWhatPublicShadersCall) {
  // One call of each, with the number of arguments that public shaders give.
  struct Use {
    const char *header, *call;
  };
  const Use all[] = {
      {"filterwidth.h", "filterwidth(s) + filterwidthp(P)"},
      {"noises.h", "snoise(P) + snoise2(s, t) + snoisexy(s, t) + filteredsnoise(P, w) + VLNoise(P, 1)"},
      {"noises.h", "vsnoise(P) + filteredvsnoise(P, w) + filteredVLNoise(P, w, 1)"},
      {"noises.h", "fBm(P, w, 4, 2, .5) + turbulence(P, w, 4, 2, .5) + fBm_default(P)"},
      {"noises.h", "vfBm(P, w, 4, 2, .5)"},
      {"noises.h", "voronoi_f1_3d(P, 1, a, b)"},
      {"noises.h", "voronoi_f1f2_3d(P, 1, a, b, c, d)"},
      {"noises.h", "voronoi_f1_2d(s, t, 1, a, b, c)"},
      {"noises.h", "voronoi_f1f2_2d(s, t, 1, a, b, c, d, e, f)"},
      {"patterns.h", "boxstep(a, b, x) + filteredpulse(a, b, x, w) + filteredpulsetrain(a, b, x, w)"},
      {"patterns.h", "filteredabs(x, w) + smoothpulse(0, 1, 2, 3, x) + smoothpulsetrain(0, 1, 2, 3, 4, x)"},
      {"patterns.h", "varyEach(C, 1, .1, .1, .1)"},
      {"patterns.h", "tilepattern(s, t, w, w, .1, .1, a, b, c, d)"},
      {"normals.h", "shadingnormal(N) + ShadingNormal(N)"},
      {"displace.h", "Displace(N, \"shader\", 1, 0)"},
      {"project.h", "ProjectTo2D(\"st\", P, \"shader\", array_to_mx(m), a, b, c, d)"},
      {"reflections.h", "SampleEnvironment(P, R, 1, 0, envname, envspace, envrad)"},
      {"reflections.h", "Environment(n, \"world\", 0, P, R, 0, a) + ReflMap(n, P, 0, a)"},
      {"material.h", "MaterialMatte(N, C, 1, 1) + MaterialClay(N, C, 1, 1, .1)"},
      {"material.h", "MaterialPlastic(N, C, 1, 1, 1, .1) + MaterialRoughMetal(N, C, 1, 1, 1, .1)"},
      {"material.h", "MaterialShinyPlastic(N, C, 1, 1, 1, .1, 1, 0, 1.5, 1, ENVPARAMS)"},
      {"material.h", "MaterialShinyMetal(N, C, 1, 1, 1, .1, 1, 0, 1, ENVPARAMS)"},
      {"material.h", "LocIllumGlossy(N, V, .1, .5) + LocIllumOrenNayar(N, V, .1)"},
      {"materials.h", "MaterialMatte(N, C, 1, 1)"},
      {"pxslUtil.h", "pxslFilteredFNoise(P, u, v) + pxslFilterWidth(u, v) + pxslBimix(C, C, C, C, s, t)"},
      {"pxslUtil.h", "pxslFilteredCNoise(P, u, v) + pxslFilteredVNoise(P, u, v) + pxslCmix(C, C, C)"},
      {"pxslRayUtil.h", "pxslUtilShadingNormal(N)"},
      {"maya_magic_shaders.h", "mayaBlinn(N, V, .3, .7)"},
      {"rmannotes.h", "udn(s, 0, 1) + udn2(s, t, 0, 1) + pulse(a, b, w, x) + blend(a, b, x)"},
      {"rmannotes.h", "union(a, b) + intersection(a, b) + difference(a, b) + complement(a)"},
      {"rmannotes.h", "repeat(s, 5) + whichtile(s, 5) + (odd(a) ? 1 : 0) + (even(a) ? 1 : 0)"},
      {"rmannotes.sl", "topolar2d(s, t, r, theta); rotate2d(s, t, a, .5, .5, x, y)"}};
  for (const Use& use : all) {
    const std::string text = included({use.header}) + "surface x() { " + use.call + "; }";
    EXPECT_EQ(messagesWith(text), "") << use.call;
    PreprocessOptions options;
    Front front(text, options);
    for (const StmtPtr& statement : front.parsed().file.shaders.at(0)->body->body)
      for (const ExprPtr& call : statement->exprs) {
        if (call->kind != ExprKind::Call) continue;
        const auto isIt = [&](const auto& f) {
          return f->name == call->text && f->parameters.size() == call->args.size();
        };
        EXPECT_TRUE(std::ranges::any_of(front.file.functions, isIt)) << call->text;
      }
  }
}

}  // namespace
}  // namespace tomales::compiler
