// The standard surfaces under all standard lights at once, at random points, against the formulas of RISpec 3.2,
// appendix A, written out in double precision. Imagers, volumes and displacements have tests beside those of their
// stage.
#include <array>
#include <random>

#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

using D3 = glm::dvec3;

struct Point {
  D3 P, N, I;
};
struct LightAt {
  D3 L, Cl;
};

constexpr double kIntensity = 0.7;
const D3 kTint{1, 0.6, 0.3}, kFrom{2, -1, 1}, kTo{0.5, 0.5, 6}, kAmbient{0.1, 0.2, 0.05};

/// The lights of Standard below, as the table has them.
std::vector<LightAt> lights(const Point& p) {
  const D3 axis = glm::normalize(kTo - kFrom), L = kFrom - p.P;
  const double d2 = dot(L, L), c = dot(-L, axis) / std::sqrt(d2), outer = std::cos(0.6), inner = std::cos(0.6 - 0.2);
  const double t = std::clamp((c - outer) / (inner - outer), 0.0, 1.0),
               spot = c > outer ? std::pow(c, 3.0) / d2 * t * t * (3 - 2 * t) : 0.0;
  return {{-axis, kIntensity * kTint}, {L, kIntensity / d2 * kTint}, {L, kIntensity * spot * kTint}};
}
D3 diffuse(const Point& p, const D3& N) {
  D3 sum(0);
  for (const LightAt& l : lights(p)) sum += l.Cl * std::max(0.0, dot(glm::normalize(l.L), N));
  return sum;
}
D3 specular(const Point& p, const D3& N, double roughness) {
  D3 sum(0);
  for (const LightAt& l : lights(p)) {
    const D3 L = glm::normalize(l.L), H = glm::normalize(L - glm::normalize(p.I));
    if (dot(L, N) > 0) sum += l.Cl * std::pow(std::max(0.0, dot(N, H)), 8 / roughness);
  }
  return sum;
}
D3 facing(const Point& p) { return glm::normalize(p.N) * (dot(p.N, p.I) > 0 ? -1.0 : 1.0); }
/// What rays see.
D3 world(const D3& direction) { return D3(0.5) + 0.5 * direction; }

class Standard : public Stage {
 protected:
  static constexpr int kPoints = 64;
  const D3 Cs{0.8, 0.5, 0.3}, Os{0.9, 0.6, 1};

  Standard() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return D3(any(random), any(random), any(random)); };
    for (int i = 0; i < kPoints; ++i)
      at.push_back({D3(0.5, 0.5, 5) + vector(), 3.0 * vector() + D3(0, 0, 0.1), 5.0 * vector() + D3(0, 0.1, 0)});
    attributes.color = vec3(Cs);
    attributes.opacity = vec3(Os);
    services.seen = [](const vec3& d) { return vec3(world(glm::normalize(D3(d)))); };
  }
  static Param tint(const char* name, const D3& c) { return color(name, vec3(c)); }
  void shine() {
    const Param intensity = number("intensity", float(kIntensity)), lightcolor = tint("lightcolor", kTint),
                from = point("from", vec3(kFrom)), to = point("to", vec3(kTo));
    light("ambientlight", {tint("lightcolor", kAmbient)});
    light("distantlight", {intensity, lightcolor, from, to});
    light("pointlight", {intensity, lightcolor, from});
    light("spotlight", {intensity, lightcolor, from, to, number("coneangle", 0.6f), number("conedeltaangle", 0.2f),
                        number("beamdistribution", 3)});
  }
  void expect(const std::function<D3(const Point&)>& radiance) {
    shine();
    std::vector<vec3> P;
    for (const Point& p : at) P.emplace_back(p.P);
    ShadePoints batch = points(P);
    for (int i = 0; i < kPoints; ++i) {
      const Point& p = at[static_cast<size_t>(i)];
      batch.set3(kNx, i, vec3(p.N));
      batch.set3(kNgx, i, vec3(glm::normalize(p.N)));
      batch.set3(kIx, i, vec3(p.I));
    }
    const ShadedPoints out = shade(batch);
    for (int i = 0; i < kPoints; ++i) {
      const D3 truth = Os * radiance(at[static_cast<size_t>(i)]);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(out.color(i)[k], truth[k], 2e-5 * (1 + truth[k])) << "point " << i << " channel " << k;
      expectColor(out.opacity(i), vec3(Os), 0);
    }
    EXPECT_TRUE(log.entries().empty());
  }
  std::vector<Point> at;
};

TEST_F(Standard, ConstantIsItsFormula) {
  surface("constant");
  expect([&](const Point&) { return Cs; });
}

TEST_F(Standard, DefaultsurfaceNeedsNoLight) {
  surface("defaultsurface", {number("Ka", 0.3f), number("Kd", 0.6f)});
  expect([&](const Point& p) { return Cs * (0.3 + 0.6 * std::fabs(dot(glm::normalize(p.N), glm::normalize(p.I)))); });
}

