// Pictures, environments and shadow maps as shaders in RSL's manner look them up (reyes/shader/sl_pictures.h).
#include <filesystem>

#include "tests/unit/shade/obedient.h"
#include "tests/unit/shade/written_picture.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

using namespace sl;

class BatchPictures : public BatchServices {};

/// Black, and white from its middle on.
std::string stepPicture(const std::string& name) {
  return writePicture(test::temporary(name), 256, 256, "Y",
                      [](int x, int) { return std::array{x < 128 ? 0.0f : 1.0f}; });
}

/// The mean over a quadrilateral of a picture, from s = `from` to `to`.
Float meanOver(const std::string& path, double from, double to) {
  const Float s[4] = {from, to, from, to}, t[4] = {0.4, 0.4, 0.6, 0.6};
  return xcomp(texture(path.c_str(), s, t));
}

TEST_F(BatchPictures, ATextureOfFourCornersIsTheMeanBetweenThem) {
  const std::string path = stepPicture("tomales_corners.tif");
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    const auto over = [&](double from, double to) { return meanOver(path, from, to); };
    s.Ci = Color(over(0.4, 0.6), over(0.45, 0.65), over(0.7, 0.8));
  });
  expectColor(c[0], vec3(0.5f, 0.75f, 1), 0.05f);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchPictures, PicturesAreLookedUpOverRegionsCornersAndChannels) {
  const std::string path = writePicture(test::temporary("tomales_ramp.exr"), 256, 128, "RGB", [](int x, int) {
    const float s = (static_cast<float>(x) + 0.5f) / 256;
    return std::array{s < 0.5f ? 0.0f : 1.0f, s, 2.0f};
  });
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    FilterRegion wide;
    for (Float& side : wide.sides) side = 0.1;
    wide.s = 0.5;
    wide.t = 0.5;
    const Float step = xcomp(texture(path.c_str(), wide));
    wide.s = 0.53;
    wide.scale(2);
    const Float wider = xcomp(texture(path.c_str(), wide));
    s.Ci = Color(step, wider, ftexture(path.c_str(), 1, 0.25, 0.5, "blur", 0.02));
  });
  EXPECT_NEAR(c[0].x, 0.5f, 0.02f);
  EXPECT_TRUE(c[0].y > 0.5f && c[0].y < 0.75f) << c[0].y;
  EXPECT_NEAR(c[0].z, 0.25f, 0.01f);
  const std::vector<vec3> around = asked(4, [&](sl::Surface& s) {
    // From the equator: +y is a quarter round the picture, where its green is 1/4.
    const Vector corners[4] = {Vector(0.1, 1, 0.1), Vector(-0.1, 1, 0.1), Vector(0.1, 1, -0.1), Vector(-0.1, 1, -0.1)};
    s.Ci = Color(ycomp(environment(path.c_str(), corners)), fenvironment(path.c_str(), 1, Vector(0, 1, 0)),
                 fenvironment(path.c_str(), 2, Vector(0, 1, 0), "blur", 0.01));
  });
  expectColor(around[0], {0.25f, 0.25f, 2}, 0.01f);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchPictures, AnEnvironmentIsFilteredOverTheAngleOfItsCorners) {
  const std::string path = stepPicture("tomales_around.tif");
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    // The step is at -x. This is 3.6 degrees beside it, on the dark side, and 33 degrees wide.
    const Vector wide[4] = {Vector(-1, 0.36, 0.1), Vector(-1, -0.24, 0.1), Vector(-1, 0.36, -0.1),
                            Vector(-1, -0.24, -0.1)};
    s.Ci = Color(xcomp(environment(path.c_str(), wide)), xcomp(environment(path.c_str(), Vector(-1, 0.0628, 0))), 0);
  });
  EXPECT_TRUE(c[0].x > 0.2f && c[0].x < 0.5f) << c[0].x;
  EXPECT_NEAR(c[0].y, 0, 0.01f);
}

