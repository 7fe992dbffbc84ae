#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "reyes/sl.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/shade/written_picture.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

// P.z -= 0.1 x, then the normal of the tilted plane.
void tilting(const TmGrid* g) {
  for (int i : rsl::Batch(g)) g->P.z[i] -= 0.1f * g->P.x[i];
  g->call->calculateNormal(g->host, g, rsl::view(g->P), g->N);
}
// Raises P only; RSL leaves N as it was.
void raising(const TmGrid* g) {
  for (int i : rsl::Batch(g)) g->P.z[i] -= 0.25f;
}
// Tells du, dv and the derivatives of P by where it puts P.
void measuring(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    const float along = g->dPdu.x[i] * g->du[i], across = g->dPdv.y[i] * g->dv[i];
    g->P.x[i] = g->du[i];
    g->P.y[i] = g->dv[i];
    g->P.z[i] = 5 + along + 2 * across;
  }
}
struct rough : sl::Displacement {
  void main() { P -= random() * sl::Vector(0, 0, 1); }
};
const rsl::Shader roughShader(TM_DISPLACEMENT, "rough", "", 0, sl::shade<rough>, {});
const rsl::Shader measuringShader(TM_DISPLACEMENT, "measuring", "", TM_DERIVATIVES, measuring, {});
const rsl::Shader tiltingShader(TM_DISPLACEMENT, "tilting", "", 0, tilting, {});
const rsl::Shader raisingShader(TM_DISPLACEMENT, "raising", "", 0, raising, {});

class Displacement : public Stage {
 protected:
  Displacement() {
    static const TmShader* const shaders[] = {tiltingShader, raisingShader, roughShader, measuringShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    attributes.displacementBound = 10;
  }

  /// The plane z = 5 over [0,1]^2, v upside down so that its normal is -z; a second motion key 1 to the
  /// right.
  static Grid plane(int n = 8) {
    Grid g;
    g.object = 0;
    g.allocate(n, n, 2, 0);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const int k = j * (n + 1) + i;
        const float u = static_cast<float>(i) / static_cast<float>(n),
                    v = static_cast<float>(j) / static_cast<float>(n);
        for (int key = 0; key < 2; ++key) {
          g.P(key, 0)[k] = u + static_cast<float>(key);
          g.P(key, 1)[k] = 1 - v;
          g.P(key, 2)[k] = 5;
        }
        g.N(2)[k] = -1;
        g.u()[k] = u;
        g.v()[k] = v;
      }
    return g;
  }
};

TEST_F(Displacement, MovesPointsOfEveryMotionKeyAndCalculatesTheNormal) {
  displacement("tilting");
  Grid g = plane();
  system().displace(g);
  const vec3 N = glm::normalize(vec3(-0.1f, 0, -1));
  for (int k = 0; k < g.vertexCount(); ++k) {
    const float x = g.P(0, 0)[k];
    EXPECT_NEAR(g.P(0, 2)[k], 5 - 0.1f * x, 1e-6f);
    EXPECT_NEAR(g.P(1, 2)[k], 5 - 0.1f * x, 1e-6f);
    expectColor(g.normal(k), N, 1e-5f);
  }
  EXPECT_TRUE(g.displaced);
  EXPECT_EQ(stats.byShader().at("tilting").vertices, g.vertexCount());
}

TEST_F(Displacement, KnowsHowParametersAndPlacesChangeOverAMicropolygon) {
  displacement("measuring");
  Grid g = plane(8);
  system().displace(g);
  for (int k = 0; k < g.vertexCount(); ++k) {
    EXPECT_FLOAT_EQ(g.P(0, 0)[k], 0.125f);
    EXPECT_FLOAT_EQ(g.P(0, 1)[k], 0.125f);
    EXPECT_NEAR(g.P(0, 2)[k], 5 + 0.125f - 0.25f, 1e-6f) << "y falls as v grows";
  }
}

TEST_F(Displacement, LeavesTheNormalToTheShader) {
  displacement("raising");
  Grid g = plane();
  system().displace(g);
  EXPECT_FLOAT_EQ(g.P(0, 2)[3], 4.75f);
  EXPECT_EQ(g.normal(3), vec3(0, 0, -1));
}

