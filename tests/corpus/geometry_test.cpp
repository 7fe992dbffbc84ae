// Every file of ugly geometry through every stage: bounds contain what is evaluated, all that is diced, hidden, shaded
// and met by rays is finite. What is said about it, and the exit code, is tested with the program
// (tests/cli/geometry_test.py).
#include <gtest/gtest.h>

#include <filesystem>

#include "places.h"
#include "raytrace/trace.h"
#include "reyes/base/rng.h"
#include "reyes/dice.h"
#include "reyes/frame.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"
#include "reyes/split.h"

extern const TmShaderLibrary* tomales_builtin_shaders(void);

namespace tomales {
namespace {

constexpr uint32_t kMostPatches = 48, kMostPieces = 24;  ///< Of an object, of a patch: what one test looks at.

std::vector<std::filesystem::path> corpus() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(TOMALES_SOURCE_DIR "/tests/corpus/geometry"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

float random(uint32_t a, uint32_t b) { return unitFloat(hashCombine(a, b)); }

void expectPatchSound(const Prim& prim, uint32_t patch) {
  ASSERT_TRUE(isFinite(prim.bound(patch, {}).lo) && isFinite(prim.bound(patch, {}).hi));
  constexpr int kCount = 36;
  float u[kCount], v[kCount], f[12][kCount];
  for (uint32_t k = 0; k < 6; ++k) {
    const float u0 = k ? random(k, 1) : 0, v0 = k ? random(k, 2) : 0,
                size = k ? std::ldexp(1.0f, -static_cast<int>(k)) : 1;
    const UvRect r{u0, std::min(u0 + size, 1.0f), v0, std::min(v0 + size, 1.0f)};
    for (int i = 0; i < kCount; ++i) {
      u[i] = lerp(r.u0, r.u1, static_cast<float>(i % 6) / 5);
      v[i] = lerp(r.v0, r.v1, static_cast<float>(i / 6) / 5);
    }
    prim.evaluate(patch, kCount, u, v, {f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], f[9], f[10], f[11]});
    const Bound3 b = prim.bound(patch, r);
    int outside = 0, unsound = 0;
    for (int i = 0; i < kCount; ++i) {
      for (const auto& array : f) unsound += !std::isfinite(array[i]);
      unsound += f[9][i] == 0 && f[10][i] == 0 && f[11][i] == 0;
      for (int axis = 0; axis < 3; ++axis) outside += !(f[axis][i] >= b.lo[axis] && f[axis][i] <= b.hi[axis]);
    }
    EXPECT_EQ(unsound, 0) << "patch " << patch;
    EXPECT_EQ(outside, 0) << "patch " << patch << ", " << r.u0 << ' ' << r.u1 << ' ' << r.v0 << ' ' << r.v1;
  }
}

void expectGridsSound(const Scene& scene, int object, uint32_t patch, Stats& stats, Log& log) {
  const Camera camera(scene.options);
  const std::vector<SubPatch> pieces = splitPatches(
      {scene, camera, {0, 0, camera.xResolution(), camera.yResolution()}, stats, log}, object, std::span(&patch, 1));
  for (size_t k = 0; k < std::min<size_t>(pieces.size(), kMostPieces); ++k) {
    const SubPatch& p = pieces[k];
    const Object& o = scene.objects[static_cast<size_t>(object)];
    const int keys = static_cast<int>(o.keyTimes.size());
    const Grid g = dice(scene, object, patch, p.rect, p.nu, p.nv, {o.keyTimes, o.cameraFromObject});
    AlignedVector<float> n[3];
    for (auto& x : n) x.resize(static_cast<size_t>(g.stride()));
    calculateNormals(g, false, n[0].data(), n[1].data(), n[2].data());
    int unsound = 0;
    for (int i = 0; i < g.vertexCount(); ++i) {
      for (int key = 0; key < keys; ++key) unsound += !isFinite(g.position(key, i));
      const auto at = static_cast<size_t>(i);
      unsound += !isFinite(g.normal(i)) + !isFinite(vec3(n[0][at], n[1][at], n[2][at]));
    }
    EXPECT_EQ(unsound, 0) << "patch " << patch << ", piece " << k;
  }
}

void expectPictureFinite(Scene& scene, ShadingSystem& shading, Stats& stats, Log& log) {
  DeepFrame frame = hideFrame(scene, shading, {}, stats, log);
  int unsound = 0;
  for (DeepTile& tile : frame.tiles) {
    shadeTile(tile, scene, shading, {});
    for (const Fragment& f : tile.fragments) unsound += !std::isfinite(f.z);
    for (const ShadePoints& points : tile.batches)
      for (int channel = 0; channel < kFixedChannels; ++channel)
        for (int i = 0; i < points.count(); ++i) unsound += !std::isfinite(points.channel(channel)[i]);
    for (size_t b = 0; b < tile.shaded.size(); ++b)
      for (int i = 0; i < tile.batches[b].count(); ++i)
        unsound += !isFinite(tile.shaded[b].color(i)) + !isFinite(tile.shaded[b].opacity(i));
  }
  EXPECT_EQ(unsound, 0) << "in what the samples see";
}

void expectRaysFinite(const Scene& scene, const ShadingSystem& shading, Stats& stats, Log& log) {
  const Camera camera(scene.options);
  const RayScene rays(scene, camera, shading, {}, stats, log);
  int unsound = 0;
  for (uint32_t i = 0; i < 500; ++i) {
    vec3 origin, direction;
    camera.ray({random(i, 1) * static_cast<float>(camera.xResolution()),
                random(i, 2) * static_cast<float>(camera.yResolution())},
               origin, direction);
    const Hit hit = rays.closest({origin, direction}, kMaskDiffuse);
    if (hit.object < 0) continue;
    unsound +=
        !std::isfinite(hit.t) + !isFinite(hit.normal) + !isFinite(hit.geometricNormal) + !(hit.u >= 0 && hit.u <= 1);
  }
  EXPECT_EQ(unsound, 0) << "among hits of rays";
}

class UglyGeometry : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(UglyGeometry, GoesThroughEveryStage) {
  Log log(Log::Verbosity::Quiet);
  Stats stats;
  std::vector<Scene> scenes;
  RibSettings settings;
  settings.onScene = [&](Scene&& s) { scenes.push_back(std::move(s)); };
  ASSERT_TRUE(readRib({GetParam().string()}, settings, log));
  ASSERT_EQ(scenes.size(), 1u);
  Scene& scene = scenes[0];

  Stats unused;
  Log unheard(Log::Verbosity::Quiet);
  for (size_t o = 0; o < scene.objects.size(); ++o)
    for (const PrimPtr& shape : scene.objects[o].shapes)
      for (uint32_t patch = 0; patch < std::min(shape->patchCount(), kMostPatches); ++patch) {
        expectPatchSound(*shape, patch);
        expectGridsSound(scene, static_cast<int>(o), patch, unused, unheard);
      }

  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  ShadingSystem shading(scene, registry, nullptr, log, stats);
  expectPictureFinite(scene, shading, stats, log);
  expectRaysFinite(scene, shading, stats, log);
}

INSTANTIATE_TEST_SUITE_P(Corpus, UglyGeometry, testing::ValuesIn(corpus()), [](const auto& file) {
  const std::string name = file.param.filename().string();
  return name.substr(0, name.find('.'));
});

}  // namespace
}  // namespace tomales
