// How many directions of its own a surface is told to draw.
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

int told = -1;
void countingLobes(const TmGrid* g) { told = g->call->lobeSamples(g->host, g); }
const rsl::Shader lobeCounterShader(TM_SURFACE, "counting", "", 0, countingLobes, {});

int neighbours = 0, unlike = 0;
/// Counts the neighbours whose light along a direction is not that of their point.
void spreading(const TmGrid* g) {
  rsl::Vec3Array L(g), Cl(g);
  rsl::Array pdf(g);
  for (int i : rsl::Batch(g)) {
    L.set(i, {0.1f, 0, -1});
    Cl.set(i, {-42, -42, -42});
    pdf[i] = 1;
  }
  g->call->lightAlong(g->host, g, rsl::view(L), pdf.data(), 0, 1, Cl);
  const int points = g->count / 5;
  for (int i = points; i < g->count; ++i) {
    ++neighbours;
    unlike += Cl[i].x != Cl[i % points].x || Cl[i].x == -42;
  }
}
const rsl::Shader spreadingShader(TM_SURFACE, "spreading", "", TM_NEIGHBOURS, spreading, {});

class LobeSamples : public Stage {
 protected:
  LobeSamples() {
    static const TmShader* const shaders[] = {lobeCounterShader, spreadingShader};
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

TEST_F(LobeSamples, BringNeighboursTheLightOfTheirPoint) {
  surface("spreading");
  light("environmentlight");
  const ShadePoints narrow = points({vec3(0, 0, 5), vec3(1, 0, 5), vec3(2, 0, 5)});
  ShadePoints wide(0, 0, true);
  for (int i = 0; i < narrow.count(); ++i) {
    wide.add(narrow.key(i));
    for (int c = 0; c < narrow.channelCount(); ++c) wide.channel(c)[i] = narrow.channel(c)[i];
  }
  shade(wide);
  EXPECT_EQ(neighbours, 12);
  EXPECT_EQ(unlike, 0);
}

}  // namespace
}  // namespace tomales
