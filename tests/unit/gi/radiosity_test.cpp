// Radiosity maps (Tabellion and Lamorlette 2004, section 4.4).
#include <gtest/gtest.h>

#include "fixture.h"
#include "gi/radiosity_bricks.h"
#include "gi/radiosity_picture.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"
#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

using namespace test;

RadiosityChart gradient(int width, int height) {
  RadiosityChart c;
  c.width = width;
  c.height = height;
  c.texelSize = 1;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      c.texels.emplace_back((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                            (static_cast<float>(y) + 0.5f) / static_cast<float>(height), 1);
  c.makeLevels();
  return c;
}

TEST(RadiosityChart, InterpolatesAGradientAtEveryLevelThatItFits) {
  const RadiosityChart c = gradient(16, 8);
  EXPECT_EQ(c.levels(), 5);
  for (const float width : {0.0f, 1.0f, 1.7f}) {
    const vec3 found = c.lookup(0.4f, 0.6f, width);
    EXPECT_NEAR(found.x, 0.4f, 1e-5f) << width;
    EXPECT_NEAR(found.y, 0.6f, 1e-5f) << width;
  }
  for (const float width : {16.0f, 1e9f, kInfinity})
    EXPECT_NEAR(c.lookup(0.1f, 0.9f, width).x, 0.5f, 1e-5f) << "the mean";
}

TEST(RadiosityChart, OfOneTexelIsThatTexel) {
  RadiosityChart c;
  c.width = c.height = 1;
  c.texelSize = 1;
  c.texels = {vec3(3, 2, 1)};
  c.makeLevels();
  EXPECT_EQ(c.lookup(0.9f, 0.1f, 5), vec3(3, 2, 1));
}

TEST(RadiosityChart, WhatIsUnknownHasNoSayAndTakesWhatIsAround) {
  RadiosityChart c;
  c.width = 4;
  c.height = 2;
  c.texelSize = 1;
  c.texels = {vec3(1), vec3(0), vec3(0), vec3(0), vec3(5), vec3(0), vec3(0), vec3(0)};
  c.coverage = {1, 0, 0, 0, 0.5f, 0, 0, 0};
  c.makeLevels();
  const float mean = (1 + 0.5f * 5) / 1.5f;
  EXPECT_EQ(c.texels[0].x, 1);
  EXPECT_EQ(c.texels[4].x, 5);
  for (const size_t filled : {1, 5, 2, 3, 6, 7, 8, 9, 10}) EXPECT_NEAR(c.texels[filled].x, mean, 1e-5f) << filled;
}

TEST(RadiosityPicture, ChartsLieAtMultiplesOfTheirSizeAndDoNotOverlap) {
  std::vector<RadiosityChart> charts;
  for (uint32_t k = 0; k < 200; ++k) {
    RadiosityChart c;
    c.width = 1 << (hash32(k) % 6);
    c.height = 1 << (hash32(k + 1000) % 5);
    c.texels.assign(static_cast<size_t>(c.width * c.height), vec3(static_cast<float>(k + 1)));
    charts.push_back(c);
  }
  const ChartLayout layout = layOutPicture(charts);
  const Image picture = pictureOf(charts);
  EXPECT_EQ(picture.width & (picture.width - 1), 0);
  EXPECT_EQ(picture.height & (picture.height - 1), 0);
  int64_t area = 0;
  for (size_t k = 0; k < charts.size(); ++k) {
    const RadiosityChart& c = charts[k];
    EXPECT_EQ(layout.corner[k].x % c.width, 0);
    EXPECT_EQ(layout.corner[k].y % c.height, 0);
    for (int y = 0; y < c.height; ++y)
      for (int x = 0; x < c.width; ++x)
        EXPECT_EQ(picture.at(layout.corner[k].x + x, layout.corner[k].y + y)[0], static_cast<float>(k + 1));
    area += static_cast<int64_t>(c.width) * c.height;
  }
  EXPECT_LT(static_cast<int64_t>(picture.width) * picture.height, 4 * area);
}

TEST(RadiosityMaps, HoldWhatAHitSendsBack) {
  World world(cornell({floatParam("samples", 64)}).scene);
  const auto services = world.use({.mode = GiMode::Radiosity});
  const RadiosityMaps maps(world.rays, world.shading, world.camera, {.texels = 4}, world.log);
  EXPECT_GT(maps.texelCount(), 10000);
  const ShadeContext context{RayKind::Diffuse, 1, 0, 1, false};
  double sum = 0, off = 0;
  int found = 0;
  for (uint32_t k = 0; k < 4000; ++k) {
    Ray ray{{0.2f, 0.1f, 2.6f}, cosineHemisphere(sobol2(k, 7U))};
    const Hit hit = world.rays.closest(ray, kMaskDiffuse);
    vec3 mapped;
    if (hit.object < 0 || !maps.lookup(ray, hit, mapped)) continue;
    std::vector<vec3> truth;
    world.rays.shadeHits({ray}, {hit}, {{k, 0}}, world.shading, context, truth);
    sum += static_cast<double>(luminance(truth[0]));
    off += static_cast<double>(std::abs(luminance(truth[0]) - luminance(mapped)));
    ++found;
  }
  EXPECT_GT(found, 2000);
  EXPECT_LT(off / sum, 0.02) << "the edges of shadows alone";
}

/// A shader lights the side that is seen. The map of a one-sided surface knows nothing of its back.
TEST(RadiosityMaps, DoNotAnswerForTheBackOfWhatIsOneSided) {
  for (const int sides : {1, 2}) {
    SceneBuilder b;
    b.quad({-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}, vec3(0.5f));
    auto attributes = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
    attributes->sides = sides;
    b.scene.objects[0].attributes = attributes;
    World world(std::move(b.scene));
    const auto services = world.use({.mode = GiMode::Radiosity});
    const RadiosityMaps maps(world.rays, world.shading, world.camera, {}, world.log);
    int answers = 0;
    for (const float from : {0.0f, 6.0f}) {
      const Ray ray{{0.1f, 0.2f, from}, {0, 0, from < 3 ? 1.0f : -1.0f}};
      const Hit hit = world.rays.closest(ray, kMaskDiffuse);
      ASSERT_EQ(hit.object, 0);
      vec3 mapped;
      const bool back = dot(ray.direction, hit.geometricNormal) > 0;
      const bool answered = maps.lookup(ray, hit, mapped);
      EXPECT_EQ(answered, sides == 2 || !back);
      answers += answered;
    }
    EXPECT_EQ(answers, sides);
  }
}

TEST(RadiosityMaps, OfATrimmedPatchAreNotDarkAlongItsEdge) {
  SceneBuilder b;
  TrimLoops triangle;
  triangle.loops.resize(1);
  triangle.keepsInside = true;
  TrimCurve& edges = triangle.loops[0].emplace_back();
  edges.line.controls = 4;
  edges.line.order = 2;
  edges.line.min = 0;
  edges.line.max = 3;
  edges.line.knots = {0, 0, 1, 2, 3, 3};
  edges.controls = {{0.13f, 0.17f, 1}, {0.91f, 0.32f, 1}, {0.41f, 0.87f, 1}, {0.13f, 0.17f, 1}};
  const Param P{"P", Storage::Vertex, ValueType::Point, 1, {-1, -1, 3, 1, -1, 3, -1, 1, 3, 1, 1, 3}, {}, {}};
  Problems problems;
  b.add(makeNuPatch({2, 2, {0, 0, 1, 1}, 0, 1}, {2, 2, {0, 0, 1, 1}, 0, 1}, triangle, {P}, problems), {0.5f, 0.25f, 1});
  ASSERT_TRUE(problems.empty()) << problems.front();
  auto bright = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  bright->surface = std::make_shared<ShaderCall>(call("constant"));
  b.scene.objects[0].attributes = bright;
  World world(std::move(b.scene));
  const auto services = world.use({.mode = GiMode::Radiosity});
  const RadiosityMaps maps(world.rays, world.shading, world.camera, {}, world.log);
  ASSERT_EQ(maps.charts(0, false).size(), 1U);
  EXPECT_GT(maps.texelCount(), 100);
  for (const vec3& texel : maps.charts(0, false)[0].texels)
    EXPECT_NEAR(glm::distance(texel, {0.5f, 0.25f, 1}), 0, 1e-5f);
}

TEST(RadiosityMaps, GatherAsShadersDoForNoShaderAtHits) {
  World world(cornell({floatParam("samples", 400)}).scene);
  const DeepFrame frame = frameOf(world, 16);
  const auto shaded = world.use({});
  gatherFrame(*shaded, frame);
  const std::vector<vec3> truth = indirectOf(*shaded, world, frame);
  const auto mapped = world.use({.mode = GiMode::Radiosity});
  auto maps =
      std::make_unique<const RadiosityMaps>(world.rays, world.shading, world.camera, RadiositySettings{}, world.log);
  mapped->setHitRadianceSource([&] { return std::move(maps); });
  const int64_t before = world.stats.shade.verticesShaded;
  gatherFrame(*mapped, frame);
  const std::vector<vec3> found = indirectOf(*mapped, world, frame);
  EXPECT_EQ(world.stats.shade.verticesShaded, before);
  double sum = 0, off = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    sum += static_cast<double>(luminance(truth[i]));
    off += static_cast<double>(std::abs(luminance(truth[i]) - luminance(found[i])));
  }
  EXPECT_LT(off / sum, 0.02);
}

