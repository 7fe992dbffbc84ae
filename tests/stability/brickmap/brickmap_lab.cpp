// Where brick maps may leak: light of one surface on another that is near, against the lookup of the nearest photon's
// irradiance that they replace (Christensen 1999). Every surface has the same irradiance everywhere, so whatever else
// comes back is noise or a leak.
//     brickmap_lab [--photons N] [--check]
// README.md has its tables.
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "gi/brick_map.h"
#include "gi/photons/irradiance.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// A rectangle of one irradiance.
struct Surface {
  vec3 corner, u, v, normal;
  float E;
  int number = 1;  ///< PointCloud::surface()
  vec3 at(vec2 xi) const { return corner + xi.x * u + xi.y * v; }
  float area() const { return glm::length(cross(u, v)); }
};

struct LabScene {
  const char* name;
  std::vector<Surface> surfaces;
};

constexpr float kWall = 0.02f;  ///< Thickness of the wall; the room has edges of 1.

const std::vector<LabScene>& labScenes() {
  const float w = 0.5f - 0.5f * kWall;
  static const std::vector<LabScene> scenes{
      // A floor that goes on behind a wall, and the two sides of the wall.
      {"thin wall",
       {{{0, 0, 0}, {w, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1},
        {{1 - w, 0, 0}, {w, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.05f},
        {{w, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, 1},
        {{1 - w, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 0.05f}}},
      {"corner",
       {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1}, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 0.05f}}},
      {"leaf", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.05f}}},
      // An edge that is rounded by its normals, so that 45 degrees are between neighbours.
      {"bevel",
       {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1},
        {{-0.02f, 0, 0.02f}, {0.02f, 0, -0.02f}, {0, 1, 0}, {0.70710678f, 0, 0.70710678f}, 0.5f},
        {{-0.02f, 0, 0.02f}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 0.05f}}},
      // The lit underside of a floor, and what lies on the floor and faces down too.
      {"contact",
       {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 1},
        {{0, 0, 0}, {1, 0, 0.1f}, {0, 1, 0}, {0.0995037f, 0, -0.9950372f}, 0.05f, 2}}},
  };
  return scenes;
}

/// Returns photons as even as traced ones: every one has about the same power, so a dark surface has few.
PointCloud photonsOf(const LabScene& scene, int count) {
  double total = 0;
  for (const Surface& s : scene.surfaces) total += double{s.E * s.area()};
  const auto power = static_cast<float>(total / count);
  PointCloud cloud;
  cloud.channels = {{"power", 3}, kSurfaceChannel};
  for (size_t k = 0; k < scene.surfaces.size(); ++k) {
    const Surface& s = scene.surfaces[k];
    const auto own = static_cast<uint32_t>(std::lround(s.E * s.area() / power));
    const float each = s.E * s.area() / static_cast<float>(std::max(own, 1u));
    const std::array values{each, each, each, static_cast<float>(s.number)};
    for (uint32_t i = 0; i < own; ++i)
      cloud.add(s.at(sobol2(i, hashCombine(static_cast<uint32_t>(k), 17u))), s.normal, 0, values.data());
  }
  return cloud;
}

/// Returns the irradiance of the nearest point that faces alike. This is what a photon map gives gather rays without
/// brick maps.
float nearestOf(const PointCloud& points, const vec3& P, const vec3& N) {
  float best = kInfinity, E = 0;
  for (size_t i = 0; i < points.count(); ++i) {
    const vec3 off = points.position[i] - P;
    if (dot(points.normal[i], N) < kLayerCosine || dot(off, off) >= best) continue;
    best = dot(off, off);
    E = points.at(i)[0];
  }
  return E;
}

struct Errors {
  double mean = 0;  ///< Mean of |E - truth| over all surfaces, the brightest of which has E = 1.
  /// Mean of what E is above the truth, on all surfaces but the brightest, within two thicknesses of the wall of where
  /// surfaces meet.
  double leak = 0;
};