TEST_F(Displacement, RandomNumbersGoByThePlaceOnTheObject) {
  displacement("rough");
  Grid fine = plane(8), coarse = plane(4);
  system().displace(fine);
  system().displace(coarse);
  std::set<float> heights;
  float mean = 0;
  for (int k = 0; k < 81; ++k) {
    heights.insert(fine.P(0, 2)[k]);
    mean += (5 - fine.P(0, 2)[k]) / 81;
  }
  EXPECT_GT(heights.size(), 78u) << "each vertex has its own";
  EXPECT_NEAR(mean, 0.5f, 0.13f) << "four standard deviations";
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i)
      EXPECT_EQ(coarse.P(0, 2)[j * 5 + i], fine.P(0, 2)[2 * j * 9 + 2 * i]) << "whatever the grid";
}

TEST_F(Displacement, WithoutAShaderNothingHappens) {
  Grid g = plane();
  system().displace(g);
  EXPECT_FALSE(g.displaced);
  EXPECT_EQ(g.P(0, 2)[0], 5);
}

TEST_F(Displacement, BeyondItsBoundIsWarnedAboutOnceAnObject) {
  attributes.displacementBound = 0.125f;
  worldFromObject = Motion::still(glm::scale(mat4(1.0f), vec3(0.5f)));
  displacement("raising");
  Grid a = plane(), b = plane();
  system().displace(a);
  system().displace(b);
  ASSERT_EQ(log.entries().size(), 1u);
  const LogEntry e = log.entries()[0];
  EXPECT_EQ(e.count, 2);
  EXPECT_EQ(e.where.line, 9);
  EXPECT_NE(e.message.find("\"sphere\" 0.5 "), std::string::npos)
      << e.message;  // 0.25 camera units, object scaled by half
}

TEST_F(Displacement, BumpyRaisesByItsTexture) {
  const std::string path =
      writePicture(test::temporary("tomales_shade_heights.exr"), 4, 4, "Y", [](int, int) { return std::array{0.5f}; });
  displacement("bumpy", {number("Km", 0.5f), text("texturename", path)});
  Grid g = plane();
  system().displace(g);
  const int middle = g.vertexCount() / 2;
  EXPECT_NEAR(g.P(0, 2)[middle], 4.75f, 1e-6f);
}

TEST_F(Displacement, NoisyBumpStaysWithinKmVariesAndRepeats) {
  displacement("noisybump", {number("Km", 0.2f), number("frequency", 5), number("octaves", 3)});
  Grid a = plane(32), b = plane(32);
  system().displace(a);
  system().displace(b);
  float lo = 9, hi = 0;
  for (int k = 0; k < a.vertexCount(); ++k) {
    lo = std::min(lo, a.P(0, 2)[k]);
    hi = std::max(hi, a.P(0, 2)[k]);
    ASSERT_EQ(a.position(0, k), b.position(0, k));
  }
  EXPECT_GE(lo, 4.8f);
  EXPECT_LE(hi, 5.2f);
  EXPECT_GT(hi - lo, 0.1f);
}

TEST(Noise, IsZeroOnTheLatticeBoundedAndContinuous) {
  EXPECT_EQ(rsl::signedNoise({3, -2, 7}), 0);
  for (int k = 0; k < 2000; ++k) {
    const rsl::Vec3 p{0.37f * static_cast<float>(k) - 300, 0.11f * static_cast<float>(k),
                      -0.73f * static_cast<float>(k)};
    const float n = rsl::noise(p), m = rsl::noise(p + rsl::Vec3{1e-3f, 0, 0});
    ASSERT_GE(n, 0);
    ASSERT_LE(n, 1);
    ASSERT_NEAR(n, m, 4e-3f);
  }
  EXPECT_TRUE(std::isfinite(rsl::noise({1e30f, -1e30f, 0})));
}

// --- Named spaces
// -------------------------------------------------------------------------------------------------

