#include "raytrace/tessellate.h"

#include <fmt/format.h>

#include <numeric>

#include "raytrace/chunks.h"
#include "raytrace/doubled_grid.h"
#include "raytrace/motion_keys.h"
#include "reyes/base/parallel.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr double kBytesOfQuad = 125;  ///< A polygon with its vertices, and its part of Embree's tree.
/// The number of polygons falls faster than by the square of the edges' length where few are left. So a step is shorter
/// than the square root would be.
constexpr double kLeastLonger = 1.1, kPowerToFit = 0.3;
constexpr int kMostAttemptsToFit = 12;
constexpr int kLatticeTile = 64;  ///< Quads of one lattice along u or v; it limits what is diced at once.

class Tessellator {
 public:
  Tessellator(const Scene& scene, const Camera& camera, const ShadingSystem& shading, float longer, Log& log)
      : scene_(scene), camera_(camera), shading_(shading), longer_(longer), log_(log), times_(motionKeyTimes(scene)) {}

  bool moves(int object) const { return times_[static_cast<size_t>(objectOf(object).group)].size() > 1; }

  void addPatch(int object, uint32_t patch, CoarseGroup& out) const {
    const auto [nu, nv] = coarseRate(scene_, camera_, object, patch, longer_, &log_);
    const auto at = [](int i, int n) { return static_cast<float>(i) / static_cast<float>(n); };
    for (int j = 0; j < nv; j += kLatticeTile)
      for (int i = 0; i < nu; i += kLatticeTile) {
        const int i1 = std::min(i + kLatticeTile, nu), j1 = std::min(j + kLatticeTile, nv);
        addTile(object, patch, {at(i, nu), at(i1, nu), at(j, nv), at(j1, nv)}, i1 - i, j1 - j, out);
      }
  }

 private:
  const Object& objectOf(int object) const { return scene_.objects[static_cast<size_t>(object)]; }

  /// Dices at twice the rate: every second vertex is a corner, and the others show the deviation of the polygons.
  void addTile(int object, uint32_t patch, const UvRect& rect, int nu, int nv, CoarseGroup& out) const {
    const Object& o = objectOf(object);
    const Kept keptOfTile = o.shape().kept(patch, rect);
    if (keptOfTile == Kept::None) return;
    Grid g =
        dice(scene_, object, patch, rect, 2 * nu, 2 * nv, {times_[static_cast<size_t>(o.group)], o.currentFromObject});
    if (displacesForRays(o)) shading_.displace(g);
    if (!isFinite(g)) {
      reportNotFinite(o, log_);
      return;
    }
    const auto first = static_cast<uint32_t>(out.P.size());
    addVertices(g, nu, nv, o.subtracted ? -1.0f : 1.0f, out);
    out.lattices.push_back({object, patch, rect, static_cast<uint32_t>(nu), static_cast<uint32_t>(nv),
                            static_cast<uint32_t>(out.quads.size()), keptOfTile == Kept::All ? nullptr : &o.shape()});
    out.trimmed |= keptOfTile != Kept::All;
    addQuads(g, nu, nv, first, out);
  }

  /// side: factor on normals.
  static void addVertices(const Grid& g, int nu, int nv, float side, CoarseGroup& out) {
    out.laterP.resize(static_cast<size_t>(g.keyCount) - 1);
    for (int j = 0; j <= nv; ++j)
      for (int i = 0; i <= nu; ++i) {
        const int k = 2 * j * (2 * nu + 1) + 2 * i;
        out.P.push_back(g.position(0, k));
        out.N.push_back(side * normalizeOr(g.normal(k), vec3(0)));
        for (int key = 1; key < g.keyCount; ++key)
          out.laterP[static_cast<size_t>(key) - 1].push_back(g.position(key, k));
      }
  }

  /// Adds the quads of the last lattice. first: the number of their first vertex.
  static void addQuads(const Grid& g, int nu, int nv, uint32_t first, CoarseGroup& out) {
    const auto row = static_cast<uint32_t>(nu + 1);
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        const uint32_t a = first + static_cast<uint32_t>(j) * row + static_cast<uint32_t>(i);
        out.latticeOfQuad.push_back(static_cast<uint32_t>(out.lattices.size() - 1));
        if (!leavesQuad(g, 2 * i, 2 * j)) {
          out.quads.push_back({a, a, a, a});  // A quad without area is invisible to rays and lights.
          continue;
        }
        out.quads.push_back({a, a + 1, a + row + 1, a + row});
        for (int key = 0; key < g.keyCount; ++key)
          out.deviation = std::max(out.deviation, doubledDeviation(g, key, 2 * i, 2 * j));
      }
  }

  /// Tells whether a part of the polygon whose first cell is (i, j) remains after trimming.
  static bool leavesQuad(const Grid& g, int i, int j) {
    const auto gone = [&](int du, int dv) {
      return g.kept[static_cast<size_t>((j + dv) * g.nu + i + du)] == Kept::None;
    };
    return g.kept.empty() || !(gone(0, 0) && gone(1, 0) && gone(0, 1) && gone(1, 1));
  }

  const Scene& scene_;
  const Camera& camera_;
  const ShadingSystem& shading_;
  const float longer_;
  Log& log_;
  const std::vector<std::vector<float>> times_;  ///< Indexed by group.
};