struct BrickBake {
  TemporaryFolder folder{std::filesystem::temp_directory_path()};
  RadiosityBrickSettings settings;
  MapNames names;
  explicit BrickBake(World& world) {
    AtlasSettings atlas;
    atlas.world = 1;
    names = mapNames(world.scene, world.shading, atlas);
  }
  std::unique_ptr<const RadiosityBricks> make(World& world) const {
    return std::make_unique<const RadiosityBricks>(folder.path(), world.tools(), world.camera, names, settings,
                                                   world.stats, world.log);
  }
};

TEST(RadiosityBricks, GatherAsShadersDoForNoShaderAtHits) {
  World world(cornell({floatParam("samples", 400)}).scene);
  const DeepFrame frame = frameOf(world, 16);
  const auto shaded = world.use({});
  gatherFrame(*shaded, frame);
  const std::vector<vec3> truth = indirectOf(*shaded, world, frame);
  const auto baked = world.use({.mode = GiMode::Radiosity});
  const BrickBake bake(world);
  auto bricks = bake.make(world);
  baked->setHitRadianceSource([&] { return std::move(bricks); });
  const int64_t before = world.stats.shade.verticesShaded;
  gatherFrame(*baked, frame);
  const std::vector<vec3> found = indirectOf(*baked, world, frame);
  EXPECT_EQ(world.stats.shade.verticesShaded, before);
  double sum = 0, off = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    sum += static_cast<double>(luminance(truth[i]));
    off += static_cast<double>(std::abs(luminance(truth[i]) - luminance(found[i])));
  }
  EXPECT_LT(off / sum, 0.025) << "voxels, not texels, blur the shadow";
}