TEST_F(Standard, MatteIsItsFormula) {
  surface("matte", {number("Ka", 0.4f), number("Kd", 0.9f)});
  expect([&](const Point& p) { return Cs * (0.4 * kAmbient + 0.9 * diffuse(p, facing(p))); });
}

TEST_F(Standard, MetalIsItsFormula) {
  surface("metal", {number("Ka", 0.4f), number("Ks", 0.9f), number("roughness", 0.5f)});
  expect([&](const Point& p) { return Cs * (0.4 * kAmbient + 0.9 * specular(p, facing(p), 0.5)); });
}

TEST_F(Standard, ShinymetalMayMirrorTheSceneItself) {
  surface("shinymetal", {number("Ka", 0.4f), number("Ks", 0.9f), number("Kr", 0.7f), number("roughness", 0.5f),
                         text("texturename", "raytrace")});
  expect([&](const Point& p) {
    const D3 R = glm::reflect(glm::normalize(p.I), facing(p));
    return Cs * (0.4 * kAmbient + 0.9 * specular(p, facing(p), 0.5) + 0.7 * world(R));
  });
}

TEST_F(Standard, ShinymetalWithoutAMapIsMetal) {
  surface("shinymetal", {number("Ka", 0.4f), number("roughness", 0.5f)});
  expect([&](const Point& p) { return Cs * (0.4 * kAmbient + specular(p, facing(p), 0.5)); });
}

TEST_F(Standard, PlasticIsItsFormula) {
  surface("plastic", {number("Ka", 0.4f), number("Kd", 0.9f), number("Ks", 0.6f), number("roughness", 0.3f),
                      tint("specularcolor", {0.2, 1, 0.7})});
  expect([&](const Point& p) {
    return Cs * (0.4 * kAmbient + 0.9 * diffuse(p, facing(p))) + 0.6 * D3(0.2, 1, 0.7) * specular(p, facing(p), 0.3);
  });
}

TEST_F(Standard, PlasticHasTheDefaultsOfTheTableAndPaintedplasticWithoutAPictureIsPlastic) {
  for (const char* name : {"plastic", "paintedplastic"}) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    attributes.lights.clear();
    surface(name);
    expect([&](const Point& p) {
      return Cs * (kAmbient + 0.5 * diffuse(p, facing(p))) + 0.5 * specular(p, facing(p), 0.1);
    });
  }
}

TEST_F(Standard, MirrorSeesTheWorldReflected) {
  surface("mirror", {number("Kr", 0.8f), tint("specularcolor", {1, 0.9, 0.5})});
  expect([&](const Point& p) { return 0.8 * D3(1, 0.9, 0.5) * world(glm::reflect(glm::normalize(p.I), facing(p))); });
}

// By the angles of Snell's law and the amplitudes of both polarisations.
TEST_F(Standard, GlassReflectsAndRefractsAsFresnelSays) {
  surface("glass", {number("eta", 1.4f), number("Kr", 0.9f), number("Kt", 0.8f), tint("transmitcolor", {0.5, 1, 0.8})});
  expect([&](const Point& p) {
    const D3 I = glm::normalize(p.I), N = facing(p);
    const double eta = dot(p.N, p.I) < 0 ? 1 / 1.4 : 1.4, i = std::acos(-dot(I, N)), sine = eta * std::sin(i);
    const D3 R = world(glm::reflect(I, N));
    if (sine >= 1) return 0.9 * R;
    const double t = std::asin(sine), rs = std::sin(i - t) / std::sin(i + t), rp = std::tan(i - t) / std::tan(i + t),
                 F = (rs * rs + rp * rp) / 2;
    const D3 T = -std::cos(t) * N + eta * (I - dot(I, N) * N);
    return 0.9 * F * R + 0.8 * (1 - F) * D3(0.5, 1, 0.8) * world(T);
  });
}

TEST_F(Standard, ShadowedLightsWithoutAMapAreTheirPlainSelves) {
  const ParamList place{point("from", vec3(kFrom)), point("to", vec3(kTo))}, from{point("from", vec3(kFrom))};
  surface("matte");
  for (const auto& [plain, shadowed, params] : {std::tuple{"spotlight", "shadowspot", place},
                                                {"pointlight", "shadowpoint", from},
                                                {"distantlight", "shadowdistant", place}}) {
    vec3 seen[2];
    for (const int k : {0, 1}) {
      shading.reset();
      scene.objects.clear();
      scene.lights.clear();
      attributes.lights.clear();
      light(k == 0 ? plain : shadowed, params);
      seen[k] = shade(points({vec3(0.5f, 0.4f, 5)}, glm::normalize(vec3(1, -1, -2)))).color(0);
    }
    EXPECT_EQ(seen[0], seen[1]) << shadowed;
    EXPECT_GT(seen[0].x, 0) << shadowed;
  }
}

}  // namespace
}  // namespace tomales
