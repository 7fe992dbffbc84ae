// Every service of reyes/shader/services.h that gives values to points leaves those alone that are masked out.
#include <fstream>
#include <regex>
#include <set>

#include "places.h"
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

constexpr float kUntouched = -42;

/// One call, on a batch with a mask; what it gives to each point goes to `out`, or to `flags`.
struct Asked {
  const char* service;
  std::function<void(const TmServices&, void* host, const TmGrid*, TmVec3 out, uint8_t* flags)> call;
};

rsl::Vec3Array* axis = nullptr;   ///< (0, 0, -1) everywhere.
rsl::Array* oneNumber = nullptr;  ///< 0.1 everywhere.

const std::vector<Asked>& calls() {
#define TM_CALL(name, ...)                                                                       \
  {                                                                                              \
    name, [](const TmServices& call, [[maybe_unused]] void* h, [[maybe_unused]] const TmGrid* g, \
             [[maybe_unused]] TmVec3 out, [[maybe_unused]] uint8_t* flags) { __VA_ARGS__; }      \
  }
  static const std::vector<Asked> all = {
      TM_CALL("diffuse", call.diffuse(h, g, TM_ALL_LIGHT, *axis, out)),
      TM_CALL("specular", call.specular(h, g, *axis, *axis, oneNumber->data(), out)),
      TM_CALL("ambient", call.ambient(h, g, out)),
      TM_CALL("transform", call.transform(h, g, TM_AS_POINT, "current", "world", *axis, out)),
      TM_CALL("texture", call.texture(h, g, "absent.tif", nullptr, g->s, g->t, out)),
      TM_CALL("calculateNormal", call.calculateNormal(h, g, rsl::view(g->P), out)),
      TM_CALL("transmission", call.transmission(h, g, nullptr, rsl::view(g->P), *axis, out)),
      TM_CALL("indirectDiffuse", call.indirectDiffuse(h, g, *axis, out, nullptr)),
      TM_CALL("environment", call.environment(h, g, "absent.exr", nullptr, *axis, out)),
      TM_CALL("shadow", call.shadow(h, g, "absent.tif", nullptr, rsl::view(g->P), out)),
      TM_CALL("trace", call.trace(h, g, nullptr, rsl::view(g->P), *axis, out, nullptr)),
      TM_CALL("gather", call.gather(h, g, nullptr, rsl::view(g->P), *axis, 0, flags, nullptr, 0)),
      TM_CALL("occlusion",
              {
                TmOcclusion asked = tmOcclusionDefaults();
                asked.radiance = out;
                call.occlusion(h, g, nullptr, rsl::view(g->P), *axis, &asked);
              }),
      TM_CALL("rayInfo", call.rayInfo(h, g, "origin", out)),
      TM_CALL("lightDensity", call.lightDensity(h, g, 0, out.x)),
      TM_CALL("lightAlong", call.lightAlong(h, g, *axis, oneNumber->data(), 0, 1, out)),
      TM_CALL("stratified", call.stratified(h, g, 0, 1, out.x, out.y)),
      TM_CALL("crossed", call.crossed(h, g, 0, out.y, out.z, out.x)),
      TM_CALL("derivative", call.derivative(h, g, 0, g->s, out.x)),
      TM_CALL("illuminance",
              {
                TmIlluminance query = tmIlluminanceDefaults();
                query.axis = *axis;
                query.angle = 1.5f;
                ASSERT_TRUE(call.illuminance(h, g, &query));
                std::copy_n(query.lit, g->count, flags);
              }),
      TM_CALL("illuminance",
              {
                TmIlluminance query = tmIlluminanceDefaults();
                query.P = *axis;
                ASSERT_TRUE(call.illuminance(h, g, &query));
                std::copy_n(query.lit, g->count, flags);
              }),
      TM_CALL("texture",
              {
                TmTextureOptions options = tmTextureDefaults();
                for (const float*& side : options.region) side = oneNumber->data();
                call.texture(h, g, "absent.tif", &options, g->s, g->t, out);
              }),
      TM_CALL("texture3d", call.texture3d(h, g, "absent.ptc", nullptr, rsl::view(g->P), *axis, nullptr, 0, out.x)),
      TM_CALL("photonMap", call.photonMap(h, g, "absent.ptc", nullptr, rsl::view(g->P), *axis, out)),
      TM_CALL("subsurface", call.subsurface(h, g, "absent.ptc", nullptr, rsl::view(g->P), out)),
  };
#undef TM_CALL
  return all;
}