TEST(RadiosityBricks, AreKeptForTheSameWorldAndHaveTheSameBitsForAnyThreads) {
  World world(cornell().scene);
  const auto services = world.use({.mode = GiMode::Radiosity});
  BrickBake bake(world);
  const auto bits = [&] { return pointsMadeFrom(bake.folder.path() / "radiosity" / "scene0.ptc"); };
  uint64_t contents = 0;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    BrickBake own(world);
    own.make(world);
    const uint64_t now = PointFile((own.folder.path() / "radiosity" / "scene0.ptc").string()).contents();
    EXPECT_TRUE(contents == 0 || contents == now);
    contents = now;
  }
  bake.make(world);
  const int64_t shaded = world.stats.shade.verticesShaded;
  const uint64_t inputs = bits().inputs;
  bake.make(world);
  EXPECT_EQ(world.stats.shade.verticesShaded, shaded);
  bake.settings.points.texels = 2;
  bake.make(world);
  EXPECT_GT(world.stats.shade.verticesShaded, shaded);
  EXPECT_NE(bits().inputs, inputs);
}

TEST(RadiosityMaps, DoNotDependOnThreads) {
  World world(cornell().scene);
  const auto services = world.use({.mode = GiMode::Radiosity});
  std::vector<vec3> first;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    const RadiosityMaps maps(world.rays, world.shading, world.camera, {}, world.log);
    std::vector<vec3> all;
    for (int o = 0; o < static_cast<int>(world.scene.objects.size()); ++o)
      for (const bool back : {false, true})
        for (const RadiosityChart& c : maps.charts(o, back)) all.insert(all.end(), c.texels.begin(), c.texels.end());
    if (first.empty()) first = all;
    EXPECT_EQ(all, first) << threads;
  }
}

