// How many directions of its own a surface is told to draw.
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

int told = -1;
void countingLobes(const TmGrid* g) { told = g->call->lobeSamples(g->host, g); }
const rsl::Shader lobeCounterShader(TM_SURFACE, "counting", "", 0, countingLobes, {});

class LobeSamples : public Stage {
 protected:
  LobeSamples() {
    static const TmShader* const shaders[] = {lobeCounterShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    surface("counting");
  }
  int samples() {
    told = -1;
    shadeOne();
    return told;
  }
};

TEST_F(LobeSamples, AreNoneIfNoLightHasAnExtent) {
  light("distantlight");
  light("pointlight");
  light("ambientlight");
  EXPECT_EQ(samples(), 0);
}

TEST_F(LobeSamples, AreHalfOfThoseOfTheLightThatHasMost) {
  light("arealight", {number("samples", 4)}, true);
  light("arealight", {number("samples", 9)}, true);
  EXPECT_EQ(samples(), 5);
}

TEST_F(LobeSamples, CountNoLightThatHighlightsLeaveOutOrThatIsOff) {
  light("arealight", {number("samples", 4)}, true);
  light("arealight", {number("samples", 9), number("__nonspecular", 1)}, true);
  light("arealight", {number("samples", 16)}, true);
  attributes.lights.switchOff(2);
  EXPECT_EQ(samples(), 2);
}

std::vector<float> densities;
void askDensities(const TmGrid* g) {
  densities.clear();
  rsl::Array density(g);
  for (TmIlluminance sample = tmIlluminanceDefaults(); g->call->illuminance(g->host, g, &sample);) {
    g->call->lightDensity(g->host, g, sample.light, density.data());
    densities.push_back(density[0]);
  }
  g->call->lightDensity(g->host, g, 1000, density.data());
  densities.push_back(density[0]);
}
const rsl::Shader densityShader(TM_SURFACE, "density", "", 0, askDensities, {});

TEST_F(LobeSamples, OfALampWithoutExtentHaveNoDensityNorHasALampThatThereIsNot) {
  static const TmShader* const shaders[] = {densityShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("density");
  light("distantlight");
  light("environmentlight", {number("samples", 1)});
  shadeOne();
  ASSERT_EQ(densities.size(), 3u);
  EXPECT_EQ(densities[0], 0);
  EXPECT_GT(densities[1], 0);
  EXPECT_EQ(densities[2], 0);
}

}  // namespace
}  // namespace tomales
