// The standard shaders, written in RSL from their formulas (RISpec 3.2, appendix A): what they give, and what is found
// of them, is what the built-in ones of the same names give and declare.

#include <fstream>
#include <random>

#include "reyes/rsl.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/shade/written_picture.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

constexpr const char* kShaders = R"RSL(
surface constant() { Oi = Os; Ci = Os * Cs; }
surface matte(float Ka = 1, Kd = 1) {
  normal Nf = faceforward(normalize(N), I);
  Oi = Os;
  Ci = Os * Cs * (Ka * ambient() + Kd * diffuse(Nf));
}
surface metal(float Ka = 1, Ks = 1, roughness = .1) {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  Oi = Os;
  Ci = Os * Cs * (Ka * ambient() + Ks * specular(Nf, V, roughness));
}
surface shinymetal(float Ka = 1, Ks = 1, Kr = 1, roughness = .1; string texturename = "") {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I), D = reflect(normalize(I), Nf);
  color mirrored = 0;
  if (texturename != "") mirrored = color environment(texturename, D);
  Oi = Os;
  Ci = Os * Cs * (Ka * ambient() + Ks * specular(Nf, V, roughness) + Kr * mirrored);
}
surface plastic(float Ka = 1, Kd = .5, Ks = .5, roughness = .1; color specularcolor = 1) {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  Oi = Os;
  Ci = Os * (Cs * (Ka * ambient() + Kd * diffuse(Nf)) + specularcolor * Ks * specular(Nf, V, roughness));
}
surface paintedplastic(float Ka = 1, Kd = .5, Ks = .5, roughness = .1; color specularcolor = 1; string texturename = "") {
  normal Nf = faceforward(normalize(N), I);
  vector V = -normalize(I);
  color Ct = Cs;
  if (texturename != "") Ct = Cs * texture(texturename);
  Oi = Os;
  Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + specularcolor * Ks * specular(Nf, V, roughness));
}
light ambientlight(float intensity = 1; color lightcolor = 1) { Cl = intensity * lightcolor; }
light distantlight(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0);
                   point to = point "shader" (0, 0, 1)) {
  solar(to - from, 0) Cl = intensity * lightcolor;
}
light pointlight(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0)) {
  illuminate(from) Cl = intensity * lightcolor / (L . L);
}
light spotlight(float intensity = 1; color lightcolor = 1; point from = point "shader" (0, 0, 0);
                point to = point "shader" (0, 0, 1); float coneangle = radians(30), conedeltaangle = radians(5),
                beamdistribution = 2) {
  uniform vector A = (to - from) / length(to - from);
  uniform float cosoutside = cos(coneangle), cosinside = cos(coneangle - conedeltaangle);
  illuminate(from, A, coneangle) {
    float cosangle = (L . A) / length(L);
    float atten = pow(cosangle, beamdistribution) / (L . L);
    atten *= smoothstep(cosoutside, cosinside, cosangle);
    Cl = atten * intensity * lightcolor;
  }
}
volume fog(float distance = 1; color background = 0) {
  float d = 1 - exp(-length(I) / distance);
  Ci = mix(Ci, background, d);
  Oi = mix(Oi, color (1, 1, 1), d);
}
volume depthcue(float mindistance = 0, maxdistance = 1; color background = 0) {
  float d = clamp((depth(P) - mindistance) / (maxdistance - mindistance), 0, 1);
  Ci = mix(Ci, background, d);
  Oi = mix(Oi, color (1, 1, 1), d);
}
displacement bumpy(float Km = 1; string texturename = "") {
  float amp = 0;
  if (texturename != "") amp = Km * float texture(texturename, s, t);
  P += amp * normalize(N);
  N = calculatenormal(P);
}
)RSL";

/// Returns the name of a file of this process, since ctest runs several of these suites at once.
std::string ownFile(const char* ending) { return test::temporary(std::string("tomales_standard_shaders") + ending); }