TEST(RadiosityMaps, DoNotAnswerForRaysThatRanShaders) {
  World world(cornell({floatParam("samples", 16)}).scene);
  const DeepFrame frame = frameOf(world, 16);
  const ShadePoints& batch = frame.tiles[5].batches[0];
  RayAnswers answers;
  answers.recording = true;
  ShadeContext context;
  context.answers = &answers;
  size_t recorded = 0;
  for (const GiMode mode : {GiMode::Gather, GiMode::Radiosity})
    for (const char* subset : {"", "walls"}) {
      IndirectQuery query = *world.shading.group(batch.group()).indirectQuery();
      query.subset = subset;
      const auto services = world.use({.mode = mode});
      indirectAt(*services, batch, query, context);
      EXPECT_EQ(answers.indirect.size(), recorded + static_cast<size_t>(batch.count()));
      recorded = answers.indirect.size();
    }
}

TEST(RadiosityMaps, AreMadeOfWhatTracesForHighlightsAlone) {
  SceneBuilder b = cornell();
  auto a = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  a->surface = std::make_shared<ShaderCall>(call("disney"));
  b.scene.objects[0].attributes = a;
  World world(std::move(b.scene));
  const auto services = world.use({.mode = GiMode::Radiosity});
  EXPECT_FALSE(RadiosityMaps(world.rays, world.shading, world.camera, {}, world.log).charts(0, false).empty());
}

TEST(RadiosityMaps, HaveNoMoreTexelsTogetherThanTheyMay) {
  World world(cornell().scene);
  const auto services = world.use({.mode = GiMode::Radiosity});
  const RadiosityMaps asked(world.rays, world.shading, world.camera, {}, world.log);
  const int64_t most = asked.texelCount() / 10;
  const RadiosityMaps bounded(world.rays, world.shading, world.camera, {.mostTexels = most}, world.log);
  EXPECT_LE(bounded.texelCount(), most);
  EXPECT_GE(bounded.texelCount(), most / 4);
  EXPECT_EQ(world.log.worst(), Severity::Warning);
  const RadiosityMaps least(world.rays, world.shading, world.camera, {.mostTexels = 1}, world.log);
  EXPECT_GT(least.texelCount(), 0);
}

TEST(RadiosityMaps, OfASmallPictureAreFewerThanOfALargeOne) {
  Scene fine = cornell().scene;
  for (Object& o : fine.objects) {
    auto a = std::make_shared<Attributes>(*o.attributes);
    a->radiosity.screen = false;
    a->radiosity.texelSize = 1e-4f;
    o.attributes = a;
  }
  fine.options.xResolution = fine.options.yResolution = 16;
  World world(std::move(fine));
  const auto services = world.use({.mode = GiMode::Radiosity});
  const RadiosityMaps maps(world.rays, world.shading, world.camera, {}, world.log);
  EXPECT_LE(maps.texelCount(), int64_t{1} << 18);
  EXPECT_GT(maps.texelCount(), int64_t{1} << 15);
}

TEST(RadiosityMaps, AreNotMadeOfWhatMirrorsIsNotOpaqueOrWantsNone) {
  SceneBuilder b = cornell();
  for (const size_t i : {size_t{0}, size_t{1}, size_t{3}}) {
    auto a = std::make_shared<Attributes>(*b.scene.objects[i].attributes);
    if (i == 0) a->opacity = vec3(0.5f);
    if (i == 1) a->radiosity.texelSize = 0;
    if (i == 3) a->surface = std::make_shared<ShaderCall>(call("mirror"));
    b.scene.objects[i].attributes = a;
  }
  World world(std::move(b.scene));
  const auto services = world.use({.mode = GiMode::Radiosity});
  const RadiosityMaps maps(world.rays, world.shading, world.camera, {}, world.log);
  EXPECT_TRUE(maps.charts(0, false).empty());
  EXPECT_TRUE(maps.charts(1, false).empty());
  EXPECT_FALSE(maps.charts(2, false).empty());
  EXPECT_TRUE(maps.charts(3, false).empty());
}

}  // namespace
}  // namespace tomales
