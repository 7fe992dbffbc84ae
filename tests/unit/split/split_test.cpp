#include <glm/gtc/matrix_transform.hpp>

#include "reyes/base/rng.h"
#include "reyes/dice.h"
#include "tests/unit/split/test_scene.h"

namespace tomales {
namespace {
using namespace test;

TEST(Split, PiecesOfAPatchCoverItOnceWhenAllOfItIsInView) {
  const Scene scene = sceneOf({sphere()}, translation({0, 0, 4}));
  Stats stats;
  double covered = 0;
  for (const SubPatch& p : split(scene, stats)) {
    covered += (p.rect.u1 - p.rect.u0) * (p.rect.v1 - p.rect.v0);
    EXPECT_LE(p.nu * p.nv, scene.options.gridSize);
  }
  EXPECT_DOUBLE_EQ(covered, 1.0);
}

/// A square that is cut along a curve, and whose right side is farther away.
class Torn : public Prim {
 public:
  Torn() : Prim({}) {}
  uint32_t patchCount() const override { return 1; }
  PatchInfo info(uint32_t) const override { return {false, 0}; }
  Bound3 bound(uint32_t, const UvRect& r) const override { return {{r.u0, r.v0, 0}, {r.u1, r.v1, 0.9f}}; }
  void evaluate(uint32_t, int n, const float* u, const float* v, SurfacePoints out) const override {
    for (int i = 0; i < n; ++i) {
      const float depth = u[i] > 0.4f + 0.2f * v[i] * v[i] ? 0.9f : 0.0f;
      const auto set = [i](float* x, float* y, float* z, const vec3& at) {
        x[i] = at.x;
        y[i] = at.y;
        z[i] = at.z;
      };
      set(out.px, out.py, out.pz, {u[i], v[i], depth});
      set(out.dux, out.duy, out.duz, {1, 0, 0});
      set(out.dvx, out.dvy, out.dvz, {0, 1, 0});
      set(out.nx, out.ny, out.nz, {0, 0, -1});
    }
  }
  void interpolate(uint32_t, int, int, const float*, const float*, float*, int) const override {}
};

TEST(Split, WhatASurfaceLosesWhereItJumpsIsNothing) {
  const Scene scene = sceneOf({std::make_shared<Torn>()}, translation({0.2f, -0.5f, 1.5f}), 1, 512);
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  double covered = 0;
  for (const SubPatch& p : split(scene, stats, log)) covered += (p.rect.u1 - p.rect.u0) * (p.rect.v1 - p.rect.v0);
  EXPECT_DOUBLE_EQ(covered, 1.0);
  EXPECT_TRUE(log.entries().empty());
  EXPECT_LT(stats.geometry.piecesVisited, 3000);
}

TEST(Split, EndsWhenToldToStop) {
  const Scene scene = sceneOf({sphere()}, translation({0, 0, 4}));
  const Camera camera(scene.options);
  const uint32_t patch = 0;
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  std::atomic<bool> stop{false};
  const auto count = [&] {
    return splitPatches({scene, camera, camera.crop(), stats, log, stop}, 0, std::span(&patch, 1)).size();
  };
  EXPECT_GT(count(), 0u);
  stop = true;
  EXPECT_EQ(count(), 0u);
}

TEST(Split, RasterBoundsHoldEveryDicedVertex) {
  const Scene scene = sceneOf({sphere(), quad(3, -0.7f)}, translation({0.4f, 0, 3.5f}));
  const Camera camera(scene.options);
  Stats stats;
  for (const SubPatch& p : split(scene, stats)) {
    const Grid g = diceAtOpen(scene, p.object, p.patch, p.rect, p.nu, p.nv);
    for (int i = 0; i < g.vertexCount(); ++i) {
      const vec2 r = camera.raster(g.position(0, i));
      EXPECT_TRUE(r.x >= p.raster.lo.x && r.x <= p.raster.hi.x && r.y >= p.raster.lo.y && r.y <= p.raster.hi.y);
      EXPECT_GE(g.P(0, 2)[i], p.zMin - 1e-5f);
    }
  }
}

TEST(Split, SplittingLazilyEndsInTheSamePieces) {
  Scene scene = sceneOf({sphere(), quad(3, -0.7f)}, translation({0.4f, 0, 3.5f}));
  scene.options.xResolution = scene.options.yResolution = 2048;
  scene.freeze();
  const Camera camera(scene.options);
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  const SplitContext context{scene, camera, camera.crop(), stats, log};
  const auto isCoarse = [](const SubPatch& p) { return p.coarse; };
  const auto place = [](const SubPatch& p) {
    return std::make_tuple(p.object, p.patch, p.rect.u0, p.rect.v0, p.rect.u1, p.rect.v1, p.nu, p.nv);
  };
  for (int object = 0; object < 2; ++object) {
    const uint32_t patch = 0;
    std::vector<SubPatch> whole = splitPatches(context, object, {&patch, 1});
    std::vector<SubPatch> lazy = splitPatches(context, object, {&patch, 1}, Splitting::Lazily);
    EXPECT_GT(std::count_if(lazy.begin(), lazy.end(), isCoarse), 0);
    EXPECT_LT(lazy.size(), whole.size() / 4);
    for (auto coarse = lazy.end(); (coarse = std::find_if(lazy.begin(), lazy.end(), isCoarse)) != lazy.end();) {
      const SubPatch piece = *coarse;
      lazy.erase(coarse);
      for (const SubPatch& p : splitPiece(context, piece)) {
        EXPECT_GE(p.zMin, piece.zMin - 1e-4f);
        lazy.push_back(p);
      }
    }
    std::vector<decltype(place(whole[0]))> a, b;
    for (const SubPatch& p : whole) a.push_back(place(p));
    for (const SubPatch& p : lazy) b.push_back(place(p));
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b);
  }
}

/// All pieces of the first patch, lazily, with those that they are made of.
std::vector<SubPatch> allPieces(const Scene& scene, Stats& stats, Log& log) {
  const Camera camera(scene.options);
  const SplitContext context{scene, camera, camera.crop(), stats, log};
  const uint32_t patch = 0;
  std::vector<SubPatch> out;
  std::vector<SubPatch> pieces = splitPatches(context, 0, {&patch, 1}, Splitting::Lazily);
  while (!pieces.empty()) {
    const SubPatch piece = pieces.back();
    pieces.pop_back();
    out.push_back(piece);
    if (!piece.coarse) continue;
    const std::vector<SubPatch> finer = splitPiece(context, piece);
    pieces.insert(pieces.end(), finer.begin(), finer.end());
  }
  return out;
}

/// The visits that all pieces took.
int64_t visitsOf(const Scene& scene, Log& log) {
  Stats stats;
  allPieces(scene, stats, log);
  return stats.geometry.piecesVisited;
}

TEST(Split, AllPiecesOfAPatchTogetherHaveABudgetHoweverDeepTheyAreNested) {
  constexpr int64_t kBudget = (1 << 14) + 128 * 64;  // The window of 128 x 128 takes 64 grids.
  Problems problems;
  int cut = 0;
  for (const size_t k : {0, 17, 47})
    for (const float far : {2147483647.0f, -3e5f}) {
      Param P;
      P.name = "P";
      P.type = ValueType::Point;
      P.storage = Storage::Vertex;
      P.floats.assign(48, 0);
      P.floats[k] = far;
      Scene scene = sceneOf({makeBicubicPatchMesh(4, false, bezierBasis(), 4, false, bezierBasis(), {P}, problems)},
                            translation({0, 0, 5}));
      scene.objects[0].displacementBound = 0.2f;
      Log log(Log::Verbosity::Quiet);
      EXPECT_LE(visitsOf(scene, log), kBudget) << k;
      cut += log.worst() == Severity::Missing;
    }
  Scene endless = sceneOf({sphere(1e9f)}, translation({0, 0, 1e9f}));
  endless.objects[0].displacementBound = 1e5f;
  Log log(Log::Verbosity::Quiet);
  EXPECT_LE(visitsOf(endless, log), kBudget);
  EXPECT_GT(cut + (log.worst() == Severity::Missing), 0) << "what is cut short is reported";
}

TEST(Split, PatchesOfOneObjectShareABudget) {
  // A fan of patches that all reach out of floats' precision.
  Problems problems;
  Param P;
  P.name = "P";
  P.type = ValueType::Point;
  P.storage = Storage::Vertex;
  const int n = 5;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      for (const float x :
           {(i % 2 ? 1e9f : -1e9f) * static_cast<float>(j), (j % 2 ? 1e9f : -1e9f), 3.0f * static_cast<float>(i + j)})
        P.floats.push_back(x);
  const Scene scene =
      sceneOf({makeBilinearPatchMesh(n + 1, false, n + 1, false, {P}, problems)}, translation({0, 0, 5}));
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  split(scene, stats, log);
  EXPECT_LE(stats.geometry.piecesVisited, n * n * (655 + 16 * 64));
}

Scene outOfFocus(Scene scene) {
  scene.options.fStop = 1;
  scene.options.focalLength = 0.8f;
  scene.options.focalDistance = 6;
  return scene;
}

TEST(Split, BlurredPiecesThatMayBeAnywhereCostMore) {
  // Points beyond floats' precision, which no halving brings apart, and a lens that shows each of them all over the
  // window.
  Scene scene = sceneOf({sphere(1e9f)}, translation({0, 0, 1e9f}));
  scene.objects[0].displacementBound = 1e5f;
  Log log(Log::Verbosity::Quiet);
  Stats stats;
  const size_t sharp = split(scene, stats, log).size();
  Scene lens = outOfFocus(std::move(scene));
  lens.options.fStop = 1e-9f;
  EXPECT_LT(split(lens, stats, log).size(), sharp / 8);
  EXPECT_EQ(log.worst(), Severity::Missing) << "what is cut short is reported";
}

TEST(Split, RasterBoundsHoldEveryDicedVertexThroughAllOfTheLens) {
  const Scene scene = outOfFocus(sceneOf({sphere(), quad(3, -0.7f)}, translation({0.4f, 0, 3.5f})));
  const Camera camera(scene.options);
  Stats stats;
  for (const SubPatch& p : split(scene, stats)) {
    const Grid g = diceAtOpen(scene, p.object, p.patch, p.rect, p.nu, p.nv);
    for (int i = 0; i < g.vertexCount(); ++i)
      for (const float rim : {-1.0f, 1.0f}) {
        const vec3 P = g.position(0, i);
        const vec2 r = camera.raster(P) + rim * camera.defocus(camera.depthKey(P.z));
        EXPECT_TRUE(r.x >= p.raster.lo.x && r.x <= p.raster.hi.x && r.y >= p.raster.lo.y && r.y <= p.raster.hi.y);
      }
  }
}

TEST(Split, WhatOnlyItsBlurBringsIntoViewIsKept) {
  // The frustum's side at z = 3 is at x = 1.73; the sphere begins at 2.1. The lens moves it by 0.2 (focus at 6).
  const Scene sharp = sceneOf({sphere(0.2f)}, translation({2.3f, 0, 3}));
  Stats stats;
  EXPECT_TRUE(split(sharp, stats).empty());
  Scene lens = outOfFocus(sharp);
  EXPECT_TRUE(split(lens, stats).empty());
  lens.options.fStop = 0.25f;  // Four times the lens: moved by 0.8.
  EXPECT_FALSE(split(lens, stats).empty());
}

TEST(Split, AGroundPlaneThroughTheEyeEndsInFinitelyManyPieces) {
  // The plane runs from far behind the camera to far in front, a little below the eye.
  const Scene scene = sceneOf({quad(1000, -1.0f)}, mat4(1.0f), 1, 64);
  Stats stats;
  const auto pieces = split(scene, stats);
  EXPECT_GT(pieces.size(), 4u);
  EXPECT_LT(pieces.size(), 4000u);
  EXPECT_EQ(stats.geometry.eyeSplitsGivenUp, 0);
}

TEST(Split, AHugeGroundPlaneBelowTheEyeIsWhole) {
  const Scene scene = sceneOf({quad(1e5f, -1)}, mat4(1.0f));
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  const std::vector<SubPatch> pieces = split(scene, stats, log);
  EXPECT_LT(log.worst(), Severity::Missing);
  // What a ray from the eye meets lies in one piece.
  const Camera camera(scene.options);
  for (const vec2& r : {vec2(64.5f, 127.5f), vec2(3, 100), vec2(90, 70), vec2(64, 65)}) {
    vec3 origin, direction;
    camera.ray(r, origin, direction);
    const vec3 p = direction * (-1 / direction.y);
    const float u = 0.5f * (p.x / 1e5f + 1), v = 0.5f * (p.z / 1e5f + 1);
    const auto holds = [&](const SubPatch& s) {
      return s.rect.u0 <= u && u <= s.rect.u1 && s.rect.v0 <= v && v <= s.rect.v1;
    };
    EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), holds)) << r.x << ' ' << r.y;
  }
}