TEST_F(BatchPictures, AnEnvironmentThatIsTracedHasAConeByItsBlurAndItsChannelAlone) {
  float widest = 0;
  services.seen = [&](const vec3& direction) {
    widest = std::max(widest, std::acos(std::min(1.0f, -direction.z / glm::length(direction))));
    return vec3(0.25f, 0.5f, 2);
  };
  const auto widthAt = [&](float blur) {
    widest = 0;
    const std::vector<vec3> c = asked(2, [&](sl::Surface& s) {
      const auto traced = [&](int channel) {
        return fenvironment("raytrace", channel, Vector(0, 0, -1), "blur", blur, "samples", 256);
      };
      s.Ci = Color(traced(0), traced(1), traced(9));
    });
    expectColor(c[0], {0.25f, 0.5f, 2});
    return widest;
  };
  EXPECT_LT(widthAt(0), 1e-3f);
  EXPECT_NEAR(widthAt(0.1f), 0.1f * kPi, 0.02f);
  EXPECT_NEAR(widthAt(0.3f), 0.3f * kPi, 0.02f);
  EXPECT_NEAR(widthAt(0.9f), kPi / 2, 0.1f) << "no ray goes into the surface";
}

// Every other column of texels is 1, and one in four so large that an average over it says nothing.
TEST_F(BatchPictures, PicturesAreLookedUpOnOtherLevelsAndWithoutWhatIsTooLarge) {
  const std::string path = writePicture(test::temporary("tomales_columns.exr"), 256, 256, "RGB", [](int x, int) {
    return std::array{static_cast<float>(x % 2), x % 4 == 0 ? 1e9f : 2.0f, 1e9f};
  });
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    FilterRegion region;
    region.s = 128.5 / 256;
    region.t = 0.5;
    const auto look = [&](double texels, const auto&... list) {
      for (Float& side : region.sides) side = 0;
      region.sides[0] = texels / 256;
      region.sides[3] = texels / 256;
      return texture(path.c_str(), region, list...);
    };
    s.Ci = Color(xcomp(look(16)), xcomp(look(16, "mipbias", 10)), xcomp(look(1, "mipbias", -4)));
    const Color some = look(16, "ignoreabove", 1000, "fill", 7);
    s.Oi = Color(ycomp(some), zcomp(some), xcomp(some));
    If(s.u < 0.2, [&] { s.Ci = s.Oi; });
  });
  expectColor(c[0], {2, 7, 0.5f}, 0.01f);
  expectColor(c[1], {0.5f, 0, 0.5f}, 0.02f);
}

// An orthographic map of -1..1: something at depth 1 hides its left half.
TEST_F(BatchPictures, AShadowOfFourCornersIsTheMeanBetweenThem) {
  const std::string path = writePicture(test::temporary("tomales_half.exr"), 64, 64, "Z",
                                        [](int x, int) { return std::array{x < 32 ? 1.0f : 100.0f}; },
                                        {{"worldToCamera", mat4(1)}, {"worldToScreen", mat4(1)}});
  const std::vector<vec3> c = asked(2, [&](sl::Surface& s) {
    const auto over = [&](double from, double to) {
      const Point corners[4] = {Point(from, -0.5, 5), Point(to, -0.5, 5), Point(from, 0.5, 5), Point(to, 0.5, 5)};
      return xcomp(shadow(path.c_str(), corners, "samples", 4, "bias", 0.1));
    };
    s.Ci = Color(over(-0.5, 0.5), over(-0.5, -0.25), xcomp(shadow(path.c_str(), Point(0.5, 0, 5))));
  });
  expectColor(c[0], {0.5f, 1, 0});
  EXPECT_TRUE(log.entries().empty());
}

// A map of a plane at depth 1, which hides what is further away than its bias.
TEST_F(BatchPictures, OptionsGiveTheBiasOfShadowsThatNameNone) {
  const std::string path =
      writePicture(test::temporary("tomales_plane.exr"), 64, 64, "Z", [](int, int) { return std::array{1.0f}; },
                   {{"worldToCamera", mat4(1)}, {"worldToScreen", mat4(1)}});
  const auto hidden = [&](const std::vector<std::pair<std::string, float>>& options) {
    scene.options.user.clear();
    for (const auto& [name, value] : options) scene.options.user["shadow:" + name] = number(name, value);
    shading.reset();
    scene.objects.clear();
    const std::vector<vec3> c = asked(400, [&](sl::Surface& s) {
      const Point behind(0, 0, 1.05);
      s.Ci = Color(xcomp(shadow(path.c_str(), behind)), xcomp(shadow(path.c_str(), behind, "bias", 0.01)), 0);
    });
    vec3 mean(0);
    for (size_t i = 0; i < 200; ++i) mean += c[i] / 200.0f;
    EXPECT_NEAR(mean.y, 1, 1e-5f) << "it names its own";
    return mean.x;
  };
  EXPECT_NEAR(hidden({}), 1, 1e-5f);
  EXPECT_FLOAT_EQ(hidden({{"bias", 0.1f}}), 0);
  EXPECT_FLOAT_EQ(hidden({{"bias0", 0.1f}, {"bias1", 0.2f}}), 0);
  EXPECT_NEAR(hidden({{"bias0", 0.1f}}), 1, 1e-5f) << "one of the two says nothing";
  EXPECT_NEAR(hidden({{"bias0", 0}, {"bias1", 0.2f}}), 0.25f, 0.1f) << "each point has its own between the two";
}