/// A stage that stands by itself, so that a test may have two.
class Studio : public Stage {
 public:
  explicit Studio(bool written) {
    attributes.color = {0.8f, 0.5f, 0.3f};
    attributes.opacity = {0.9f, 0.6f, 1};
    attributes.displacementBound = 10;
    scene.options.projection = ProjectionKind::Perspective;
    scene.options.nearClip = 2;
    scene.options.farClip = 12;
    services.seen = [](const vec3& d) { return vec3(0.5f) + 0.5f * glm::normalize(d); };
    if (!written) return;
    const std::string path = ownFile(".sl");
    std::ofstream(path) << kShaders;
    const auto file = RslFile::compile(path, {});
    EXPECT_EQ(file->errors(), 0) << file->messages();
    EXPECT_EQ(file->warnings(), 0) << file->messages();
    EXPECT_TRUE(registry.addText(file, path));
  }
  void TestBody() override {}
  std::vector<LogEntry> told() const { return log.entries(); }
  const TmShader& shader(const std::string& name, TmKind kind) { return *registry.find(name, kind, ""); }

  void shine() {
    const Param intensity = number("intensity", 0.7f), tint = color("lightcolor", {1, 0.6f, 0.3f}),
                from = point("from", {2, -1, 1}), to = point("to", {0.5f, 0.5f, 6});
    light("ambientlight", {color("lightcolor", {0.1f, 0.2f, 0.05f})});
    light("distantlight", {intensity, tint, from, to});
    light("pointlight", {intensity, tint, from});
    light("spotlight", {intensity, tint, from, to, number("coneangle", 0.6f), number("conedeltaangle", 0.2f),
                        number("beamdistribution", 3)});
  }
  /// Normals of unit length are those of ray hits.
  ShadePoints somewhere(bool hits = false) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> number(-1, 1);
    const auto vector = [&] { return vec3(number(random), number(random), number(random)); };
    std::vector<vec3> P;
    for (int i = 0; i < 64; ++i) P.push_back(vec3(0.5f, 0.5f, 5) + vector());
    ShadePoints out = points(P);
    for (int i = 0; i < 64; ++i) {
      const vec3 any = 3.0f * vector() + vec3(0, 0, 0.1f), N = hits ? glm::normalize(any) : any;
      out.set3(kNx, i, N);
      out.set3(kNgx, i, glm::normalize(N));
      out.set3(kIx, i, 5.0f * vector() + vec3(0, 0.1f, 0));
    }
    return out;
  }
  ShadedPoints surfaceOf(const std::string& name, const ParamList& params, const ShadeContext& context = {}) {
    surface(name, params);
    shine();
    return shade(somewhere(context.kind == RayKind::Diffuse), context);
  }
  ShadedPoints volumeOf(const std::string& name, const ParamList& params) {
    surface("constant");
    attributes.atmosphere = std::make_shared<const ShaderCall>(call(name, params));
    ShadePoints p = somewhere();
    for (int i = 0; i < p.count(); ++i) p.set3(kIx, i, p.position(i));
    ShadedPoints out = shade(p);
    system().atmosphere(p, out);
    return out;
  }
  Grid displacedBy(const std::string& name, const ParamList& params) {
    displacement(name, params);
    constexpr int n = 8;
    Grid g;
    g.object = 0;
    g.allocate(n, n, 1, 0);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const int k = j * (n + 1) + i;
        const float u = static_cast<float>(i) / n, v = static_cast<float>(j) / n;
        g.P(0, 0)[k] = u;
        g.P(0, 1)[k] = 1 - v;
        g.P(0, 2)[k] = 5;
        g.N(2)[k] = -1;
        g.u()[k] = u;
        g.v()[k] = v;
      }
    system().displace(g);
    return g;
  }
};

/// A slope with a ripple.
std::string picture() {
  constexpr int n = 32;
  return writePicture(ownFile(".exr"), n, n, "RGB", [](int x, int y) {
    return std::array{0.02f * static_cast<float>(x), 0.01f * static_cast<float>(y), 0.25f};
  });
}

void expectSame(const ShadedPoints& is, const ShadedPoints& should) {
  float brightest = 0;
  for (int i = 0; i < 64; ++i) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(is.color(i)[k], should.color(i)[k], 1e-5f * (1 + should.color(i)[k])) << "point " << i;
      EXPECT_NEAR(is.opacity(i)[k], should.opacity(i)[k], 1e-6f);
    }
    brightest = std::max(brightest, should.color(i).x);
  }
  EXPECT_GT(brightest, 0.1f);
}

struct Named {
  const char* name;
  TmKind kind;
  ParamList params;
};

class StandardShaders : public ::testing::TestWithParam<Named> {};