/// Every point of a plane below the eye that a ray through the picture meets lies in a piece, and nothing is reported.
/// `planeToCamera` turns the camera; `size` is a multiple of the eye's height. Returns how many pieces were visited.
int64_t expectWholeGround(float size, const mat4& planeToCamera, float fov_degrees) {
  Scene scene = sceneOf({quad(size, -1)}, planeToCamera);
  scene.options.xResolution = 1920;
  scene.options.yResolution = 1080;
  scene.options.fov_degrees = fov_degrees;
  scene.options.nearClip = 1e-6f;
  scene.freeze();
  const Camera camera(scene.options);
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  const std::vector<SubPatch> pieces = allPieces(scene, stats, log);
  EXPECT_TRUE(log.entries().empty()) << log.entries()[0].message;
  const mat4 objectFromCamera = glm::inverse(scene.objects[0].cameraFromObject.at(0));
  for (uint32_t k = 0; k < 200; ++k) {
    vec3 origin, direction;
    camera.ray(vec2(1920, 1080) * sobol2(k, 1), origin, direction);
    direction = transformVector(objectFromCamera, direction);
    const vec3 p = direction * (-1 / direction.y);
    const vec2 at(0.5f * (p.x / size + 1), 0.5f * (p.z / size + 1));
    if (!(direction.y < 0) || std::max(std::abs(p.x), std::abs(p.z)) > size) continue;
    const auto holds = [&](const SubPatch& s) {
      return !s.coarse && s.rect.u0 <= at.x && at.x <= s.rect.u1 && s.rect.v0 <= at.y && at.y <= s.rect.v1;
    };
    EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), holds)) << k;
  }
  return stats.geometry.piecesVisited;
}

