#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "reyes/shader.h"
#include "reyes/shader_registry.h"
#include "tests/unit/shade/installed_headers.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

// --- Shaders of this test
// -----------------------------------------------------------------------------------------

void throwing(const TmGrid*) { throw std::runtime_error("no bananas"); }
void dividing(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    rsl::set(g->Oi, i, {1, 1, 1});
    rsl::set(g->Ci, i, {i == 1 ? std::nanf("") : 1.0f, 1, 1});
  }
}

// Asks every service with point 1 switched off; Ci.x tells whether anything was written there.
constexpr float kUnwritten = -42;
void masked(const TmGrid* g) {
  TmGrid some = *g;
  std::vector<uint8_t> active(static_cast<size_t>(g->padded), 1);
  active[1] = 0;
  some.active = active.data();
  const TmServices& call = *g->call;
  rsl::Array roughness(g);
  rsl::Vec3Array N(g), outs[7] = {rsl::Vec3Array(g), rsl::Vec3Array(g), rsl::Vec3Array(g), rsl::Vec3Array(g),
                                  rsl::Vec3Array(g), rsl::Vec3Array(g), rsl::Vec3Array(g)};
  for (int i : rsl::Batch(g)) {
    N.set(i, {0, 0, -1});
    roughness[i] = 0.1f;
    for (auto& out : outs) out.set(i, {kUnwritten, kUnwritten, kUnwritten});
  }
  call.diffuse(g->host, &some, TM_ALL_LIGHT, N, outs[0]);
  call.specular(g->host, &some, N, N, roughness.data(), outs[1]);
  call.ambient(g->host, &some, outs[2]);
  call.transform(g->host, &some, TM_AS_POINT, "current", "world", N, outs[3]);
  call.texture(g->host, &some, "absent.tif", nullptr, g->s, g->t, outs[4]);
  call.transmission(g->host, &some, nullptr, rsl::view(g->P), N, outs[5]);
  call.indirectDiffuse(g->host, &some, N, outs[6], nullptr);
  for (int i : rsl::Batch(g)) {
    int touched = 0;
    for (const auto& out : outs) touched += out[i].x != kUnwritten;
    rsl::set(g->Oi, i, {1, 1, 1});
    rsl::set(g->Ci, i, {static_cast<float>(touched), 0, 0});
  }
}

// illuminance() loop: number of samples, their sum, and whether any came from an indirect light.
void looping(const TmGrid* g) {
  for (TmIlluminance sample = tmIlluminanceDefaults(); g->call->illuminance(g->host, g, &sample);)
    for (int i : rsl::Batch(g)) {
      rsl::set(g->Ci, i,
               rsl::get(g->Ci, i) + rsl::Vec3{1, rsl::get(sample.Cl, i).x, static_cast<float>(sample.isIndirect)});
      rsl::set(g->Oi, i, {1, 1, 1});
    }
}

const rsl::Shader throwingShader(TM_SURFACE, "throwing", "", 0, throwing, {});
const rsl::Shader dividingShader(TM_SURFACE, "dividing", "", 0, dividing, {});
const rsl::Shader maskedShader(TM_SURFACE, "masked", "", 0, masked, {});
const rsl::Shader loopingShader(TM_SURFACE, "looping", "", 0, looping, {});

