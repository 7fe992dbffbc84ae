#include "raytrace/chunks.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "raytrace/doubled_grid.h"
#include "raytrace/motion_keys.h"
#include "raytrace/tessellate.h"
#include "reyes/base/morton.h"
#include "reyes/base/packed_normal.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr int kTile = 64;                ///< Fine polygons along u or v of a tile.
constexpr int kChunkPolygons = 64 * 64;  ///< Polygons of a full chunk: docs/decisions/0036-geometry-cache.md
/// Greatest number of tiles in a chunk. Embree would build a larger scene with several threads, and the bits would
/// depend on their number.
constexpr size_t kChunkTiles = 1024;
/// Cells along u and v of the lattice over a tile that shows where its bound is too small.
constexpr int kTileProbes = 8;
constexpr int kSampled = 4;  ///< Polygons along u and v of the part of a tile whose deviation is measured.
constexpr size_t index(TessellationLevel level) { return static_cast<size_t>(level); }

int64_t polygons(const CoarseRate& r) { return int64_t{r.nu} * r.nv; }

/// Grows a bound so that vertices that are diced later lie in it, despite rounding here and in Embree.
Bound3 withRounding(const Bound3& b) {
  return b.grown(1e-6f * std::max(maxComponent(glm::abs(b.lo)), maxComponent(glm::abs(b.hi))));
}

}  // namespace

/// A tile of a patch, with its rate at each level.
struct Chunks::Piece {
  UvRect rect;
  std::array<CoarseRate, kLevelsInChunks> rate;
  Bound3 bound;
};

/// A patch with its pieces.
struct Chunks::TiledPatch {
  int object = -1;
  uint32_t patch = 0;
  std::vector<Piece> pieces;
  std::array<float, kLevelsInChunks> deviation{};
};

bool hasLevels(const Object& o, uint32_t patch, bool moves) {
  const Attributes& a = *o.attributes;
  return a.trace.rate != TessellationMode::Fixed && !moves && a.areaLight < 0 && o.solid < 0 && a.detail.whole() &&
         raysNeed(a) && !isExactQuad(o, patch) && o.shape().kept(patch, UvRect{}) == Kept::All;
}

Chunks::Chunks(const Scene& scene, const Camera& camera, const ShadingSystem& shading,
               const std::vector<bool>& elsewhere, Log& log)
    : scene_(scene), shading_(shading), log_(log), present_(scene.groups.size()), deviations_(scene.groups.size()) {
  for (const ShadeGroup& g : scene.groups) full_.push_back(g.attributes->trace.rate == TessellationMode::Full);
  if (std::all_of(scene.groups.begin(), scene.groups.end(),
                  [](const ShadeGroup& g) { return g.attributes->trace.rate == TessellationMode::Fixed; }))
    return;
  const std::vector<std::vector<float>> times = motionKeyTimes(scene);
  std::vector<std::pair<int, uint32_t>> patches;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& o = scene.objects[i];
    for (uint32_t p = 0;
         !elsewhere[i] && o.attributes->trace.rate != TessellationMode::Fixed && p < o.shape().patchCount(); ++p)
      if (hasLevels(o, p, times[static_cast<size_t>(o.group)].size() > 1)) patches.emplace_back(static_cast<int>(i), p);
  }
  std::vector<TiledPatch> tiled(patches.size());
  parallelFor(patches.size(), 16, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) tiled[i] = cutIntoTiles(patches[i].first, patches[i].second, camera);
  });
  pack(tiled);
}

Chunks::TiledPatch Chunks::cutIntoTiles(int object, uint32_t patch, const Camera& camera) const {
  const Object& o = scene_.objects[static_cast<size_t>(object)];
  const std::array<CoarseRate, kLevelsInChunks> rates = levelRates(scene_, camera, object, patch, log_);
  const auto tiles = [](int count) { return (count + kTile - 1) / kTile; };
  const int across = tiles(rates[0].nu), along = tiles(rates[0].nv);
  const auto at = [](int i, int n) { return static_cast<float>(i) / static_cast<float>(n); };
  TiledPatch out{object, patch, {}, {}};
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < across; ++i) {
      Piece piece{{at(i, across), at(i + 1, across), at(j, along), at(j + 1, along)}, {}, {}};
      for (size_t l = 0; l < kLevelsInChunks; ++l)
        piece.rate[l] = {(rates[l].nu + across - 1) / across, (rates[l].nv + along - 1) / along};
      const Bound3 bound =
          transformBound(o.cameraFromObject.at(o.keyTimes.front()), o.shape().bound(patch, piece.rect));
      if (!isFinite(bound.lo) || !isFinite(bound.hi)) {
        reportNotFinite(o, log_);
        continue;
      }
      piece.bound = withRounding(displacesForRays(o) ? bound.grown(o.displacementBound) : bound);
      measure(out, piece);
      out.pieces.push_back(piece);
    }
  return out;
}

