#include "gi/photons/caustics.h"
#include "gi/photons/irradiance.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "gi/atlas.h"
#include "gi/photons/tree.h"
#include "gi/point_file.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// `count` photons of equal power over the unit square at height z: irradiance `E` everywhere.
void addSquare(PointCloud& photons, uint32_t count, float z, const vec3& N, const vec3& E, uint32_t seed) {
  photons.channels = {{"power", 3}};
  const vec3 power = E / static_cast<float>(count);
  for (uint32_t i = 0; i < count; ++i) {
    const vec2 at(unitFloat(hashCombine(seed, i, 0u)), unitFloat(hashCombine(seed, i, 1u)));
    photons.add({at.x, at.y, z}, N, 0, &power.x);
  }
}

bool inMiddle(const vec3& p) { return p.x > 0.2f && p.x < 0.8f && p.y > 0.2f && p.y < 0.8f; }

TEST(PhotonIrradiance, UniformPhotonsGiveTheirIrradiance) {
  PointCloud photons;
  addSquare(photons, 40000, 0, {0, 0, 1}, {1, 2, 3}, 5);
  const PointCloud out = estimateIrradiance(photons, {});
  ASSERT_EQ(out.count(), 10000u);
  vec3 sum(0.0f);
  int count = 0;
  for (size_t i = 0; i < out.count(); ++i)
    if (inMiddle(out.position[i])) {
      sum += vec3(out.at(i)[0], out.at(i)[1], out.at(i)[2]);
      ++count;
    }
  EXPECT_NEAR(sum.x / static_cast<float>(count), 1, 0.02);
  EXPECT_NEAR(sum.z / static_cast<float>(count), 3, 0.06);
}

TEST(PhotonIrradiance, TheFarthestOfFewWithinReachGivesTheRadiusAndDoesNotCount) {
  PointCloud photons;
  photons.channels = {{"power", 3}};
  const vec3 power(1.0f);
  for (int i = 0; i < 21 * 21; ++i)
    photons.add({static_cast<float>(i % 21), static_cast<float>(i / 21), 0}, {0, 0, 1}, 0, &power.x);
  PhotonIrradianceSettings settings;
  settings.maxRadius = 3.7f;
  settings.every = 1;  // 45 photons, the farthest at the root of 13
  const PointCloud out = estimateIrradiance(photons, settings);
  ASSERT_EQ(out.count(), photons.count());
  const auto middle =
      static_cast<size_t>(std::find(out.position.begin(), out.position.end(), vec3(10, 10, 0)) - out.position.begin());
  ASSERT_LT(middle, out.count());
  EXPECT_NEAR(out.at(middle)[0], 44 / (13 * kPi), 1e-4);
}

TEST(PhotonIrradiance, BordersAreNotDark) {
  PointCloud photons;
  addSquare(photons, 40000, 0, {0, 0, 1}, vec3(1), 9);
  const PointCloud out = estimateIrradiance(photons, {});
  float edge = 0, corner = 0;
  int edges = 0, corners = 0;
  for (size_t i = 0; i < out.count(); ++i) {
    const vec3 p = out.position[i];
    if (p.x < 0.005f && p.y > 0.1f && p.y < 0.9f) {
      edge += out.at(i)[0];
      ++edges;
    }
    if (p.x < 0.02f && p.y < 0.02f) {
      corner += out.at(i)[0];
      ++corners;
    }
  }
  ASSERT_GT(edges, 20);
  ASSERT_GT(corners, 1);
  EXPECT_NEAR(edge / static_cast<float>(edges), 1, 0.1);  // 0.5 without the correction
  EXPECT_NEAR(corner / static_cast<float>(corners), 1, 0.4);
}

TEST(PhotonIrradiance, WallsBehindAndBesideDoNotCount) {
  PointCloud photons;
  addSquare(photons, 20000, 0, {0, 0, 1}, vec3(1), 1);
  addSquare(photons, 20000, -0.001f, {0, 0, -1}, vec3(5), 2);
  for (const PointCloud out = estimateIrradiance(photons, {});
       size_t i : {out.count() / 8, out.count() / 3, out.count() / 2})
    EXPECT_NEAR(out.at(i)[0], out.normal[i].z > 0 ? 1 : 5, out.normal[i].z > 0 ? 0.6 : 3);
}