/// Services that give nothing to single points. The mask of bake3d is tested with the clouds.
const std::set<std::string> kOfTheWholeBatch{"report",      "rayLabel", "lobeSamples", "ask",
                                             "textureInfo", "bake3d",   "print"};

void maskedRun(const TmGrid* g) {
  std::vector<uint8_t> active(static_cast<size_t>(g->padded), 0);
  active[0] = active[2] = 1;
  TmGrid some = *g;
  some.active = active.data();
  rsl::Vec3Array toEye(g);
  rsl::Array tenth(g);
  for (int i = 0; i < g->count; ++i) {
    toEye.set(i, {0, 0, -1});
    tenth[i] = 0.1f;
  }
  axis = &toEye;
  oneNumber = &tenth;
  for (const Asked& asked : calls()) {
    rsl::Vec3Array out(g);
    std::vector<uint8_t> flags(static_cast<size_t>(g->padded), 0);
    for (int i = 0; i < g->count; ++i) out.set(i, {kUntouched, kUntouched, kUntouched});
    asked.call(*g->call, g->host, &some, out, flags.data());
    EXPECT_EQ(out[1].x, kUntouched) << asked.service;
    EXPECT_EQ(out[1].y, kUntouched) << asked.service;
    EXPECT_EQ(out[1].z, kUntouched) << asked.service;
    EXPECT_EQ(flags[1], 0) << asked.service;
    for (const int i : {0, 2})
      EXPECT_TRUE(out[i].x != kUntouched || flags[static_cast<size_t>(i)]) << asked.service << " gave nothing";
  }
  for (int i : rsl::Batch(g)) rsl::Batch(g).output(i, {1, 1, 1}, {1, 1, 1});
}
const rsl::Shader maskedRunShader(TM_SURFACE, "maskedrun", "", TM_TRACES | TM_DERIVATIVES, maskedRun, {});

class Masks : public Stage {};

TEST_F(Masks, AreObeyedByEveryService) {
  static const TmShader* const shaders[] = {maskedRunShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("maskedrun");
  light("ambientlight");
  light("distantlight");
  services.met = [](const vec3&, const vec3&) { return 1.0f; };
  shade(points({vec3(0, 0, 5), vec3(0, 0, 6), vec3(0, 0, 7)}));
}

TEST_F(Masks, AreTestedForEveryService) {
  std::ifstream file(std::string(TOMALES_SOURCE_DIR) + "/reyes/shader/services.h");
  const std::string header{std::istreambuf_iterator<char>(file), {}};
  std::set<std::string> there, tested = kOfTheWholeBatch;
  const std::regex service("\\(\\*(\\w+)\\)\\(void\\* host");
  for (std::sregex_iterator it(header.begin(), header.end(), service), end; it != end; ++it) there.insert((*it)[1]);
  for (const Asked& asked : calls()) tested.insert(asked.service);
  EXPECT_EQ(there.size(), (sizeof(TmServices) - offsetof(TmServices, transform)) / sizeof(void*));
  EXPECT_EQ(there, tested);
}

void wholeTable(const TmGrid* g) {
  const auto* call = reinterpret_cast<void* const*>(&g->call->transform);
  const auto* end = reinterpret_cast<void* const*>(g->call + 1);
  EXPECT_EQ(std::count(call, end, nullptr), 0) << "no call of the table is missing";
  EXPECT_EQ(g->call->structBytes, sizeof(TmServices));
  EXPECT_EQ(g->structBytes, sizeof(TmGrid));
}
const rsl::Shader wholeTableShader(TM_SURFACE, "wholetable", "", 0, wholeTable, {});

TEST_F(Masks, TheTableOfServicesHasNoHoles) {
  static const TmShader* const shaders[] = {wholeTableShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("wholetable");
  shadeOne();
}

}  // namespace
}  // namespace tomales
