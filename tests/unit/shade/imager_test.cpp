// What imagers know of their pixels.
#include "reyes/cloud_services.h"
#include "reyes/sl.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

/// Notes the radii of lookups.
class Radii : public CloudServices {
 public:
  std::vector<float> asked;
  bool lookUp(const CloudQuery& q, const std::vector<CloudValue>&, float*, std::string&) override {
    for (int i = 0; i < q.count; ++i) asked.push_back(q.radius[i]);
    return true;
  }
  bool bake(const CloudQuery&, const std::vector<CloudValue>&, std::string&) override {
    ADD_FAILURE() << "imagers bake nothing";
    return false;
  }
  bool photons(const CloudQuery&, const TmPhotonOptions&, TmVec3, std::string&) override { return false; }
  bool occlusion(const CloudQuery&, const DisksQuery&, float*, TmVec3, float*, std::string&) override { return false; }
  bool subsurface(const CloudQuery&, const TmSubsurfaceOptions&, TmVec3, std::string&) override { return false; }
};

void showParameters(const TmGrid* g) {
  for (int i : rsl::Batch(g)) rsl::set(g->Ci, i, {g->u[i], g->v[i], g->s[i] - g->u[i] + g->t[i] - g->v[i]});
}
void lookUpAndBake(const TmGrid* g) {
  rsl::Array found(g);
  TmCloudOptions own = tmCloudDefaults();
  std::vector<float> half(static_cast<size_t>(g->padded), 0.5f);
  g->call->texture3d(g->host, g, "some.ptc", nullptr, rsl::view(g->P), rsl::view(g->N), nullptr, 0, found.data());
  own.radius = half.data();
  own.radiusScale = 3;
  g->call->texture3d(g->host, g, "some.ptc", &own, rsl::view(g->P), rsl::view(g->N), nullptr, 0, found.data());
  g->call->bake3d(g->host, g, "some.ptc", nullptr, rsl::view(g->P), rsl::view(g->N), nullptr, 0);
}
const rsl::Shader parametersShader(TM_IMAGER, "parameters", "", 0, showParameters, {});
const rsl::Shader lookingShader(TM_IMAGER, "looking", "", 0, lookUpAndBake, {});

class Imagers : public Stage {
 protected:
  Imagers() {
    static const TmShader* const shaders[] = {parametersShader, lookingShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
  void imager(const std::string& name) {
    scene.options.imager = call(name, {});
    pixels.x = 10.5f;
    pixels.y = 3.5f;
    pixels.count = 4;
    pixels.colors.resize(4);
    pixels.alpha.assign(pixels.colors.Ci[0].size(), 1.0f);
  }
  ShadedPixels pixels;
};

TEST_F(Imagers, HaveParametersThatRunOverThePicture) {
  scene.options.xResolution = 40;
  scene.options.yResolution = 20;
  imager("parameters");
  system().image(pixels);
  for (int i = 0; i < 4; ++i)
    expectColor(pixels.colors.color(i), {(10.5f + static_cast<float>(i)) / 40, 3.5f / 20, 0}, 1e-6f);
}

TEST_F(Imagers, LookUpCloudsAtPointsWithoutAWidthAndBakeNothing) {
  imager("looking");
  Radii clouds;
  system().setClouds(&clouds);
  system().image(pixels);
  const size_t n = 4;  // and none in the padding of a row
  ASSERT_EQ(clouds.asked.size(), 2 * n);
  for (size_t i = 0; i < 2 * n; ++i) EXPECT_NEAR(clouds.asked[i], i < n ? 0 : 1.5f, 1e-5f);
  EXPECT_TRUE(log.entries().empty());
}

}  // namespace
}  // namespace tomales