/// A ball of radius 0.25 that lies on a sheet whose other side is lit: the sheet's photons face as those of
/// the ball's underside do.
PointCloud ballOnASheet(bool told) {
  PointCloud photons;
  photons.channels = {{"power", 3}};
  if (told) photons.channels = {{"power", 3}, kSurfaceChannel};
  const auto add = [&](const vec3& P, const vec3& N, float power, float surface) {
    const std::array values{power, power, power, surface};
    photons.add(P, N, 0, values.data());
  };
  for (uint32_t i = 0; i < 40000; ++i) {
    const vec2 at = sobol2(i, 5);
    add({at.x, at.y, 0}, {0, 0, -1}, 1.0f / 40000, 1);
    if (i >= 2000) continue;
    const float z = 1 - 2 * at.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * at.y;
    const vec3 N(r * std::cos(phi), r * std::sin(phi), z);
    add(vec3(0.5f, 0.5f, 0.25f) + 0.25f * N, N, 0.05f * kPi / 4 / 2000, 2);
  }
  return photons;
}

TEST(PhotonIrradiance, ABallOnASheetDoesNotTakeTheLightOfItsOtherSide) {
  for (const bool told : {true, false}) {
    const PointCloud photons = ballOnASheet(told), out = estimateIrradiance(photons, {.every = 1});
    double near = 0;
    int count = 0;
    for (size_t i = 0; i < out.count(); ++i) {
      const float off = glm::length(vec2(out.position[i]) - vec2(0.5f));
      if (out.position[i].z == 0 || out.normal[i].z > -0.5f || off < 0.02f || off > 0.1f) continue;
      near += double{out.at(i)[0]};
      ++count;
    }
    ASSERT_GT(count, 20);
    if (told)
      EXPECT_NEAR(near / count, 0.05, 0.01);
    else
      EXPECT_GT(near / count, 0.1) << "as long as nobody says which is which";
  }
}

/// The unit square, with one photon in `fewer` where x > 0.5, and with a wall between both halves.
PointCloud besideAWall(uint32_t fewer) {
  PointCloud photons;
  photons.channels = {{"power", 3}, kSurfaceChannel};
  for (uint32_t i = 0; i < 8000; ++i) {
    const vec2 at = sobol2(i, 5);
    const std::array values{1.0f, 1.0f, 1.0f, 1.0f};
    if (at.x < 0.5f || hash32(i) % fewer == 0) photons.add({at.x, at.y, 0}, {0, 0, 1}, 0, values.data());
  }
  const SightAlongSurface sight = [](const vec3& P, const vec3& N, float reach) {
    vec3 tangent, bitangent;
    orthonormalBasis(N, tangent, bitangent);
    SightLines out;
    for (size_t k = 0; k < kSightLines; ++k) {
      const float angle = 2 * kPi * static_cast<float>(k) / kSightLines;
      const float t = (0.5f - P.x) / (std::cos(angle) * tangent + std::sin(angle) * bitangent).x;
      out[k] = t > 0 ? std::min(t, reach) : reach;
    }
    return out;
  };
  return estimateIrradiance(std::move(photons), {.maxRadius = 0.5f}, {}, nullptr, sight);
}

TEST(PhotonIrradiance, EstimatesWhereAWallPartsMoreLightFromLessAreTold) {
  const float right = 8000.0f / 20;
  const PointCloud out = besideAWall(20), alike = besideAWall(1);
  int told = 0;
  for (size_t i = 0; i < out.count(); ++i) {
    const bool across = out.surface(i) == kAcrossWalls, dark = out.position[i].x > 0.5f;
    told += dark && across;
    EXPECT_TRUE(!dark || across || out.at(i)[0] < 2 * right) << out.position[i].x << ": " << out.at(i)[0];
    EXPECT_TRUE(!across || (dark ? out.position[i].x < 0.8f : out.position[i].x > 0.44f))
        << "it does not reach the wall";
    EXPECT_TRUE(!across || !dark || out.position[i].x - out.radius[i] < 0.5f)
        << "the mark covers what lies between it and the wall";
  }
  EXPECT_GT(told, 10);
  size_t byChance = 0;
  for (size_t i = 0; i < alike.count(); ++i) byChance += alike.surface(i) == kAcrossWalls;
  EXPECT_LT(byChance, alike.count() / 500) << "a wall between two sides that are alike takes nothing";
}