class Plugins : public Stage {
 protected:
  Plugins() {
    static const TmShader* const shaders[] = {throwingShader, dividingShader, maskedShader, loopingShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
};

TEST_F(Plugins, AShaderThatThrowsIsReportedOnceAndRenderedLoudly) {
  surface("throwing");
  const ShadedPoints out = shade(points(std::vector<vec3>(600, vec3(0, 0, 5))));
  EXPECT_GT(out.color(0).x, 0);
  EXPECT_EQ(out.color(0).y, 0);
  expectColor(out.opacity(599), vec3(1));
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.entries()[0].count, 3);  // chunks of 256
  EXPECT_NE(log.entries()[0].message.find("no bananas"), std::string::npos);
}

TEST_F(Plugins, NotANumberIsBlackAndReportedOnceWithShaderAndObject) {
  surface("dividing");
  const ShadedPoints out = shade(points({vec3(0, 0, 5), vec3(0, 0, 5)}));
  EXPECT_EQ(out.color(0), vec3(1));
  EXPECT_EQ(out.color(1), vec3(0));
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_NE(log.entries()[0].message.find("\"dividing\""), std::string::npos);
  EXPECT_NE(log.entries()[0].message.find("\"thing\""), std::string::npos);
}

TEST_F(Plugins, ServicesLeaveInactivePointsAlone) {
  surface("masked");
  light("ambientlight");
  light("distantlight").castsShadows = true;
  const ShadedPoints out = shade(points({vec3(0, 0, 5), vec3(0, 0, 6), vec3(0, 0, 7)}));
  EXPECT_EQ(out.color(0).x, 7);
  EXPECT_EQ(out.color(1).x, 0);
  EXPECT_EQ(out.color(2).x, 7);
  EXPECT_EQ(services.shadowRays, 2 + 2);  // of diffuse (shared with specular) and of transmission
}

TEST_F(Plugins, AnIlluminanceLoopVisitsEverySampleShadowed) {
  surface("looping");
  services.visible = [](const vec3&, const vec3&) { return 0.5f; };
  services.E = {4, 0, 0};
  light("ambientlight");
  light("distantlight").castsShadows = true;
  light("indirectlight");
  expectColor(shadeOne(), {4, 4.5f, 3});
}

// --- Versions
// -----------------------------------------------------------------------------------------------------

// Pointers that must not be followed: reading them would crash.
template <class T>
const T* poison() {
  return reinterpret_cast<const T*>(static_cast<uintptr_t>(16));
}

TEST_F(Plugins, ALibraryOfAnotherAbiOrSizeIsRefusedBeforeAnythingElseIsRead) {
  TmShaderLibrary otherAbi{}, tooSmall{};
  otherAbi.abi = TM_SHADER_ABI + 1;
  otherAbi.structBytes = sizeof otherAbi;
  tooSmall.abi = TM_SHADER_ABI;
  tooSmall.structBytes = sizeof tooSmall - 1;
  for (TmShaderLibrary* l : {&otherAbi, &tooSmall}) {
    l->shaders = poison<const TmShader*>();
    l->fault = poison<char>();
    l->count = 1;
  }
  EXPECT_FALSE(registry.addLibrary(&otherAbi, "a.so"));
  EXPECT_FALSE(registry.addLibrary(&tooSmall, "b.so"));
  EXPECT_FALSE(registry.addLibrary(nullptr, "c.so"));
  EXPECT_EQ(log.count("shader-plugin"), 3);
  EXPECT_NE(
      log.entries()[0].message.find(fmt::format("is built for shader ABI {}, {} bytes; this renderer has ABI {}, "
                                                "{} bytes: compile it against the headers of this version",
                                                TM_SHADER_ABI + 1, sizeof otherAbi, TM_SHADER_ABI, sizeof otherAbi)),
      std::string::npos)
      << log.entries()[0].message;
}

TEST_F(Plugins, AShaderOfAnotherAbiOrSizeIsSkippedAndItsNeighboursStay) {
  TmShader otherAbi{}, tooSmall{};
  otherAbi.abi = TM_SHADER_ABI + 1;
  otherAbi.structBytes = sizeof(TmShader);
  otherAbi.name = poison<char>();
  tooSmall.abi = TM_SHADER_ABI;
  tooSmall.structBytes = 8;
  tooSmall.name = poison<char>();
  TmShader good = *loopingShader;
  good.name = "good";
  const TmShader* const shaders[] = {&otherAbi, &good, &tooSmall};
  const TmShaderLibrary library = rsl::libraryOf(shaders);
  EXPECT_TRUE(registry.addLibrary(&library, "d.so"));
  EXPECT_EQ(registry.find("good", TM_SURFACE, ""), &good);
  EXPECT_EQ(registry.find("good", TM_LIGHT, ""), nullptr);
  EXPECT_EQ(log.count("shader-plugin"), 2);
}

TEST_F(Plugins, AShaderWhoseParametersHaveAnotherSizeOrAFaultIsSkippedAndSaysWhy) {
  static rsl::FloatParam a("a", 1, ""), b("b", 2, "");
  static const rsl::Shader first(TM_SURFACE, "first", "", 0, looping, {&a, &b});
  static const rsl::Shader second(TM_SURFACE, "second", "", 0, looping, {&b});
  TmShader wide = *first;
  wide.paramBytes += 8;
  const TmShader* const shaders[] = {first, second, &wide};
  const TmShaderLibrary library = rsl::libraryOf(shaders);
  EXPECT_TRUE(registry.addLibrary(&library, "e.so"));
  EXPECT_EQ(registry.find("first", TM_SURFACE, ""), static_cast<const TmShader*>(first));
  EXPECT_EQ(registry.find("second", TM_SURFACE, ""), nullptr);
  ASSERT_EQ(log.count("shader-plugin"), 2);
  const std::string fault = log.entries()[0].message;
  EXPECT_NE(fault.find("shader \"second\" lists the parameter \"b\" at place 1, and shader \"first\" lists it at "
                       "place 2: give each a parameter of its own"),
            std::string::npos)
      << fault;
}

TEST_F(Plugins, AFileThatIsNoPluginIsRefusedWithAReason) {
  EXPECT_FALSE(registry.loadPlugin("/nowhere/absent.so"));
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(*log.entries()[0].where.file, "/nowhere/absent.so");
  EXPECT_NE(log.entries()[0].message.find("No such file"), std::string::npos);
}

// The example of the documentation, compiled as a user would: against the installed headers and nothing else.
TEST_F(Plugins, TheExamplePluginCompilesOutOfTreeAndShades) {
  const fs::path folder = test::temporary("tomales_example_plugin"), source = TOMALES_SOURCE_DIR;
  fs::remove_all(folder);
  installHeaders(folder / "include/tomales");
  const std::string command = std::string(TOMALES_CXX) + " -std=c++17 -Wall -Wextra -Werror -shared -fPIC -I" +
                              (folder / "include/tomales").string() + " -o " + (folder / "dots.so").string() + " " +
                              (source / "docs/example_plugin/dots.cpp").string();
  ASSERT_EQ(std::system(command.c_str()), 0) << command;

  ShaderRegistry trusting(log, {.folders = "/nowhere:" + folder.string()});
  EXPECT_NE(trusting.find("dots", TM_SURFACE, "/elsewhere"), nullptr);
  ShaderRegistry allowing(log, {.sceneFolders = true});
  EXPECT_NE(allowing.find("dots", TM_SURFACE, "/nowhere:" + folder.string()), nullptr);

  ASSERT_TRUE(registry.loadPlugin((folder / "dots.so").string()));
  surface("dots", {number("frequency", 2), number("Kd", 1), color("dotcolor", {0, 1, 0})});
  light("distantlight");
  ShadePoints p = points({vec3(0, 0, 5), vec3(0, 0, 5)});
  p.channel(kS)[0] = p.channel(kT)[0] = 0.25f;  // the middle of a dot
  p.channel(kS)[1] = p.channel(kT)[1] = 0.5f;   // the corner of a cell
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {0, 1, 0});
  expectColor(out.color(1), vec3(1));
  EXPECT_TRUE(system().group(0).opaque());
  EXPECT_EQ(log.entries().size(), 0u);
}

}  // namespace
}  // namespace tomales