TEST_P(StandardShaders, GiveWhatTheBuiltInOnesGive) {
  const auto& [name, kind, params] = GetParam();
  Studio written(true), builtIn(false);
  if (kind == TM_SURFACE) expectSame(written.surfaceOf(name, params), builtIn.surfaceOf(name, params));
  if (kind == TM_VOLUME) expectSame(written.volumeOf(name, params), builtIn.volumeOf(name, params));
  if (kind == TM_DISPLACEMENT) {
    const Grid is = written.displacedBy(name, params), should = builtIn.displacedBy(name, params);
    float moved = 0;
    for (int k = 0; k < is.vertexCount(); ++k) {
      expectColor(is.normal(k), should.normal(k));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(is.P(0, c)[k], should.P(0, c)[k], 1e-5f);
      moved = std::max(moved, std::abs(should.P(0, 2)[k] - 5));
    }
    EXPECT_GT(moved, 0.1f);
  }
  for (Studio* studio : {&written, &builtIn})
    for (const auto& entry : studio->told()) ADD_FAILURE() << entry.message;
}

// What is found is true: shaders that do not emit are black in the dark, those that are even look the same everywhere.
TEST_P(StandardShaders, AreFoundToBeWhatTheyAre) {
  const auto& [name, kind, params] = GetParam();
  if (kind != TM_SURFACE) return;
  const auto shaded = [&, name = name, params = params](Illumination light) {
    Studio studio(true);
    ShadeContext context;
    context.kind = RayKind::Diffuse;
    context.illumination = light;
    return studio.surfaceOf(name, params, context);
  };
  const uint32_t found = Studio(true).shader(name, kind).capabilities;
  const ShadedPoints dark = shaded(Illumination::None), even = shaded(Illumination::Unit);
  bool same = true;
  for (int i = 0; i < 64; ++i) {
    if (!(found & (TM_EMITS | TM_TRACES))) expectColor(dark.color(i), vec3(0), 0);
    for (int k = 0; k < 3; ++k) same = same && std::abs(even.color(i)[k] - even.color(0)[k]) < 1e-5f;
  }
  if (found & TM_EVEN) {
    EXPECT_TRUE(same);
  }
}

TEST_P(StandardShaders, AreFoundToBeWhatTheBuiltInOnesDeclare) {
  const auto& [name, kind, params] = GetParam();
  const uint32_t found = Studio(true).shader(name, kind).capabilities,
                 declared = Studio(false).shader(name, kind).capabilities;
  // What their authors did not care to declare.
  const uint32_t further = kind == TM_DISPLACEMENT ? TM_DERIVATIVES : TM_EVEN;
  EXPECT_EQ(found & ~further, declared & ~further);
  EXPECT_EQ(declared & ~found, 0u);
}

std::vector<Named> all() {
  const Param Ka = number("Ka", 0.4f), Kd = number("Kd", 0.9f), Ks = number("Ks", 0.6f),
              roughness = number("roughness", 0.3f), shine = color("specularcolor", {0.2f, 1, 0.7f}),
              map = text("texturename", picture()), background = color("background", {0.2f, 0.4f, 1});
  return {{"constant", TM_SURFACE, {}},
          {"matte", TM_SURFACE, {Ka, Kd}},
          {"metal", TM_SURFACE, {Ka, Ks, roughness}},
          {"shinymetal", TM_SURFACE, {Ka, Ks, roughness, number("Kr", 0.7f), text("texturename", "raytrace")}},
          {"plastic", TM_SURFACE, {Ka, Kd, Ks, roughness, shine}},
          {"paintedplastic", TM_SURFACE, {Ka, Kd, Ks, roughness, shine, map}},
          {"fog", TM_VOLUME, {number("distance", 10), background}},
          {"depthcue", TM_VOLUME, {number("mindistance", 0.1f), background}},
          {"bumpy", TM_DISPLACEMENT, {number("Km", -0.8f), map}}};
}
INSTANTIATE_TEST_SUITE_P(Of, StandardShaders, ::testing::ValuesIn(all()),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(StandardLights, AreFoundToBeWhatTheBuiltInOnesDeclare) {
  Studio written(true), builtIn(false);
  // TM_LIGHT_BOUNDED is a promise that no text tells.
  for (const char* name : {"ambientlight", "distantlight", "pointlight", "spotlight"})
    EXPECT_EQ(written.shader(name, TM_LIGHT).capabilities,
              builtIn.shader(name, TM_LIGHT).capabilities & ~TM_LIGHT_BOUNDED)
        << name;
}

}  // namespace
}  // namespace tomales
