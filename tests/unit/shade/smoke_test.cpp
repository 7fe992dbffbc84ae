// Light in the air: smoke that is marched along the ray from the eye, against closed forms.
#include "tests/unit/shade/remote_batch.h"

namespace tomales {
namespace {

using namespace sl;

class Smoke : public Elsewhere {};

/// `steps` places along the ray of a volume from its surface to the eye.
template <class Body>
void march(sl::Volume& v, int steps, const Body& body) {
  for (int i = 0; i < steps; ++i) body(Point(v.P - ((i + 0.5) / steps) * v.I));
}

TEST_F(Smoke, IndirectLightReachesSurfacesAndNotTheAir) {
  light("indirectlight");
  light("counting");
  services.E = vec3(1);
  int onSurfaces = 0, inAir = 0;
  asked(1, [&](sl::Surface& s) { s.illuminance(s.P + Vector(0, 1, 0), [&] { ++onSurfaces; }); });
  EXPECT_EQ(onSurfaces, 3 + 1) << "red, green, blue";
  attributes.atmosphere = std::make_shared<const ShaderCall>(call("between", {}));
  inVolume = [&](sl::Volume& v) {
    v.illuminance(v.P - 0.5 * v.I, [&] {
      ++inAir;
      for (const char* normal : {"normallength", "facetlength"}) {
        Float length = -1;
        lightsource(v.lightNumber, normal, length);
        EXPECT_EQ(length[0], 0) << normal << ": no surface is there";
      }
    });
  };
  ShadePoints p = points({vec3(0, 0, 5)});
  ShadedPoints out;
  out.resize(1);
  out.set(0, vec3(0), vec3(1));
  shading.reset();
  scene.objects.clear();
  scene.groups.clear();
  system().atmosphere(p, out);
  EXPECT_EQ(inAir, 1);
}

// As many ends of rays as points, and the same light at infinity: what shadow rays from the ends answer is not for the
// surface.
TEST_F(Smoke, WhatAnsweredToAVolumeIsNotRememberedOfTheSurface) {
  light("distantlight").castsShadows = true;
  attributes.exterior = std::make_shared<const ShaderCall>(call("between", {}));
  services.met = [](const vec3&, const vec3&) { return 3.0f; };
  services.visible = [](const vec3& P, const vec3&) { return P.z == 5 ? 1.0f : 0.0f; };
  inVolume = [](sl::Volume& v) { v.Ci += diffuse(Normal(0, 0, -1)); };
  RayAnswers answers;
  answers.recording = true;
  ShadeContext context;
  context.answers = &answers;
  const auto lit = [&] {
    return asked(
               2,
               [](sl::Surface& s) {
                 Color light;
                 s.illuminance(s.P, [&] { light += s.Cl; });
                 trace(s.P, Vector(0, 0, -1));
                 s.Ci = light;
               },
               context)
        .color(1);
  };
  expectColor(lit(), vec3(1));
  answers.recording = false;
  services.shadowRays = 0;
  expectColor(lit(), vec3(1));
  EXPECT_EQ(services.shadowRays, 2) << "those of the volume";
}

// A sky of radiance 1 is 4 pi of it, over pi, from all around; above a surface half of that counts, whatever the
// density of samples.
TEST_F(Smoke, TheAirIsLitByTheSkyFromAllSides) {
  light("environmentlight", {number("samples", 256)});
  float up = 0, down = 0;
  through(4, [&](sl::Volume& v) { v.illuminance(v.P - 0.5 * v.I, [&] { (v.L[0].z > 0 ? up : down) += v.Cl[0].x; }); });
  EXPECT_NEAR(up, 2, 0.02f);
  EXPECT_NEAR(down, 2, 0.02f);
}

// Light falls on a slab from the eye's side at an angle of cosine c: on the way to depth z it goes through z / c of
// smoke, and z of it on the way back: the integral of s exp(-s z (1 + 1/c)).
TEST_F(Smoke, ASlabOfSmokeScattersOnceAsBeerAndLambertSay) {
  constexpr float kDepth = 3, kSigma = 0.7f, kCosine = 0.8f;
  light("distantlight", {point("to", {0.6f, 0, 0.8f}), number("intensity", 2)});
  const vec3 seen = through(kDepth, [](sl::Volume& v) {
    constexpr int kSteps = 200;
    Color Cv;
    march(v, kSteps, [&](const Point& Q) {
      Color Li;
      v.illuminance(Q, [&] { Li += v.Cl * exp(-kSigma * zcomp(Q) / -zcomp(normalize(v.L))); });
      Cv += Li * (kSigma * exp(-kSigma * zcomp(Q)) * length(v.I) / kSteps);
    });
    v.Ci += Cv;
  });
  const float both = 1 + 1 / kCosine;
  EXPECT_NEAR(seen.x, 2 / both * (1 - std::exp(-kSigma * kDepth * both)), 2e-4f);
}

// Past a lamp at distance h the inverse square adds up to (atan(b / h) + atan(a / h)) / h.
TEST_F(Smoke, ALampInThinSmokeGlowsByTheInverseSquare) {
  constexpr float kDepth = 6, kBeside = 0.5f, kAt = 2;
  light("pointlight", {point("from", {kBeside, 0, kAt})});
  const vec3 seen = through(kDepth, [](sl::Volume& v) {
    constexpr int kSteps = 600;
    Color Cv;
    march(v, kSteps, [&](const Point& Q) { v.illuminance(Q, [&] { Cv += v.Cl * (length(v.I) / kSteps); }); });
    v.Ci += Cv;
  });
  EXPECT_NEAR(seen.x, (std::atan((kDepth - kAt) / kBeside) + std::atan(kAt / kBeside)) / kBeside, 1e-3f);
}

// A ball of radius 1 stands at z = 3 in the light: the smoke behind it stays dark for as long as its shadow is wide.
TEST_F(Smoke, ABallCastsAShadowThroughSmoke) {
  light("distantlight", {point("to", {0, -1, 0})}).castsShadows = true;
  services.visible = [](const vec3& P, const vec3& toward) {
    EXPECT_GT(toward.y, 0);
    return std::abs(P.z - 3) < 1 ? 0.0f : 1.0f;
  };
  const vec3 seen = through(6, [](sl::Volume& v) {
    Color Cv;
    march(v, 60, [&](const Point& Q) { v.illuminance(Q, [&] { Cv += v.Cl * (length(v.I) / 60); }); });
    v.Ci += Cv;
  });
  EXPECT_NEAR(seen.x, 4, 1e-4f);
}

}  // namespace
}  // namespace tomales