TEST_F(BatchPictures, AnOptionScalesAllTextureFilters) {
  const std::string path = stepPicture("tomales_step.exr");
  scene.options.user["texture:width"] = number("width", 2);
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    const auto over = [&](double from, double to) { return meanOver(path, from, to); };
    s.Ci = Color(over(0.475, 0.575), over(0.55, 0.6), 0);  // twice as wide: from 0.425 to 0.625, and beyond the step
  });
  expectColor(c[0], {0.625f, 1, 0}, 0.06f);
}

// Three quarters of the way from a texel of 0 to one of 1: linear, and by the cubic B-spline of filters that are not
// boxes.
TEST_F(BatchPictures, OneThatLiesElsewhereIsTakenAndTold) {
  const std::string path = stepPicture("tomales_moved.tif");
  scene.options.searchPaths["texture"] = std::filesystem::path(path).parent_path().string();
  const std::vector<vec3> c =
      asked(2, [](sl::Surface& s) { s.Ci = Color(meanOver("/nowhere/tomales_moved.tif", 0.7, 0.8), 0, 0); });
  EXPECT_NEAR(c[0].x, 1, 0.01f);
  EXPECT_EQ(log.count("texture-elsewhere"), 1);
}

TEST_F(BatchPictures, AnOptionNamesTheFilterOfLookupsThatNameNone) {
  const std::string path = stepPicture("tomales_edge.tif");
  scene.options.user["texture:filter"] = text("filter", "gaussian");
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    FilterRegion spot;
    spot.s = 0.5 + 0.25 / 256;
    spot.t = 0.5;
    for (int k = 0; k < 4; ++k) spot.sides[k] = k == 0 || k == 3 ? 1e-4 : 0.0;
    s.Ci = Color(xcomp(texture(path.c_str(), spot)), xcomp(texture(path.c_str(), spot, "filter", "box")), 0);
  });
  const float f = 0.75f, cubic = 1 - ((1 - f) * (1 - f) * (1 - f) + 4 - 6 * f * f + 3 * f * f * f) / 6;
  expectColor(c[0], {cubic, 0.75f, 0}, 5e-3f);
}

TEST_F(BatchPictures, PicturesAndLightsTellWhatTheyHold) {
  const std::string path = writePicture(test::temporary("tomales_constant.exr"), 64, 32, "RGB", [](int, int) {
    return std::array{0.25f, 0.5f, 2.0f};
  });
  light("distantlight", {number("intensity", 0.625f)});
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    std::vector<float> size;
    std::string kind;
    EXPECT_TRUE(textureinfo(path.c_str(), "resolution", size));
    EXPECT_EQ(size, (std::vector<float>{64, 32}));
    EXPECT_FALSE(textureinfo(path.c_str(), "resolution", kind)) << "numbers are no text";
    EXPECT_TRUE(textureinfo(path.c_str(), "type", kind));
    EXPECT_EQ(kind, "texture");
    int32_t type = -1;
    TmValue unset{};
    EXPECT_FALSE(grid()->call->textureInfo(grid()->host, grid(), path.c_str(), "weather", &type, &unset));
    Float intensity = 0;
    s.illuminance(s.P, s.N, 1.5f, [&] { EXPECT_TRUE(lightsource(s.lightNumber, "intensity", intensity)); });
    s.Ci = Color(ftexture(path.c_str(), 1, 0.5 + 0.1 * s.u, s.v), zcomp(environment(path.c_str(), Vector(s.u, 1, 0))),
                 intensity);
  });
  for (const size_t i : {0u, 1u}) expectColor(c[i], {0.5f, 2, 0.625f});
  EXPECT_TRUE(log.entries().empty());
}

}  // namespace
}  // namespace tomales