TEST(Split, GroundPlanesAreWholeHoweverLargeAndNearTheEyeTheyAre) {
  // The last size is where floats end: none lie between the parameters of what is nearest.
  for (const float size : {400.0f, 1e4f, 1e6f})
    for (const float yaw : {0.0f, 0.5f}) {
      SCOPED_TRACE(::testing::Message() << size << ' ' << yaw);
      const mat4 turned = glm::rotate(glm::rotate(mat4(1.0f), 0.2f, vec3(0, 0, 1)), yaw, vec3(0, 1, 0));
      EXPECT_LT(expectWholeGround(size, turned, 40), 300000);
    }
}

TEST(Split, GroundPlanesAreWholeHoweverTheCameraIsPitched) {
  // A strip of the plane across the view is thousands of windows wide, whether it runs along u or along v.
  for (const float size : {2000.0f, 1e5f, 1e6f})
    for (const float pitch_degrees : {-10.0f, 10.0f, 40.0f})
      for (const float yaw_degrees : {0.0f, 90.0f}) {
        SCOPED_TRACE(::testing::Message() << size << ' ' << pitch_degrees << ' ' << yaw_degrees);
        const mat4 pitched = glm::rotate(mat4(1.0f), glm::radians(pitch_degrees), vec3(1, 0, 0));
        EXPECT_LT(expectWholeGround(size, glm::rotate(pitched, glm::radians(yaw_degrees), vec3(0, 1, 0)), 60), 500000);
      }
}

