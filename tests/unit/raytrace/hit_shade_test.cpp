#include <gtest/gtest.h>

#include "world.h"

namespace tomales::test {
namespace {

/// Towards four sheets of different colours side by side, and past them.
struct Sheets : World {
  Sheets() {
    const vec3 colors[4] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.25f, 0.125f}};
    for (int i = 0; i < 4; ++i) {
      attributes.color = colors[i];
      if (i == 2) attributes.areaLight = addAreaLight();
      if (i == 3) {
        attributes.areaLight = -1;
        attributes.indirect.bleeding = 0;
        attributes.indirect.bleedingColor = {1, 0.5f, 2};
      }
      add(parallelogram({static_cast<float>(i), -1, 3}, {0, 2, 0}, {1, 0, 0}));  // normal towards -z
    }
    build();
    for (uint32_t i = 0; i < 15; ++i) {
      const int sheet = static_cast<int>(i) % 5;
      rays_.push_back({vec3(static_cast<float>(sheet) + 0.4f, 0.02f * static_cast<float>(i), 0), vec3(0, 0, 1)});
      hits.push_back(rays->closest(rays_.back(), kMaskDiffuse));
      names.push_back({i, 0});
    }
  }
  std::vector<vec3> shade(RayKind kind) {
    ShadeContext context;
    context.kind = kind;
    std::vector<vec3> out;
    rays->shadeHits(rays_, hits, names, *shading, context, out);
    return out;
  }
  std::vector<Ray> rays_;
  std::vector<Hit> hits;
  std::vector<SampleName> names;
};

TEST(ShadeHits, EveryRayGetsTheColorOfWhatItMet) {
  Sheets sheets;
  const std::vector<vec3> out = sheets.shade(RayKind::Diffuse);
  ASSERT_EQ(out.size(), 15u);
  for (size_t i = 0; i < out.size(); i += 5) {
    EXPECT_EQ(out[i], vec3(1, 0, 0));
    EXPECT_EQ(out[i + 1], vec3(0, 1, 0));
    EXPECT_EQ(out[i + 2], vec3(0, 0, 1)) << "gather rays never count emission";
    EXPECT_EQ(out[i + 4], vec3(0)) << "a miss";
  }
}

TEST(ShadeHits, BleedingTakesTheColorOutOfGatherRaysAlone) {
  Sheets sheets;
  const vec3 color(0.5f, 0.25f, 0.125f);
  EXPECT_LT(glm::length(sheets.shade(RayKind::Diffuse)[3] - luminance(color) * vec3(1, 0.5f, 2)), 1e-6f);
  EXPECT_EQ(sheets.shade(RayKind::Camera)[3], color);
}

TEST(ShadeHits, OtherRaysSeeTheFrontOfAnEmitter) {
  Sheets sheets;
  EXPECT_EQ(sheets.shade(RayKind::Camera)[2], vec3(1, 1, 2));
  sheets.rays_[2] = {vec3(2.4f, 0.04f, 6), vec3(0, 0, -1)};
  sheets.hits[2] = sheets.rays->closest(sheets.rays_[2], kMaskDiffuse);
  EXPECT_EQ(sheets.shade(RayKind::Camera)[2], vec3(0, 0, 1)) << "its back";
}

}  // namespace
}  // namespace tomales::test