TEST(PhotonIrradiance, TilesOfTwoColoursShareTheLightOfTheirFloor) {
  PointCloud photons;
  photons.channels = {{"power", 3}, kSurfaceChannel};
  for (uint32_t i = 0; i < 40000; ++i) {
    const vec2 at = sobol2(i, 5);
    const bool dark = (static_cast<int>(at.x * 50) + static_cast<int>(at.y * 50)) % 2;
    const std::array values{1.0f / 40000, 1.0f / 40000, 1.0f / 40000, dark ? 1.0f : 2.0f};
    photons.add({at.x, at.y, 0}, {0, 0, 1}, 0, values.data());
  }
  const PointCloud out = estimateIrradiance(photons, {});
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < out.count(); ++i)
    if (inMiddle(out.position[i])) {
      sum += double{out.at(i)[0]};
      ++count;
    }
  EXPECT_NEAR(sum / count, 1, 0.02);
}

TEST(PhotonIrradiance, DisksCoverTheAreaOfTheirSurface) {
  PointCloud photons;
  addSquare(photons, 10000, 0, {0, 0, 1}, vec3(1), 3);
  const PointCloud out = estimateIrradiance(photons, {});
  double area = 0;
  for (const float r : out.radius) area += double{kPi * r * r};
  EXPECT_NEAR(area, 1.6 * 1.6, 0.1);  // they overlap
}

TEST(PhotonIrradiance, PhotonsThatDoNotFitIntoMemoryGiveTheSameLight) {
  const auto folder = std::filesystem::temp_directory_path() / "tomales_tiles";
  std::filesystem::create_directories(folder);
  PointCloud photons;
  addSquare(photons, 20000, 0, {0, 0, 1}, vec3(1), 3);
  writePointFile(photons, (folder / "p.ptc").string());
  for (const uint64_t most : {1'000'000u, 3000u}) {
    writeIrradiance(folder / "p.ptc", folder / "e.ptc", {}, most);
    const PointCloud out = PointFile((folder / "e.ptc").string()).readAll();
    EXPECT_NEAR(static_cast<double>(out.count()), 5000, 100) << most;
    double mean = 0;
    for (size_t i = 0; i < out.count(); ++i) mean += double{out.at(i)[0]} / static_cast<double>(out.count());
    EXPECT_NEAR(mean, 1, 0.03) << most;
  }
  std::filesystem::remove_all(folder);
}

TEST(PhotonIrradiance, CoveredShareIsThatOfACircularSegment) {
  EXPECT_NEAR(coveredShare(0), 1, 1e-3);
  EXPECT_NEAR(coveredShare(4 / (3 * kPi)), 0.5, 1e-4);
  EXPECT_NEAR(coveredShare(0.99f), 0, 0.01);
}

TEST(PhotonTree, FindsTheSamePhotonsAsABruteForceSearch) {
  PointCloud photons;
  addSquare(photons, 3000, 0, {0, 0, 1}, vec3(1), 11);
  const PhotonTree tree(photons);
  std::vector<NearPhoton> heap;
  for (uint32_t q = 0; q < 50; ++q) {
    const vec3 P(unitFloat(hash32(q)), unitFloat(hash32(q + 1000)), 0.01f);
    tree.nearest(P, {0, 0, 1}, 0, 20, kInfinity, heap);
    std::vector<NearPhoton> all;
    for (uint32_t i = 0; i < 3000; ++i) {
      const vec3 off = tree.position(i) - P;
      all.push_back({dot(off, off) + 15.0f * off.z * off.z, i});
    }
    std::sort(all.begin(), all.end());
    std::sort(heap.begin(), heap.end());
    ASSERT_EQ(heap.size(), 20u);
    for (size_t i = 0; i < heap.size(); ++i) EXPECT_EQ(heap[i].photon, all[i].photon);
  }
}