void append(CoarseGroup& to, const CoarseGroup& from) {
  const auto vertex = static_cast<uint32_t>(to.P.size()), quad = static_cast<uint32_t>(to.quads.size());
  const auto lattice = static_cast<uint32_t>(to.lattices.size());
  to.P.insert(to.P.end(), from.P.begin(), from.P.end());
  to.N.insert(to.N.end(), from.N.begin(), from.N.end());
  to.laterP.resize(from.laterP.size());
  for (size_t k = 0; k < from.laterP.size(); ++k)
    to.laterP[k].insert(to.laterP[k].end(), from.laterP[k].begin(), from.laterP[k].end());
  for (const Quad& q : from.quads) to.quads.push_back({q[0] + vertex, q[1] + vertex, q[2] + vertex, q[3] + vertex});
  for (const uint32_t l : from.latticeOfQuad) to.latticeOfQuad.push_back(l + lattice);
  for (Lattice l : from.lattices) {
    l.firstQuad += quad;
    to.lattices.push_back(l);
  }
  to.trimmed |= from.trimmed;
  to.onlyCoarse += from.onlyCoarse;
  to.deviation = std::max(to.deviation, from.deviation);
  to.coarseDeviation = std::max(to.coarseDeviation, from.coarseDeviation);
}

/// Frees memory that growing reserved beyond need; Embree reads 16 bytes at the last position.
void fit(CoarseGroup& g) {
  const auto exactly = [](std::vector<vec3>& v, size_t spare) {
    std::vector<vec3> out;
    out.reserve(v.size() + spare);
    out.assign(v.begin(), v.end());
    v = std::move(out);
  };
  if (g.P.empty()) return;
  exactly(g.P, 1);
  exactly(g.N, 0);
  for (std::vector<vec3>& later : g.laterP) exactly(later, 1);
  g.quads.shrink_to_fit();
  g.latticeOfQuad.shrink_to_fit();
  g.lattices.shrink_to_fit();
}

/// A run of patches of one object, which one thread tessellates at a time.
struct Work {
  int object;
  uint32_t first, last;
};

void addWork(const Scene& scene, size_t object, std::vector<Work>& work) {
  constexpr uint32_t kPatchesAtOnce = 256;
  const uint32_t patches = scene.objects[object].shape().patchCount();
  for (uint32_t p = 0; p < patches; p += kPatchesAtOnce)
    work.push_back({static_cast<int>(object), p, std::min(p + kPatchesAtOnce, patches)});
}

/// Returns the patches of all objects that rays need and that are not elsewhere.
std::vector<Work> workOf(const Scene& scene, const std::vector<bool>& elsewhere) {
  std::vector<Work> work;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    // An object that no ray sees may still cut its solid.
    const bool needed = scene.objects[i].solid >= 0 || raysNeed(*scene.objects[i].attributes);
    if (needed && (elsewhere.empty() || !elsewhere[i])) addWork(scene, i, work);
  }
  return work;
}

double countQuads(const Scene& scene, const Camera& camera, const std::vector<Work>& work, float longer) {
  std::vector<double> counts(work.size());
  parallelFor(work.size(), 1, [&](size_t begin, size_t end) {
    for (size_t w = begin; w < end; ++w)
      for (uint32_t p = work[w].first; p < work[w].last; ++p) {
        const CoarseRate rate = coarseRate(scene, camera, work[w].object, p, longer, nullptr);
        counts[w] += 1.0 * rate.nu * rate.nv;
      }
  });
  return std::accumulate(counts.begin(), counts.end(), 0.0);
}

float diagonalOf(const Object& o) {
  Bound3 bound;
  for (uint32_t p = 0; p < o.shape().patchCount(); ++p) bound.extend(o.shape().bound(p, UvRect{}));
  const Bound3 camera = transformBound(o.cameraFromObject.at(o.keyTimes.front()), bound);
  return camera.empty() ? 0.0f : glm::length(camera.size());
}

enum class Patches { All, WithoutLevels, WithLevels };

