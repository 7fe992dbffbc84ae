// Light that diffuses through a body: against closed forms, published reflectances, and sums over all points.
#include "gi/clouds/diffusion.h"

#include <gtest/gtest.h>

#include "gi/clouds.h"
#include "gi/point_file.h"
#include "reyes/base/rng.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

constexpr float kPlain = 0.1f;  ///< Spacing of the points of plane(), in mm.

/// A square plane of points around the origin, all lit alike.
PointCloud plane(int n, const vec3& light) {
  PointCloud cloud;
  cloud.channels = {{"_area", 1}, {"_radiance_t", 3}};
  for (int i = 0; i < n * n; ++i) {
    const vec2 p =
        kPlain * (vec2(static_cast<float>(i % n), static_cast<float>(i / n)) - 0.5f * static_cast<float>(n - 1));
    const float values[4] = {kPlain * kPlain, light.x, light.y, light.z};
    cloud.add({p, 0}, {0, 0, 1}, kPlain, values);
  }
  return cloud;
}

/// Rd as the paper writes it, for one wavelength, in double precision.
double publishedRd(double r, double scattering, double absorption, double ior) {
  const double Fdr = -1.440 / (ior * ior) + 0.710 / ior + 0.668 + 0.0636 * ior, A = (1 + Fdr) / (1 - Fdr);
  const double extinction = scattering + absorption, tr = std::sqrt(3 * absorption * extinction),
               D = 1 / (3 * extinction);
  const double zr = 1 / extinction, zv = zr + 4 * A * D, dr = std::sqrt(r * r + zr * zr),
               dv = std::sqrt(r * r + zv * zv);
  return scattering / extinction / (4 * M_PI) *
         (zr * (tr * dr + 1) * std::exp(-tr * dr) / (dr * dr * dr) +
          zv * (tr * dv + 1) * std::exp(-tr * dv) / (dv * dv * dv));
}

TEST(Dipole, FollowsThePublishedFormulaAtEveryDistance) {
  const Dipole marble(*translucencyOf("marble"));
  for (const double r : {0.0, 0.2, 1.0, 5.0, 20.0}) {
    const vec3 Rd = marble.exitance(static_cast<float>(r * r));
    EXPECT_NEAR(Rd.x, publishedRd(r, 2.19, 0.0021, 1.5), 1e-4 * Rd.x);
    EXPECT_NEAR(Rd.z, publishedRd(r, 3.00, 0.0071, 1.5), 1e-4 * Rd.z);
  }
}

// Figure 5 of the paper has a column of diffuse reflectances, which were measured with the coefficients.
TEST(Dipole, MeasuredMaterialsReflectAsMuchAsThePaperSays) {
  const struct {
    const char* name;
    vec3 reflectance;
  } published[] = {{"apple", {.85, .84, .53}},  {"chicken1", {.31, .15, .10}}, {"chicken2", {.32, .16, .10}},
                   {"cream", {.98, .90, .73}},  {"ketchup", {.16, .01, .00}},  {"marble", {.83, .79, .75}},
                   {"potato", {.77, .62, .21}}, {"skimmilk", {.81, .81, .69}}, {"skin1", {.44, .22, .13}},
                   {"skin2", {.63, .44, .34}},  {"spectralon", {1, 1, 1}},     {"wholemilk", {.91, .88, .76}}};
  for (const auto& m : published) {
    ASSERT_TRUE(translucencyOf(m.name)) << m.name;
    const vec3 ours = Dipole(*translucencyOf(m.name)).reflectance();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(ours[k], m.reflectance[k], 0.08) << m.name << " " << k;
  }
  EXPECT_FALSE(translucencyOf("granite"));
}

TEST(Dipole, AnAlbedoThatIsAskedForIsReflected) {
  const vec3 albedo(0.8f, 0.5f, 0.1f), path(2, 1, 0.5f);
  const Translucency m = translucencyOf(albedo, path, 1.4f);
  const vec3 reflectance = Dipole(m).reflectance();
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(reflectance[k], albedo[k], 1e-4f);
    EXPECT_NEAR(1 / std::sqrt(3 * m.absorption[k] * (m.absorption[k] + m.scattering[k])), path[k], 1e-4f * path[k]);
  }
}

TEST(Diffusion, AWideEvenlyLitPlaneReflectsTheAlbedoOfItsMaterial) {
  const Dipole dipole(translucencyOf({0.8f, 0.5f, 0.2f}, vec3(1.0f), 1.3f));
  const vec3 light = Diffusion(plane(161, {1, 2, 3})).at(vec3(0), dipole, 1, 0.1f);
  EXPECT_NEAR(light.x, 0.8f, 0.01f);
  EXPECT_NEAR(light.y, 2 * 0.5f, 0.02f);
  EXPECT_NEAR(light.z, 3 * 0.2f, 0.02f);
}

