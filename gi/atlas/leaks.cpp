#include "gi/atlas/leaks.h"

#include <fmt/format.h>

#include <map>

#include "gi/atlas/sight_lines.h"
#include "gi/brick_map.h"
#include "gi/point_file.h"
#include "gi/world_from_current.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr size_t kPlaces = 2048;  ///< Number of places in all maps together.
constexpr int kDirections = 8;
/// The distance of the farthest photons of an estimate, in radii of the disk that it stands for. An estimate averages
/// fifty photons and stands for the area of four, with disks that overlap.
constexpr float kReach = 2.2f;
/// A place leaks if there is at least this many times as much light behind the wall. Less makes a smudge at an edge.
constexpr float kMuchMore = 8;
constexpr double kMostArea = 0.002;  ///< The share of all area that may leak without a warning.

/// A place where an estimate was made, in world space.
struct Place {
  vec3 P, N;
  float radius;
  int surface;
};

/// Places of the map, each of which stands for the same area.
std::vector<Place> placesOf(const PointFile& file, size_t count) {
  double area = 0;
  const auto forEach = [&](const auto& visit) {
    PointCloud part;
    for (size_t chunk = 0; chunk < file.chunkCount(); ++chunk) {
      part = PointCloud();
      file.read(chunk, part);
      for (size_t i = 0; i < part.count(); ++i) visit(part, i);
    }
  };
  forEach([&](const PointCloud& c, size_t i) { area += std::pow(double{c.radius[i]}, 2); });
  std::vector<Place> out;
  double sum = 0;
  forEach([&](const PointCloud& c, size_t i) {
    sum += std::pow(double{c.radius[i]}, 2);
    if (sum * static_cast<double>(count) < area * static_cast<double>(out.size() + 1)) return;
    out.push_back({c.position[i], c.normal[i], c.radius[i], c.surface(i)});
  });
  return out;
}

class LeakTest {
 public:
  /// `surfaces`: indexed by group, its surface number in this map; -1 if the group belongs to another map.
  LeakTest(const RayScene& rays, const BrickMap& map, const std::vector<int>& surfaces)
      : rays_(rays), map_(map), surfaces_(surfaces), world_(rays.scene()), current_(glm::inverse(world_.points)) {}

  /// Returns the object through which light comes to the place; -1: none.
  int leakAt(const Place& place) const {
    const vec3 P = transformPoint(current_, place.P), N = normalizeOr(world_.currentNormals * place.N, vec3(0));
    const float reach = kReach * place.radius / world_.scale;
    if (N == vec3(0) || !(reach > 0)) return -1;
    vec3 tangent, bitangent;
    orthonormalBasis(N, tangent, bitangent);
    const vec3 start = P + kSightLift * reach * N;
    for (int k = 0; k < kDirections; ++k) {
      const float angle = 2 * kPi * static_cast<float>(k) / kDirections;
      const vec3 along = std::cos(angle) * tangent + std::sin(angle) * bitangent;
      const Hit wall = hitOf(start, along, reach);
      if (wall.object < 0 || hitOf(start, -along, reach).object >= 0) continue;
      const vec3 beyond = start + reach * along;
      const Hit floor = hitOf(beyond, -N, 2 * kSightLift * reach);
      // An estimate hardly counts photons of other surfaces.
      if (floor.object < 0 || surfaces_[static_cast<size_t>(rays_.groupOf(floor))] != place.surface) continue;
      const float here = std::min(light(P, place), light(P - reach * along, place));
      if (light(P + reach * along, place) > kMuchMore * here) return wall.object;
    }
    return -1;
  }

 private:
  Hit hitOf(const vec3& from, const vec3& along, float reach) const {
    Ray ray{from, along};
    ray.tMax = reach;
    return rays_.closest(ray, kMaskPhoton);
  }
  float light(const vec3& P, const Place& place) const {
    vec3 E(0);
    map_.lookup(transformPoint(world_.points, P), place.N, 0, &E.x, place.surface);
    return luminance(E);
  }

  const RayScene& rays_;
  const BrickMap& map_;
  const std::vector<int>& surfaces_;
  const WorldFromCurrent world_;
  const mat4 current_;
};

}  // namespace

void warnOfLeaks(const fs::path& folder, const Scene& scene, const RayScene& rays, const MapNames& names, Log& log) {
  const std::set<std::string> maps(names.global.begin(), names.global.end());
  size_t tested = 0, leaking = 0;
  std::map<int, size_t> walls;
  BrickCache cache;
  for (const std::string& name : maps) {
    const PointFile points(atlasFile(folder / "irradiance", name, ".ptc").string());
    const std::vector<Place> places = placesOf(points, std::max<size_t>(1, kPlaces / maps.size()));
    if (places.empty()) continue;
    std::vector<int> surfaces;
    for (size_t g = 0; g < names.global.size(); ++g)
      surfaces.push_back(names.global[g] == name ? names.surface[g] : -1);
    const BrickMap map(atlasFile(folder, name, ".bkm").string(), cache);
    const LeakTest test(rays, map, surfaces);
    std::vector<int> through(places.size());
    parallelFor(places.size(), 16, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) through[i] = test.leakAt(places[i]);
    });
    tested += places.size();
    for (const int object : through)
      if (object >= 0) {
        ++leaking;
        ++walls[object];
      }
  }
  if (static_cast<double>(leaking) <= kMostArea * static_cast<double>(tested)) return;
  const auto worst =
      std::max_element(walls.begin(), walls.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const Object& wall = scene.objects[static_cast<size_t>(worst->first)];
  log.report(
      Severity::Warning, "photon-walls", wall.where,
      fmt::format("{}: irradiance estimates reach through it to its other side, where there is more light. {:.1f} "
                  "% of all surfaces are too bright along its edges, and so is what they light (--atlas-direct "
                  "sampled avoids this)",
                  objectName(wall), 100 * static_cast<double>(leaking) / static_cast<double>(tested)));
}

}  // namespace tomales