template <class Lookup>
Errors errorsOf(const LabScene& scene, const Lookup& lookup) {
  constexpr uint32_t kPlaces = 1000;
  Errors out;
  int all = 0, near = 0;
  for (size_t k = 0; k < scene.surfaces.size(); ++k) {
    const Surface& s = scene.surfaces[k];
    for (uint32_t i = 0; i < kPlaces; ++i) {
      const vec3 P = s.at(sobol2(i, hashCombine(static_cast<uint32_t>(k), 99u)));
      const double E = double{lookup(P, s)}, error = E - double{s.E};
      out.mean += std::abs(error);
      ++all;
      const bool leaf = std::strcmp(scene.name, "leaf") == 0;
      const float apart =
          std::strcmp(scene.name, "thin wall") == 0 ? std::abs(P.x - 0.5f) - 0.5f * kWall : std::max(P.x, P.z);
      if (s.E == 1 || (!leaf && apart > 2 * kWall)) continue;
      out.leak += std::max(0.0, error);
      ++near;
    }
  }
  return {out.mean / all, out.leak / std::max(near, 1)};
}

struct Lab {
  fs::path folder = fs::temp_directory_path() / fmt::format("tomales_brickmap_lab_{}", ::getpid());
  int failures = 0;
  Lab() { fs::create_directories(folder); }
  ~Lab() { fs::remove_all(folder); }

  void run(const LabScene& scene, int photons, bool check) {
    const PointCloud points = estimateIrradiance(photonsOf(scene, photons), {});
    const Errors nearest =
        errorsOf(scene, [&](const vec3& P, const Surface& s) { return nearestOf(points, P, s.normal); });
    fmt::print("\n## {}, {} photons, {} irradiance points\n\n", scene.name, photons, points.count());
    fmt::print("| maxerror | bricks | left out | bytes |");
    constexpr float kFilters[] = {0.002f, 0.005f, 0.01f, 0.02f, 0.05f, 0.1f};
    for (const float filter : kFilters) fmt::print(" {} |", filter);
    fmt::print("\n|---|---|---|---|---|---|---|---|---|---|\n| nearest photon | | | | {} |\n", text(nearest));
    for (const float maxError : {0.002f, 0.03f, 0.1f, 0.3f}) {
      const std::string path = (folder / "lab.bkm").string();
      const BuiltBricks built = writeBrickMap(points, {maxError}, path);
      BrickCache cache(size_t{1} << 28);
      const BrickMap map(path, cache);
      const auto kept = built.tree.nodes.size();
      fmt::print("| {} | {} | {:.0f} % | {} |", maxError, kept,
                 100.0 * built.eliminated / static_cast<double>(built.eliminated + static_cast<int>(kept)),
                 fs::file_size(path));
      for (const float filter : kFilters) {
        const Errors e = errorsOf(scene, [&](const vec3& P, const Surface& s) {
          float E[3] = {0, 0, 0};
          map.lookup(P, s.normal, filter, E, s.number);
          return E[0];
        });
        fmt::print(" {} |", text(e));
        // What README.md says, with room for noise: as fine as the wall, no worse than the nearest photon by more than
        // a hundredth.
        if (check && filter <= kWall / 4 && maxError <= 0.03f &&
            (e.mean > nearest.mean + 0.01 || e.leak > nearest.leak + 0.01))
          ++failures;
      }
      fmt::print("\n");
    }
  }

  static std::string text(const Errors& e) { return fmt::format("{:.3f}, {:.3f}", e.mean, e.leak); }
};

}  // namespace
}  // namespace tomales

int main(int argc, char** argv) {
  int photons = 100'000;
  bool check = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--check") == 0) check = true;
    if (std::strcmp(argv[i], "--photons") == 0 && i + 1 < argc) photons = std::atoi(argv[++i]);
  }
  tomales::Lab lab;
  for (const tomales::LabScene& scene : tomales::labScenes()) lab.run(scene, photons, check);
  if (lab.failures > 0) fmt::print("\n{} cells are worse than README.md says\n", lab.failures);
  return lab.failures > 0;
}