TEST(PointFile, ComesBackAsItWasWritten) {
  const auto path = std::filesystem::temp_directory_path() / "tomales_points.ptc";
  PointCloud cloud;
  cloud.channels = {{"irradiance", 3}, {"area", 1}};
  for (uint32_t i = 0; i < 70000; ++i) {
    const vec2 xi = sobol2(i, 3);
    const float values[4] = {xi.x, xi.y, 1, 2};
    cloud.add({xi.x, xi.y, xi.x * xi.y}, i % 7 ? cosineHemisphere(xi) : vec3(0), 0.01f, values);
  }
  writePointFile(cloud, path.string());
  const PointFile file(path.string());
  EXPECT_EQ(file.count(), 70000u);
  EXPECT_EQ(file.chunkCount(), 5u);
  EXPECT_EQ(file.channels(), cloud.channels);
  const PointCloud back = file.readAll();
  ASSERT_EQ(back.count(), cloud.count());
  for (size_t i = 0; i < back.count(); ++i) {
    EXPECT_EQ(back.position[i].x, back.at(i)[0]);
    const vec2 xi(back.at(i)[0], back.at(i)[1]);
    if (back.normal[i] != vec3(0)) {
      ASSERT_GT(dot(back.normal[i], cosineHemisphere(xi)), 0.999999f);
    }
  }
  EXPECT_LT(file.chunkBound(1).size().x, 0.7f);  // a part of the curve, not all over
  std::filesystem::remove(path);
}

EstimateFigures figuresOf(const PointCloud& photons, float reach = 0) {
  PhotonIrradianceSettings settings;
  settings.maxRadius = reach;
  EstimateFigures figures;
  const PointCloud out = estimateIrradiance(photons, settings, {}, &figures);
  EXPECT_EQ(figures.made, static_cast<int64_t>(out.count()));
  return figures;
}

/// Photons on the unit square as dense as a function says, at most 1.
template <class Density>
PointCloud uneven(const Density& density) {
  PointCloud photons;
  photons.channels = {{"power", 3}};
  const vec3 power(1e-3f);
  for (uint32_t i = 0; i < 60000; ++i) {
    const vec2 at(unitFloat(hashCombine(21u, i, 0u)), unitFloat(hashCombine(21u, i, 1u)));
    if (unitFloat(hashCombine(21u, i, 2u)) < density(at)) photons.add({at.x, at.y, 0}, {0, 0, 1}, 0, &power.x);
  }
  return photons;
}

TEST(PhotonIrradiance, UnevenLightIsNotTakenForClumps) {
  const auto meanOf = [](const PointCloud& photons) {
    const EstimateFigures f = figuresOf(photons);
    return f.clumps / static_cast<double>(f.made);
  };
  const auto nearLamp = [](const vec2& at) {
    const vec2 d = (at - 0.5f) / 0.2f;
    return 1 / ((1 + dot(d, d)) * (1 + dot(d, d)));
  };
  const auto penumbra = [](const vec2& at) { return 0.1f + 0.9f * glm::clamp((at.x - 0.45f) / 0.1f, 0.0f, 1.0f); };
  EXPECT_NEAR(meanOf(uneven(nearLamp)), 1, 0.05);
  EXPECT_NEAR(meanOf(uneven(penumbra)), 1, 0.05);
}

TEST(PhotonIrradiance, TellsHowManyEstimatesStandOnWeakGround) {
  PointCloud plenty, few, tiles, ball;
  addSquare(plenty, 40000, 0, {0, 0, 1}, vec3(1), 3);
  const EstimateFigures good = figuresOf(plenty);
  EXPECT_EQ(good.few, 0);
  EXPECT_NEAR(good.clumps / static_cast<double>(good.made), 1, 0.05);
  EXPECT_EQ(good.bent, 0);
  addSquare(few, 2000, 0, {0, 0, 1}, vec3(1), 4);
  EXPECT_GT(figuresOf(few, 0.05f).few, 400);  // 16 in a disk
  const vec3 power(1e-3f);
  tiles.channels = ball.channels = {{"power", 3}};
  for (uint32_t i = 0; i < 6400; ++i) {
    const vec2 in(unitFloat(hashCombine(7u, i, 0u)), unitFloat(hashCombine(7u, i, 1u)));
    tiles.add({static_cast<float>(i % 20) + 0.3f * in.x, static_cast<float>(i / 20 % 20) + 0.1f * in.y, 0}, {0, 0, 1},
              0, &power.x);  // 16 on each
    const float z = 1 - 2 * in.x, r = std::sqrt(1 - z * z), phi = 2 * kPi * in.y;
    const vec3 n(r * std::cos(phi), r * std::sin(phi), z);
    if (i < 200) ball.add(n, n, 0, &power.x);
  }
  const EstimateFigures clumped = figuresOf(tiles, 2);
  EXPECT_GT(clumped.clumps, 1.3 * static_cast<double>(clumped.made));
  const EstimateFigures bent = figuresOf(ball, 2);
  EXPECT_GT(bent.bent, bent.made / 2);
}