/// Returns a part of the result for each piece of work.
std::vector<CoarseGroup> tessellateAll(const Scene& scene, const Camera& camera, const ShadingSystem& shading,
                                       const std::vector<Work>& work, Patches which, float longer, Log& log) {
  std::vector<CoarseGroup> pieces(work.size());
  const Tessellator tessellator(scene, camera, shading, longer, log);
  const auto wanted = [&](int object, uint32_t patch) {
    const Object& o = scene.objects[static_cast<size_t>(object)];
    const bool withLevels = which == Patches::WithLevels;
    if (withLevels && o.attributes->trace.rate != TessellationMode::Multiresolution)
      return false;  // other modes have no coarse polygons that rays see
    return which == Patches::All || hasLevels(o, patch, tessellator.moves(object)) == withLevels;
  };
  parallelFor(work.size(), 1, [&](size_t begin, size_t end) {
    for (size_t w = begin; w < end; ++w)
      for (uint32_t p = work[w].first; p < work[w].last; ++p)
        if (wanted(work[w].object, p)) tessellator.addPatch(work[w].object, p, pieces[w]);
  });
  if (which == Patches::WithLevels)
    for (CoarseGroup& piece : pieces) {
      piece.onlyCoarse = piece.quads.size();
      piece.coarseDeviation = std::exchange(piece.deviation, 0.0f);
    }
  return pieces;
}

}  // namespace

void reportNotFinite(const Object& object, Log& log) {
  log.report(Severity::Warning, "trace-not-finite", object.where,
             fmt::format("{} has points that are not finite: rays pass through that part", objectName(object)));
}

bool raysNeed(const Attributes& a) {
  const Visibility& v = a.visibility;
  if (a.volume) return false;
  return v.diffuse || v.specular || v.transmission || v.photon || a.areaLight >= 0;
}

std::vector<CoarseGroup> tessellate(const Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log,
                                    const std::vector<bool>& elsewhere, float longer) {
  const std::vector<Work> work = workOf(scene, elsewhere);
  std::vector<CoarseGroup> groups(scene.groups.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    groups[g].detail = scene.groups[g].attributes->detail;
    groups[g].solid = scene.groups[g].solid;
  }
  for (const Work& w : work) {
    const Object& o = scene.objects[static_cast<size_t>(w.object)];
    CoarseGroup& group = groups[static_cast<size_t>(o.group)];
    group.flipsNormal = o.flipsNormal != o.subtracted;
    if (w.first == 0) group.size = std::max(group.size, diagonalOf(o));
  }
  const bool anyLevels = std::any_of(scene.groups.begin(), scene.groups.end(), [](const ShadeGroup& g) {
    return g.attributes->trace.rate == TessellationMode::Multiresolution;
  });
  for (const Patches which : {Patches::WithoutLevels, Patches::WithLevels}) {
    if (which == Patches::WithLevels && !anyLevels) break;
    std::vector<CoarseGroup> pieces = tessellateAll(scene, camera, shading, work, which, longer, log);
    for (size_t w = 0; w < work.size(); ++w) {
      if (!pieces[w].P.empty())
        append(groups[static_cast<size_t>(scene.objects[static_cast<size_t>(work[w].object)].group)], pieces[w]);
      pieces[w] = {};
    }
  }
  for (CoarseGroup& group : groups) fit(group);
  return groups;
}

float edgesThatFit(const Scene& scene, const Camera& camera, const std::vector<bool>& elsewhere, size_t bytes,
                   Log& log) {
  const std::vector<Work> work = workOf(scene, elsewhere);
  const double most = std::max(1.0, static_cast<double>(bytes) / kBytesOfQuad);
  const double asked = countQuads(scene, camera, work, 1);
  float longer = 1;
  double count = asked;
  for (int attempt = 0; attempt < kMostAttemptsToFit && count > most; ++attempt) {
    longer *= static_cast<float>(std::max(kLeastLonger, std::pow(count / most, kPowerToFit)));
    count = countQuads(scene, camera, work, longer);
  }
  if (longer > 1)
    log.report(
        Severity::Warning, "trace-memory", {},
        fmt::format("the {:.2g} million polygons that rays would meet need more memory than --memory-limit leaves "
                    "them: they are {:.2g} million, and their edges {:.2g} times as long",
                    asked / 1e6, count / 1e6, longer));
  return longer;
}

CoarseGroup tessellateObject(const Scene& scene, const Camera& camera, const ShadingSystem& shading, int object,
                             Log& log) {
  std::vector<Work> work;
  addWork(scene, static_cast<size_t>(object), work);
  const Object& o = scene.objects[static_cast<size_t>(object)];
  CoarseGroup out;
  out.flipsNormal = o.flipsNormal;
  out.size = diagonalOf(o);
  for (const CoarseGroup& piece : tessellateAll(scene, camera, shading, work, Patches::All, 1, log)) append(out, piece);
  fit(out);
  return out;
}

}  // namespace tomales