/// Measures the deviation of a part of the piece at each level. A hash chooses the part.
void Chunks::measure(TiledPatch& tiled, Piece& piece) const {
  const Object& o = scene_.objects[static_cast<size_t>(tiled.object)];
  const auto displaced = [&](const UvRect& part, int nu, int nv) {
    Grid g = diceAtOpen(scene_, tiled.object, tiled.patch, part, nu, nv);
    if (displacesForRays(o)) shading_.displace(g);
    if (!isFinite(g)) return g;
    // The displacement bound may be too small.
    Bound3 met;
    for (int k = 0; k < g.vertexCount(); ++k) met.extend(g.position(0, k));
    piece.bound.extend(withRounding(met));
    return g;
  };
  if (displacesForRays(o)) displaced(piece.rect, kTileProbes, kTileProbes);
  for (const TessellationLevel level : {TessellationLevel::Medium, TessellationLevel::Fine}) {
    if (levelOf(static_cast<uint32_t>(o.group), level) != level) continue;  // no ray sees it
    const auto [nu, nv] = piece.rate[index(level)];
    const int u = std::min(nu, kSampled), v = std::min(nv, kSampled);
    const uint32_t key =
        hashCombine(o.sampleKey, tiled.patch, static_cast<uint32_t>(tiled.pieces.size()), static_cast<uint32_t>(level));
    const int i = static_cast<int>(unitFloat(key) * static_cast<float>(nu - u + 1));
    const int j = static_cast<int>(unitFloat(hash32(key)) * static_cast<float>(nv - v + 1));
    const auto within = [](float a, float b, int k, int n) {
      return lerp(a, b, static_cast<float>(k) / static_cast<float>(n));
    };
    const UvRect part{within(piece.rect.u0, piece.rect.u1, i, nu), within(piece.rect.u0, piece.rect.u1, i + u, nu),
                      within(piece.rect.v0, piece.rect.v1, j, nv), within(piece.rect.v0, piece.rect.v1, j + v, nv)};
    if (const Grid g = displaced(part, 2 * u, 2 * v); isFinite(g))
      tiled.deviation[index(level)] = std::max(tiled.deviation[index(level)], doubledDeviation(g, 0));
  }
}

void Chunks::pack(const std::vector<TiledPatch>& tiled) {
  struct Placed {
    uint32_t group, place;
    const TiledPatch* of;
    const Piece* piece;
  };
  std::vector<Bound3> ofGroup(scene_.groups.size());
  std::vector<Placed> placed;
  for (const TiledPatch& p : tiled) {
    const auto group = static_cast<uint32_t>(scene_.objects[static_cast<size_t>(p.object)].group);
    for (size_t l = 0; l < kLevelsInChunks; ++l)
      deviations_[group][l] = std::max(deviations_[group][l], p.deviation[l]);
    for (const Piece& piece : p.pieces) {
      present_[group] = true;
      ofGroup[group].extend(piece.bound);
      placed.push_back({group, 0, &p, &piece});
      finePolygons_ += polygons(piece.rate[index(TessellationLevel::Fine)]);
    }
  }
  for (Placed& p : placed) p.place = mortonPlace(p.piece->bound.center(), ofGroup[p.group]);
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return std::tie(a.group, a.place) < std::tie(b.group, b.place);
  });
  for (const TessellationLevel level : {TessellationLevel::Fine, TessellationLevel::Medium}) {
    int64_t held = kChunkPolygons;
    for (const Placed& p : placed) {
      if (levelOf(p.group, level) != level) continue;
      const CoarseRate& rate = p.piece->rate[index(level)];
      const bool fits = held + polygons(rate) <= kChunkPolygons && chunks_.back().group == p.group &&
                        chunks_.back().tiles.size() < kChunkTiles;
      if (!fits) {
        chunks_.push_back({p.group, level, {}, {}});
        held = 0;
      }
      held += polygons(rate);
      chunks_.back().tiles.push_back({p.of->object, p.of->patch, p.piece->rect, rate});
      chunks_.back().bound.extend(p.piece->bound);
    }
  }
  for (Chunk& c : chunks_) c.tiles.shrink_to_fit();
}

ChunkMesh Chunks::dice(size_t chunk) const {
  ChunkMesh out;
  const std::vector<PatchTile>& tiles = chunks_[chunk].tiles;
  size_t vertices = 0;
  for (const PatchTile& t : tiles) {
    const auto [nu, nv] = t.rate;
    out.firstVertex.push_back(static_cast<uint32_t>(vertices));
    vertices += static_cast<size_t>(nu + 1) * static_cast<size_t>(nv + 1);
  }
  out.P.reserve(vertices + 1);
  out.N.reserve(vertices);
  for (const PatchTile& t : tiles) {
    const Object& o = scene_.objects[static_cast<size_t>(t.object)];
    const auto [nu, nv] = t.rate;
    Grid g = diceAtOpen(scene_, t.object, t.patch, t.rect, nu, nv);
    if (displacesForRays(o)) shading_.displace(g);
    const bool finite = isFinite(g);
    if (!finite) reportNotFinite(o, log_);
    for (int k = 0; k < g.vertexCount(); ++k) {
      out.P.push_back(finite ? g.position(0, k) : vec3(std::numeric_limits<float>::quiet_NaN()));
      out.N.push_back(packNormal(normalizeOr(g.normal(k), vec3(0, 0, -1))));
    }
  }
  return out;
}

vec3 Chunks::normal(const ChunkMesh& mesh, size_t chunk, uint32_t tile, float u, float v) const {
  const auto [nu, nv] = chunks_[chunk].tiles[tile].rate;
  const auto cell = [](float x, int n) { return std::clamp(static_cast<int>(x * static_cast<float>(n)), 0, n - 1); };
  const int i = cell(u, nu), j = cell(v, nv);
  const float fu = u * static_cast<float>(nu) - static_cast<float>(i),
              fv = v * static_cast<float>(nv) - static_cast<float>(j);
  const int row = nu + 1;
  const auto N = [&](int di, int dj) {
    return unpackNormal(mesh.N[mesh.firstVertex[tile] + static_cast<uint32_t>((j + dj) * row + i + di)]);
  };
  return normalizeOr(glm::mix(glm::mix(N(0, 0), N(1, 0), fu), glm::mix(N(0, 1), N(1, 1), fu), fv), N(0, 0));
}

}  // namespace tomales