constexpr int kOfEdge = 60;  ///< Along each edge of a square.

/// A bright square of edge 1 around the origin of the plane z = 0, which gets 1 W, evenly; all is dark beside it.
PointCloud brightSquare() {
  PointCloud out;
  out.channels = {{kIndirectPower, 3}};
  const float share = 1.0f / (kOfEdge * kOfEdge);
  for (int i = 0; i < kOfEdge * kOfEdge; ++i) {
    const vec2 at = (vec2(i % kOfEdge, i / kOfEdge) + 0.5f) / float{kOfEdge} - 0.5f;
    const vec3 power(share, 2 * share, 0);
    out.add(vec3(at, 0), {0, 0, 1}, 0, &power.x);
  }
  return out;
}

const PhotonIrradianceSettings kOfCaustics{50, 1};

TEST(CausticPhotons, BringAsMuchLightAsTheyHave) {
  const CausticPhotons caustic(brightSquare(), kOfCaustics);
  constexpr int kPlaces = 240;
  constexpr float kWidth = 1.6f;
  for (const float radius : {0.0f, 0.1f}) {
    vec3 sum(0);
    for (int i = 0; i < kPlaces * kPlaces; ++i) {
      const vec2 at = kWidth * ((vec2(i % kPlaces, i / kPlaces) + 0.5f) / float{kPlaces} - 0.5f);
      sum += caustic.irradiance(vec3(at, 0), {0, 0, 1}, 0, radius) * (kWidth * kWidth / (kPlaces * kPlaces));
    }
    EXPECT_NEAR(sum.x, 1, 0.01f) << radius;
    EXPECT_NEAR(sum.y, 2, 0.02f) << radius;
    EXPECT_EQ(sum.z, 0);
  }
}

TEST(CausticPhotons, AreEvenInsideAndLeaveTheDarkDark) {
  const CausticPhotons caustic(brightSquare(), kOfCaustics);
  EXPECT_NEAR(caustic.irradiance({0.1f, 0.05f, 0}, {0, 0, 1}, 0, 0).x, 1, 0.05f);
  // The nearest 50 photons of one on the edge fill half a disk.
  const float widest = std::sqrt(2 * 51 / (kPi * kOfEdge * kOfEdge)) * 1.1f;
  EXPECT_EQ(caustic.irradiance({0.5f + widest, 0, 0}, {0, 0, 1}, 0, 0), vec3(0));
  EXPECT_GT(caustic.irradiance({0.5f + 0.5f * widest, 0, 0}, {0, 0, 1}, 0, 0).x, 0.01f);
}

TEST(CausticPhotons, ShineOnTheirSideOfTheirSurfaceAlone) {
  const CausticPhotons caustic(brightSquare(), kOfCaustics);
  EXPECT_EQ(caustic.irradiance({0, 0, 0}, {0, 0, -1}, 0, 0), vec3(0));
  EXPECT_EQ(caustic.irradiance({0, 0, 0.1f}, {0, 0, 1}, 0, 0), vec3(0));
}

TEST(CausticPhotons, AreDarkWhereThereAreNone) {
  PointCloud none;
  none.channels = {{kIndirectPower, 3}};
  EXPECT_EQ(CausticPhotons(none, kOfCaustics).irradiance({0, 0, 0}, {0, 0, 1}, 0, 0), vec3(0));
}

TEST(CausticPhotons, MayBeASingleOne) {
  PointCloud one;
  one.channels = {{kIndirectPower, 3}};
  const vec3 power(1);
  one.add(vec3(0), {0, 0, 1}, 0, &power.x);
  EXPECT_GT(CausticPhotons(one, kOfCaustics).irradiance({0.1f, 0, 0}, {0, 0, 1}, 0, 0.1f).x, 0);
}

}  // namespace
}  // namespace tomales
