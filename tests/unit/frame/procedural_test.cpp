// Procedurals are opened when a bucket comes to their bound, and dropped behind the last one.
#include <gtest/gtest.h>

#include <atomic>

#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/prim_factories.h"
#include "reyes/shader_registry.h"

extern const TmShaderLibrary* tomales_builtin_shaders(void);

namespace tomales {
namespace {

mat4 translation(const vec3& t) {
  mat4 m(1.0f);
  m[3] = vec4(t, 1);
  return m;
}

PrimPtr heightField(int n) {
  Param P;
  P.name = "P";
  P.type = ValueType::Point;
  P.storage = Storage::Vertex;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (const float x :
           {static_cast<float>(i) / static_cast<float>(n - 1), static_cast<float>(j) / static_cast<float>(n - 1), 0.0f})
        P.floats.push_back(x);
  Problems problems;
  return makeBilinearPatchMesh(n, false, n, false, {P}, problems);
}

/// Squares of one unit behind an orthographic window of 8 x 8 units; each is a mesh that is made when it is asked for.
struct Squares {
  Scene scene;
  std::atomic<int> opened{0};
  int toldOfBounds = 0;

  Squares() {
    scene.options.xResolution = scene.options.yResolution = 128;
    scene.options.bucketWidth = scene.options.bucketHeight = 16;  // as large as a square
    scene.options.screenWindow = {{-4, 4, -4, 4}};
  }
  void add(const vec3& corner) {
    Procedural p;
    p.bound = {vec3(0), vec3(1, 1, 0.1f)};
    p.worldFromObject = Motion::still(translation(corner));
    p.attributes = std::make_shared<Attributes>();
    p.expand = [this, corner, attributes = p.attributes] {
      ++opened;
      Object o;
      o.shapes = {heightField(40)};
      o.worldFromObject = Motion::still(translation(corner));
      o.attributes = attributes;
      Expansion out;
      out.objects.push_back(std::move(o));
      return out;
    };
    scene.procedurals.push_back(std::move(p));
  }
  DeepFrame hide(Stats& stats) {
    Log log(Log::Verbosity::Quiet);
    ShaderRegistry registry(log);
    registry.addLibrary(tomales_builtin_shaders(), "built-in");
    scene.freeze();
    ShadingSystem shading(scene, registry, nullptr, log, stats);
    DeepFrame frame = hideFrame(scene, shading, {}, stats, log);
    toldOfBounds = log.count("rib-bound");
    return frame;
  }
};

TEST(Procedural, OffScreenOrHiddenIsNeverOpened) {
  Squares squares;
  squares.add({20, 0, 1});
  squares.add({0, 0, -5});
  Stats stats;
  squares.hide(stats);
  EXPECT_EQ(squares.opened, 0);
  squares.add({0.25f, 0.25f, 1});
  squares.scene.procedurals.back().bound = {vec3(0.2f), vec3(0.4f, 0.4f, 0.2f)};
  squares.add({0, 0, 0.5f});
  squares.hide(stats);
  EXPECT_EQ(squares.opened, 1) << "the nearer square hides the bound of the other";
}

TEST(Procedural, ThatReachesBeyondItsBoundIsToldOf) {
  for (const auto& [right, told] : {std::pair(1.0f, 0), {0.995f, 0}, {0.5f, 1}}) {
    Squares squares;
    squares.add({0.25f, 0.25f, 1});
    squares.scene.procedurals.back().bound.hi.x = right;
    Stats stats;
    squares.hide(stats);
    EXPECT_EQ(squares.toldOfBounds, told) << right;
  }
}

TEST(Procedural, GeometryIsDroppedBehindTheLastBucket) {
  const ThreadLimit one(1);
  const auto peak = [](int rows) {
    Squares squares;
    for (int row = 0; row < rows; ++row)
      for (int i = 0; i < 8; ++i) squares.add({static_cast<float>(i) - 4, 3 - static_cast<float>(row), 1});
    Stats stats;
    squares.hide(stats);
    EXPECT_EQ(squares.opened, 8 * rows);
    return stats.memoryBytes.geometry.load();
  };
  EXPECT_GT(peak(1), 0);
  EXPECT_LE(peak(8), 3 * peak(1)) << "two rows of squares may touch one row of buckets, and pieces share memory";
}

TEST(Procedural, GivesTheSamePictureForAnyNumberOfThreads) {
  const auto samples = [](int threads) {
    const ThreadLimit limit(threads);
    Squares squares;
    for (int i = 0; i < 30; ++i)
      squares.add({0.37f * static_cast<float>(i % 6) - 3, 0.29f * static_cast<float>(i / 6) - 1,
                   1 + 0.1f * static_cast<float>(i * 7 % 30)});
    Stats stats;
    const DeepFrame frame = squares.hide(stats);
    std::vector<float> out;
    for (const DeepTile& tile : frame.tiles)
      for (const Fragment& f : tile.fragments) {
        const Facet& facet = tile.facets[f.facet];
        const ShadePoints& points = tile.batches[static_cast<size_t>(facet.batch)];
        out.push_back(f.z);
        out.push_back(points.get3(kPx, facet.point[0]).x);
        out.push_back(static_cast<float>(points.key(facet.point[0])));
      }
    return out;
  };
  const auto one = samples(1);
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, samples(4));
}

}  // namespace
}  // namespace tomales
