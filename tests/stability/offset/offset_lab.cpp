// Share of wrong rays for three ways of leaving a surface that rays know only roughly:
//   bias      hits nearer than rounding do not count
//   ignore    hits nearer than the offset do not count
//   hit list  "An Approximate Global Illumination System", section 4.3 (docs/decisions/0006)
// Flat cases: rays leave places up to d = offset / 1.5 before or behind their sheet, as micropolygons do, with the
// cosine around its normal. Right is what a ray would meet that leaves the sheet itself and cannot meet it. Curved
// cases: places on the true surface of a sphere, rays inwards; meeting the sphere before half the way to its other side
// is wrong. The same at all times of the shutter, where it moves. Curves and points: rays outwards, all of which miss
// it.
//
//     offset_lab [--rays N] [--check] [--picture FILE.ppm]
#include <fmt/format.h>

#include <cstdio>
#include <cstring>

#include "reyes/base/rng.h"
#include "reyes/dice.h"
#include "tests/unit/raytrace/world.h"

namespace tomales::test {
namespace {

enum Method { kBias, kIgnore, kHitList };
constexpr float kOffset = 0.01f, kBias_units = 1e-4f;

struct Row {
  std::string name;
  double wrong[3] = {0, 0, 0};
  double limit = 1;  ///< The share of wrong rays that the hit list may have.
};

Ray rayBy(Method method, const vec3& origin, const vec3& direction, float cosine, float offset, float bias, int group) {
  const float slanted = offset / std::max(cosine, 0.25f);  // as gi/gather.h has it
  Ray ray{origin, direction};
  ray.group = group;
  ray.offset = method == kHitList ? slanted : 0;
  ray.bias = method == kIgnore ? slanted : bias;
  return ray;
}

/// One sheet that rays leave upwards (+z) and what else there is.
struct FlatCase {
  std::string name;
  float alongX = 1;  ///< Rays leave from x in 0..alongX (logarithmically from a hundredth of it, if `edge`).
  bool edge = false;
  double limit = 1;
  bool displaced = true;
  std::vector<std::array<vec3, 3>> others;  ///< Corner and edges of parallelograms, same group as the sheet.
};

Row run(const FlatCase& c, int rays) {
  World world;
  const float start = c.edge ? 0 : -3;
  world.add(parallelogram({start, -3, 0}, {3 - start, 0, 0}, {0, 6, 0}));
  for (const auto& [o, u, v] : c.others) world.add(parallelogram(o, u, v));
  world.build();
  // Right is what rays from the sheet itself meet in a world without the sheet.
  World truth;
  for (const auto& [o, u, v] : c.others) truth.add(parallelogram(o, u, v));
  truth.build();
  Row row{c.name, {}, c.limit};
  for (int i = 0; i < rays; ++i) {
    const auto n = static_cast<uint32_t>(i);
    const vec2 place = sobol2(n, 1), height = sobol2(n, 2);
    const vec3 d = cosineHemisphere(sobol2(n, 3));
    const float x = c.edge ? c.alongX * std::pow(10.0f, -2 * place.x) : c.alongX * place.x;
    const vec3 P(x, place.y - 0.5f, 0);
    const float off = c.displaced ? (2 * height.x - 1) * kOffset / 1.5f : 0;
    const Ray exact{P, d};
    const int right = truth.rays->closest(exact, kMaskDiffuse).object;
    for (const Method m : {kBias, kIgnore, kHitList}) {
      const Hit hit = world.rays->closest(rayBy(m, P + vec3(0, 0, off), d, d.z, kOffset, kBias_units, 0), kMaskDiffuse);
      row.wrong[m] += (hit.object < 0 ? -1 : hit.object - 1) != right;
    }
  }
  for (double& w : row.wrong) w /= rays;
  return row;
}

/// Rays leave the places of an object's micropolygons to the outer side or inwards, at all times of the shutter if it
/// moves. Outwards any hit with the object is wrong. Inwards a miss is, and a hit nearer than `inside` times the
/// cosine.
struct ObjectCase {
  std::string name;
  double limit = 1;
  float inside = 0;  ///< 0: outwards.
  UvRect part{0.013f, 0.987f, 0.1f, 0.9f};
};

Row run(const ObjectCase& c, const World& world, int rays) {
  const Grid g = diceAtOpen(world.scene, 0, 0, c.part, 64, 64);
  const bool moves = world.rays->samplesTime(0), inwards = c.inside > 0;
  Row row{c.name, {}, c.limit};
  for (int i = 0; i < rays; ++i) {
    const auto n = static_cast<uint32_t>(i);
    const int k = static_cast<int>(hash32(n) % static_cast<uint32_t>(g.vertexCount()));
    const float time = moves ? sobol1(n, 4) : 0;
    const vec3 P = world.rays->placeAt(0, g.position(0, k), vec3(0), time);
    const vec3 away =
        glm::normalize(world.rays->placeAt(0, g.position(0, k) + glm::normalize(g.normal(k)), vec3(0), time) - P);
    vec3 x, y;
    orthonormalBasis(away, x, y);
    const vec3 d = cosineHemisphere(sobol2(n, 3));
    Ray prepared{P, vec3(0, 0, 1)};
    world.rays->prepareOrigin(0, P, 0, prepared);
    for (const Method m : {kBias, kIgnore, kHitList}) {
      Ray ray = rayBy(m, P, d.x * x + d.y * y + (inwards ? -d.z : d.z) * away, d.z, prepared.offset, prepared.bias, 0);
      ray.time = time;
      const Hit hit = world.rays->closest(ray, kMaskDiffuse);
      row.wrong[m] += inwards ? hit.object < 0 || hit.t < c.inside * d.z : hit.object >= 0;
    }
  }
  for (double& w : row.wrong) w /= rays;
  return row;
}

/// Tests a sphere five radii away from the eye. Both stand at `away` in the world.
Row runSphere(const std::string& name, float radius, float away, int rays, double limit) {
  World world;
  world.scene.cameraFromWorld = Motion::still(translation({-away, -away, -away}));
  world.add(sphere(radius), translation(vec3(away) + vec3(0, 0, 5 * radius)));
  world.build();
  return run(ObjectCase{name, limit, radius}, world, rays);
}

/// A sphere of radius 1 that turns around an axis beside it, or moves, while the shutter is open.
Row runMoving(const std::string& name, const mat4& atClose, int rays, double limit) {
  World world;
  world.scene.options.shutterClose = 1;
  world.attributes.trace.sampleMotion = true;
  const mat4 place = translation({0, 0, 6});
  world.add(sphere(), place);
  world.scene.objects[0].worldFromObject = Motion{{0, 1}, {place, place * atClose}};
  world.build();
  return run(ObjectCase{name, limit, 1}, world, rays);
}

/// The x axis goes to the y axis, about the point (1, 0, 0).
mat4 aroundRim(float angle) {
  mat4 turn(1.0f);
  turn[0] = vec4(std::cos(angle), std::sin(angle), 0, 0);
  turn[1] = vec4(-std::sin(angle), std::cos(angle), 0, 0);
  return translation({1, 0, 0}) * turn * translation({-1, 0, 0});
}

ParamList thin(std::vector<float> points, float width) {
  return {floatsParam("P", ValueType::Point, Storage::Vertex, std::move(points)),
          floatsParam("constantwidth", ValueType::Float, Storage::Constant, {width})};
}

std::vector<Row> runThin(int rays) {
  const std::vector<float> line{-1, -0.5f, 5, 1, 0.5f, 6}, bend{-1, -0.5f, 5, 0, 1, 5, 0.5f, 1, 5, 1, -0.5f, 5};
  Problems problems;
  ParamList ball = thin({0, 0, 5}, 0.02f);
  Param type = floatsParam("type", ValueType::String, Storage::Constant, {});
  type.strings = {"sphere"};
  ball.push_back(type);
  const std::pair<const char*, PrimPtr> prims[] = {
      {"straight tube", makeTubes(false, bezierBasis(), {2}, false, thin(line, 0.1f), problems)},
      {"bent curve that faces the eye", makeCurves(true, bezierBasis(), {4}, false, thin(bend, 0.1f), problems)},
      {"point, a disk", makePoints(thin({0, 0, 5}, 0.02f), problems)},
      {"point, a sphere", makePoints(ball, problems)},
  };
  std::vector<Row> rows;
  for (const auto& [name, prim] : prims) {
    World world;
    world.add(prim);
    world.build();
    rows.push_back(run(ObjectCase{name, 0.03}, world, rays));
  }
  return rows;
}

/// The far side of a wall whose near side the rays leave, and a ceiling.
std::vector<std::array<vec3, 3>> wall(float thickness) {
  return {{vec3(-3, -3, -thickness), vec3(0, 6, 0), vec3(6, 0, 0)}, {vec3(-9, -9, 2), vec3(0, 18, 0), vec3(18, 0, 0)}};
}

/// A sheet that meets the first one at x = 0, at this angle above it.
std::vector<std::array<vec3, 3>> corner(float degrees) {
  const float a = degrees * kPi / 180;
  return {{vec3(0, -3, 0), vec3(0, 6, 0), 3.0f * vec3(std::cos(a), 0, std::sin(a))}};
}

/// A sheet that passes through the first one at this distance from where rays leave.
std::vector<std::array<vec3, 3>> crossing(float degrees) {
  const float a = degrees * kPi / 180;
  const vec3 along = 3.0f * vec3(std::cos(a), 0, std::sin(a));
  return {{vec3(0, -3, 0) - along, vec3(0, 6, 0), 2.0f * along}};
}

std::vector<Row> measure(int rays) {
  std::vector<Row> rows;
  // Documented limits: walls thinner than what the surfaces are off, acute corners within an offset of the edge.
  for (const auto& [thickness, limit] : std::vector<std::pair<float, double>>{
           {10, 0.005}, {3, 0.005}, {1.6f, 0.01}, {1, 0.15}, {0.5f, 0.33}, {0.2f, 0.45}, {0.1f, 0.5}})
    rows.push_back(
        run({fmt::format("wall of {} offsets", thickness), 1, false, limit, true, wall(thickness * kOffset)}, rays));
  for (const auto& [degrees, limit] :
       std::vector<std::pair<float, double>>{{5, 0.7}, {15, 0.5}, {45, 0.35}, {90, 0.3}, {135, 0.2}, {175, 0.1}}) {
    rows.push_back(run({fmt::format("corner of {} degrees, surfaces exact", degrees), 4 * kOffset, true, limit, false,
                        corner(degrees)},
                       rays));
    rows.push_back(
        run({fmt::format("corner of {} degrees", degrees), 4 * kOffset, true, limit, true, corner(degrees)}, rays));
  }
  for (const float degrees : {30.0f, 90.0f})
    rows.push_back(
        run({fmt::format("sheets crossing at {} degrees", degrees), 4 * kOffset, true, 0.4, true, crossing(degrees)},
            rays));
  for (const float radius : {1e-3f, 1e-1f, 10.0f, 1e3f, 1e5f})
    rows.push_back(runSphere(fmt::format("sphere of radius {:g}", radius), radius, 0, rays, 0.03));
  rows.push_back(runSphere("sphere of radius 1, scene moved by 1e6", 1, 1e6f, rays, 0.03));
  for (Row& row : runThin(rays)) rows.push_back(std::move(row));
  rows.push_back(runMoving("sphere that moves by its width", translation({2, 0.5f, 0}), rays, 0.03));
  rows.push_back(runMoving("sphere that turns by 90 degrees around its rim", aroundRim(kPi / 2), rays, 0.03));
  return rows;
}

/// A bar for each method, one row below the other in the order of the table; the full width is 100 %.
bool draw(const std::vector<Row>& rows, const char* path) {
  constexpr int kBar = 5, kGap = 4, kWidth = 400;
  const int pitch = 3 * kBar + kGap, height = static_cast<int>(rows.size()) * pitch;
  const uint8_t colors[3][3] = {{200, 60, 50}, {230, 170, 60}, {50, 110, 190}};
  std::vector<uint8_t> pixels(static_cast<size_t>(3 * kWidth * height), uint8_t{255});
  for (size_t r = 0; r < rows.size(); ++r)
    for (int m = 0; m < 3; ++m)
      for (int y = 0; y < kBar - 1; ++y)
        for (int x = 0; x < kWidth * rows[r].wrong[m] + 1; ++x)
          for (int c = 0; c < 3; ++c)
            if (x < kWidth)
              pixels[static_cast<size_t>(3 * ((static_cast<int>(r) * pitch + m * kBar + y) * kWidth + x) + c)] =
                  colors[m][c];
  std::FILE* file = std::fopen(path, "wb");
  if (!file) return false;
  fmt::print(file, "P6\n{} {}\n255\n", kWidth, height);
  std::fwrite(pixels.data(), 1, pixels.size(), file);
  return std::fclose(file) == 0;
}

int lab(int argc, char** argv) {
  int rays = 100000;
  bool check = false, fine = true;
  const char* picture = nullptr;
  for (int i = 1; i < argc; ++i) {
    if (!std::strcmp(argv[i], "--rays") && i + 1 < argc) rays = std::max(1, std::atoi(argv[++i]));
    if (!std::strcmp(argv[i], "--check")) check = true;
    if (!std::strcmp(argv[i], "--picture") && i + 1 < argc) picture = argv[++i];
  }
  const std::vector<Row> rows = measure(rays);
  fmt::print("| case | bias | ignore near hits | hit list |\n|---|---|---|---|\n");
  for (const Row& r : rows) {
    fmt::print("| {} | {:.2f} % | {:.2f} % | {:.2f} % |\n", r.name, 100 * r.wrong[kBias], 100 * r.wrong[kIgnore],
               100 * r.wrong[kHitList]);
    if (r.wrong[kHitList] > r.limit) {
      fmt::print(stderr, "{}: more than {} % wrong\n", r.name, 100 * r.limit);
      fine = false;
    }
  }
  if (picture && !draw(rows, picture)) return 2;
  return check && !fine ? 1 : 0;
}

}  // namespace
}  // namespace tomales::test

int main(int argc, char** argv) { return tomales::test::lab(argc, argv); }