TEST(Split, ASurfaceThroughTheNearPlaneNeedsFewPieces) {
  Scene scene = sceneOf({sphere()}, translation({0, 0, 5}));
  scene.options.nearClip = 4.5f;
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  const std::vector<SubPatch> pieces = split(scene, stats, log);
  EXPECT_TRUE(log.entries().empty());
  EXPECT_LT(pieces.size(), 100u);
  EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [](const SubPatch& p) { return p.zMin < 4.5f; }));
  EXPECT_FALSE(std::any_of(pieces.begin(), pieces.end(), [](const SubPatch& p) { return p.crossesEye; }))
      << "the hider cuts it";
}

TEST(Split, ASurfaceThroughTheEyeNeedsFewPieces) {
  const Scene scene = sceneOf({quad(1, -1e-5f)}, mat4(1.0f), 1, 16);
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  const std::vector<SubPatch> pieces = split(scene, stats, log);
  EXPECT_TRUE(log.entries().empty());
  EXPECT_LT(pieces.size(), 1000u);
  EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [](const SubPatch& p) { return p.crossesEye; }));
}

TEST(Split, AHugeDisplacementBoundLosesNothing) {
  Scene scene = sceneOf({sphere()}, translation({0, 0, 4}), 1, 64);
  scene.objects[0].displacementBound = 1e9f;
  Stats stats;
  double covered = 0;
  for (const SubPatch& p : split(scene, stats)) covered += (p.rect.u1 - p.rect.u0) * (p.rect.v1 - p.rect.v0);
  EXPECT_DOUBLE_EQ(covered, 1.0);
}