TEST(Diffusion, ASpotFadesAsTheFormulaSaysInAnyUnits) {
  PointCloud spot;
  spot.channels = {{"_area", 1}, {"_radiance_t", 3}};
  const float values[4] = {0.5f, 1, 2, 4};
  spot.add({1, 2, 3}, {0, 0, 1}, 0.4f, values);
  const Dipole marble(*translucencyOf("marble"));
  for (const float mm : {1.0f, 10.0f}) {
    const vec3 light = Diffusion(spot).at({1, 2, 3.7f}, marble, mm, 1);
    EXPECT_NEAR(light.x, 0.5 * mm * mm * publishedRd(0.7 * mm, 2.19, 0.0021, 1.5), 2e-4 * light.x);
    EXPECT_NEAR(light.z, 4 * 0.5 * mm * mm * publishedRd(0.7 * mm, 3.00, 0.0071, 1.5), 2e-4 * light.z);
  }
}

TEST(Diffusion, GroupsStandForTheirPoints) {
  PointCloud cloud;
  cloud.channels = {{"_radiance_t", 3}, {"_area", 1}};
  for (uint32_t i = 0; i < 3000; ++i) {
    const vec2 a = sobol2(i, 1), b = sobol2(i, 2);
    const float values[4] = {a.x, 1, b.y, 0.01f * a.y};
    cloud.add(10.0f * vec3(a, b.x), {0, 0, 1}, 0.1f, values);
  }
  const Diffusion diffusion(cloud);
  const Dipole marble(*translucencyOf("marble"));
  for (const vec3 P : {vec3(5), vec3(0, 5, 5), vec3(12, 1, 9)}) {
    const vec3 all = diffusion.at(P, marble, 1, 0), fine = diffusion.at(P, marble, 1, 0.003f),
               coarse = diffusion.at(P, marble, 1, 0.3f);
    EXPECT_NEAR(fine.y / all.y, 1, 0.01f);
    EXPECT_NEAR(coarse.y / all.y, 1, 0.25f);
    EXPECT_NE(coarse.y, all.y) << "or no group was ever used";
  }
}

TEST(Diffusion, NoPointsGiveNoLightAndAMissingChannelIsSaid) {
  PointCloud none = plane(0, vec3(1));
  EXPECT_EQ(Diffusion(none).at(vec3(0), Dipole(*translucencyOf("marble")), 1, 1), vec3(0));
  none.channels = {{"_area", 1}};
  EXPECT_THROW(Diffusion{none}, FileError);
}

TEST(Diffusion, NegativeScatteringIsNone) {
  const Dipole dipole({{-2, 1, -0.5f}, {1, 1, 0.25f}, 1.3f});
  EXPECT_EQ(dipole.reflectance().x, 0);
  EXPECT_GT(dipole.reflectance().y, 0);
  EXPECT_EQ(dipole.exitance(1).z, 0);
}

TEST(Diffusion, FilesAreAskedThroughTheSeamOfShaders) {
  const std::string file = test::temporary("tomales_diffusion.ptc");
  writePointFile(plane(161, vec3(1)), file);
  CloudFiles files("");
  const float x[] = {0, 0, 0}, z[] = {0, 0, 40}, none[] = {0, 0, 0};
  const uint8_t active[] = {1, 0, 1};
  float r[] = {-1, -1, -1}, g[] = {-1, -1, -1}, b[] = {-1, -1, -1};
  const CloudQuery query{file, 3, active, {x, x, z}, {none, none, none}, none};
  TmSubsurfaceOptions material = tmSubsurfaceDefaults();
  material.material = nullptr;
  material.ior = 1.3f;
  for (int k = 0; k < 3; ++k) {
    material.albedo[k] = 0.6f;
    material.meanFreePath[k] = 1;
  }
  std::string problem;
  ASSERT_TRUE(files.subsurface(query, material, {r, g, b}, problem)) << problem;
  EXPECT_NEAR(r[0], 0.6f, 0.02f);
  EXPECT_EQ(r[1], -1) << "not asked for";
  EXPECT_LT(r[2], 1e-6f);
  const auto refused = [&](const auto& spoil) {
    TmSubsurfaceOptions bad = material;
    spoil(bad), problem.clear();
    return !files.subsurface(query, bad, {r, g, b}, problem) && !problem.empty();
  };
  for (const float ior : {0.0f, 0.5f, 4.0f, NAN})
    EXPECT_TRUE(refused([&](TmSubsurfaceOptions& m) { m.ior = ior; })) << ior;
  for (const float length : {0.0f, -1.0f, NAN, INFINITY})
    EXPECT_TRUE(refused([&](TmSubsurfaceOptions& m) { m.unitLength = length; })) << length;
  EXPECT_TRUE(refused([](TmSubsurfaceOptions& m) { m.meanFreePath[0] = 0, m.scattering[1] = NAN; }));
  material.material = "granite";
  EXPECT_FALSE(files.subsurface(query, material, {r, g, b}, problem));
  EXPECT_NE(problem.find("granite"), std::string::npos);
  EXPECT_FALSE(files.subsurface({"/absent.ptc", 3, active, {x, x, z}, {none, none, none}, none}, tmSubsurfaceDefaults(),
                                {r, g, b}, problem));
}

}  // namespace
}  // namespace tomales
