// Writes the light of the gather pass as brick maps that another camera reads (Christensen and Batali 2004,
// section 6.3).
#include <array>
#include <map>
#include <tuple>

#include "gi/frame/baked_light.h"
#include "gi/frame/indirect.h"
#include "gi/frame/record_lookup.h"
#include "gi/point_file.h"
#include "gi/world_from_current.h"
#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// maxError is a share of the map's mean. It is a third of that of photon maps, over which gather rays average.
constexpr BrickSettings kBricks{.maxError = 0.01f};

struct LitPoint {
  vec3 P, N;  ///< World space.
  float radius;
  vec3 E;  ///< W/m2
  int surface;
  auto key() const { return std::tuple(P.x, P.y, P.z, N.x, N.y, N.z, radius, E.x, E.y, E.z, surface); }
};

using PointsOfMap = std::map<std::string, std::vector<LitPoint>>;

class Baking {
 public:
  Baking(const GiState& state, const MapNames& names) : state_(state), names_(names), world_(state.scene) {}

  /// Returns the points in an order that depends on their values alone, each once, however many buckets see it.
  PointsOfMap run(const DeepFrame& layout, const TileReader& tiles) const {
    PointsOfMap out;
    for (const std::string& name : names_.all()) out[name];
    std::mutex merging;
    parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
      throwIfStopped();
      const auto tile = tiles(t);
      if (!tile) return;
      for (const ShadePoints& batch : tile->batches) {
        const std::vector<LitPoint> points = pointsOf(batch);
        const std::lock_guard lock(merging);
        std::vector<LitPoint>& to = out.at(names_.global[static_cast<size_t>(batch.group())]);
        to.insert(to.end(), points.begin(), points.end());
      }
    });
    for (auto& [name, points] : out) {
      std::sort(points.begin(), points.end(), [](const LitPoint& a, const LitPoint& b) { return a.key() < b.key(); });
      points.erase(std::unique(points.begin(), points.end(),
                               [](const LitPoint& a, const LitPoint& b) { return a.key() == b.key(); }),
                   points.end());
    }
    return out;
  }

 private:
  std::vector<LitPoint> pointsOf(const ShadePoints& batch) const {
    std::vector<LitPoint> out;
    const GatherPlaces places(state_, batch);
    for (int i = 0; i < batch.count(); ++i) {
      const GatherPoint at = places.at(i);
      const std::optional<vec3> light = gatheredOverPi(state_, at);
      if (!light) continue;
      const vec3& N = at.normal;
      out.push_back({transformPoint(world_.points, batch.position(i)), normalizeOr(world_.normals * N, N),
                     kDiskOfSquare * world_.scale * batch.edgeLength(i), kPi * *light,
                     names_.surface[static_cast<size_t>(batch.group())]});
    }
    return out;
  }

  const GiState& state_;
  const MapNames& names_;
  const WorldFromCurrent world_;
};

/// Copies the points of earlier cameras if they are of the same world.
void copyEarlier(const fs::path& path, uint64_t world, PointFileWriter& to) {
  if (!fs::exists(path)) return;
  const PointFile file(path.string());
  if (file.madeFrom().world != world || file.channels() != to.channels()) return;
  for (size_t chunk = 0; chunk < file.chunkCount(); ++chunk) {
    PointCloud points;
    file.read(chunk, points);
    to.addChunk(points);
  }
}

}  // namespace

void bakeLight(const GiState& state, const DeepFrame& layout, const TileReader& tiles, const fs::path& folder,
               const MapNames& names, uint64_t world) {
  const fs::path kept = folder / "points";
  makeAtlasFolder(kept);
  for (const auto& [name, points] : Baking(state, names).run(layout, tiles)) {
    const fs::path path = atlasFile(kept, name, ".ptc");
    PointFileWriter writer(path.string(), {{"irradiance", 3}, kSurfaceChannel});
    copyEarlier(path, world, writer);
    for (const LitPoint& p : points) {
      const std::array values{p.E.x, p.E.y, p.E.z, static_cast<float>(p.surface)};
      writer.add(p.P, p.N, p.radius, values.data());
    }
    writer.finish({world, 0});
    writeIrradianceBricks(path, atlasFile(folder, name, ".bkm"), kBricks);
  }
}

void bakedIndirect(const GiState& state, const ShadePoints& points, const uint8_t* active, const IndirectResult& out) {
  const GatherPlaces places(state, points);
  int64_t lookups = 0, found = 0;
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    const vec3 n = places.at(i).normal, dominant[3] = {n, n, n};
    const float radius = std::sqrt(points.channel(kArea)[i] / kPi);
    const std::optional<vec3> light =
        state.atlas ? state.atlas->bakedOverPi(points.group(), points.position(i), n, radius) : std::nullopt;
    ++lookups;
    found += light.has_value();
    setIndirect(out, i, light.value_or(vec3(0.0f)), dominant);
  }
  state.stats.irradianceCache.lookups += lookups;
  state.stats.irradianceCache.interpolated += found;
}

}  // namespace tomales