TEST(Split, WhatFloatsCannotResolveEndsAndIsReportedForItsObjectAlone) {
  Scene scene = sceneOf({sphere(1e30f), sphere(0.5f)}, translation({0, 0, 4}), 1, 64);
  const auto file = std::make_shared<const std::string>("huge.rib");
  scene.objects[0].where = {file, 1};
  scene.objects[1].where = {file, 2};
  Stats stats;
  Log log(Log::Verbosity::Quiet);
  const auto pieces = split(scene, stats, log);
  EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [](const SubPatch& p) { return p.object == 1; }));
  ASSERT_FALSE(log.entries().empty());
  for (const LogEntry& e : log.entries()) EXPECT_EQ(e.where.line, 1) << e.message;
}

TEST(Split, WhatLiesBehindTheEyeOrOutsideTheWindowIsCulled) {
  Stats stats;
  EXPECT_TRUE(split(sceneOf({sphere()}, translation({0, 0, -4})), stats).empty());
  EXPECT_TRUE(split(sceneOf({sphere()}, translation({20, 0, 4})), stats).empty());
}

TEST(Split, DoesNotDependOnTheCrop) {
  Scene scene = sceneOf({sphere(), quad(3, -0.7f), sphere(0.3f)}, translation({0, 0, 4}));
  Stats stats;
  const auto whole = split(scene, stats);
  scene.options.cropWindow = {0.4f, 0.6f, 0.4f, 0.6f};
  const auto cropped = split(scene, stats);
  EXPECT_LT(cropped.size(), whole.size());
  for (const SubPatch& c : cropped)
    EXPECT_TRUE(std::any_of(whole.begin(), whole.end(), [&](const SubPatch& w) {
      return w.object == c.object && w.rect.u0 == c.rect.u0 && w.rect.u1 == c.rect.u1 && w.rect.v0 == c.rect.v0 &&
             w.nu == c.nu && w.nv == c.nv;
    }));
}

}  // namespace
}  // namespace tomales