// Ci: P in `there`; Oi: that, back in current.
rsl::StringParam there("there", "world", "a space");
rsl::FloatParam kind("kind", 0, "TmTransformKind");
void travelling(const TmGrid* g) {
  const auto k = static_cast<int32_t>(kind(g, 0));
  g->call->transform(g->host, g, k, "current", there(g), rsl::view(g->P), g->Ci);
  g->call->transform(g->host, g, k, there(g), "current", rsl::view(g->Ci), g->Oi);
}
const rsl::Shader travellingShader(TM_SURFACE, "travelling", "", 0, travelling, {&there, &kind});

// Ci: the right upper corner of the picture in screen space; Oi: its centre in current space.
void cornering(const TmGrid* g) {
  for (int i = 0; i < g->count; ++i) {
    rsl::set(g->Ci, i, {1, 0, 0});
    rsl::set(g->Oi, i, {0.5f, 0.5f, 0});
  }
  g->call->transform(g->host, g, TM_AS_POINT, "NDC", "screen", rsl::view(g->Ci), g->Ci);
  g->call->transform(g->host, g, TM_AS_POINT, "NDC", "current", rsl::view(g->Oi), g->Oi);
}
const rsl::Shader corneringShader(TM_SURFACE, "cornering", "", 0, cornering, {});

class Spaces : public Stage {
 protected:
  Spaces() {
    static const TmShader* const shaders[] = {travellingShader, corneringShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    scene.options.projection = ProjectionKind::Perspective;
    scene.options.xResolution = 200;
    scene.options.yResolution = 100;
    scene.cameraFromWorld = Motion::still(glm::translate(mat4(1.0f), vec3(0, 0, 3)));
    worldFromObject = Motion::still(glm::scale(mat4(1.0f), vec3(1, 2, 4)));
    scene.worldFromNamed["here"] = glm::rotate(mat4(1.0f), 1.0f, glm::normalize(vec3(1, 2, 3)));
  }
  /// (1, 2, 5) of current in a space, having checked the way back.
  vec3 travel(const std::string& space, TmTransformKind as = TM_AS_POINT) {
    surface("travelling", {text("there", space), number("kind", static_cast<float>(as))});
    shading.reset();
    scene.objects.clear();
    const ShadedPoints out = shade(points({vec3(1, 2, 5)}));
    expectColor(out.opacity(0), {1, 2, 5}, 1e-4f);
    return out.color(0);
  }
};

TEST_F(Spaces, EveryNamedSpaceHasAWayThereAndBack) {
  expectColor(travel("camera"), {1, 2, 5});
  expectColor(travel("world"), {1, 2, 2});
  expectColor(travel("shader"), {1, 2, 2});
  expectColor(travel("object"), {1, 1, 0.5f});
  expectColor(travel("here"), glm::transpose(mat3(scene.worldFromNamed["here"])) * vec3(1, 2, 2));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Spaces, VectorsIgnoreTranslationAndNormalsTakeTheInverseTranspose) {
  expectColor(travel("world", TM_AS_VECTOR), {1, 2, 5});
  expectColor(travel("object", TM_AS_VECTOR), {1, 1, 1.25f});
  expectColor(travel("object", TM_AS_NORMAL), {1, 4, 20});
}

TEST_F(Spaces, ProjectedSpacesKeepCameraDepth) {
  expectColor(travel("raster"), {100 + 0.2f * 50, 50 - 0.4f * 50, 5}, 1e-3f);
  expectColor(travel("NDC"), {0.55f, 0.3f, 5});
  expectColor(travel("screen"), {0.2f, 0.4f, 5});
}

// RISpec table 4.1: z is 0 at the near clipping plane. Lens flares ask for the corners of the picture in this way.
TEST_F(Spaces, AProjectedPointOfDepthZeroLiesOnTheNearPlane) {
  surface("cornering", {});
  const ShadedPoints out = shade(points({vec3(1, 2, 5)}));
  expectColor(out.color(0), {2, 1, scene.options.nearClip}, 1e-4f);  // the screen window of 200 x 100 pixels
  expectColor(out.opacity(0), {0, 0, scene.options.nearClip}, 1e-4f);
}

TEST_F(Spaces, AnUnknownSpaceCopies) { expectColor(travel("nowhere"), {1, 2, 5}); }

}  // namespace
}  // namespace tomales
