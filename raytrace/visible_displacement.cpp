#include "raytrace/visible_displacement.h"

#include <fmt/format.h>

#include <map>
#include <numeric>

#include "raytrace/tessellate.h"
#include "reyes/base/parallel.h"
#include "reyes/dice.h"
#include "reyes/scene_changes.h"

namespace tomales {
namespace {

constexpr float kVisible_px = 1;
/// Polygons of 16 pixels cut the tops off bumps that are as wide (docs/measured/truth.md).
constexpr int kFiner = 4;
/// All polygons of chosen objects are no more than the pixels of the picture, or than this.
constexpr double kAlwaysDisplacedQuads = 1 << 17;
/// A displacement is measured at about kProbedPoints points, in at most kProbedPatches patches of a group.
constexpr size_t kProbedPoints = 4096, kProbedPatches = 64;
constexpr int kFewestCells = 4, kMostCells = 32;  ///< Limits on the cells of a probed patch along u and v.
constexpr float kLongest_px = 32;  ///< Longer polygons do not follow the surface, and rays would start within it.
/// Greatest size of the near part of a patch, so that probes lie close together there.
constexpr float kNearPart_px = 256;
constexpr int kMostHalvings = 64;  ///< Halving never makes ground at the eye that small.

bool isUndecided(const Attributes& a) { return leavesDisplacementOpen(a) && raysNeed(a); }

struct PatchOfObject {
  int object;
  uint32_t patch;
};

/// A part of a patch in view that lies nearest to the eye: ground that reaches from the eye to the horizon has few of
/// its probes there.
struct NearPart {
  float distance = kInfinity, size_px = 0;
  float pixel = 0;  ///< Width of a pixel there.
  UvRect rect;
};

/// The distance is infinite if the part is out of view.
NearPart partOf(const Object& o, const Camera& camera, uint32_t patch, const UvRect& rect) {
  const Bound3 bound = transformBound(o.cameraFromObject.at(o.keyTimes.front()), o.shape().bound(patch, rect))
                           .grown(o.displacementBound);
  if (camera.outside(bound, {0, 0, camera.xResolution(), camera.yResolution()})) return {};
  const vec3 nearest = glm::clamp(vec3(0), bound.lo, bound.hi);
  const float pixel = std::max(camera.pixelSize(nearest), 1e-20f);
  return {glm::length(nearest), glm::length(bound.size()) / pixel, pixel, rect};
}

/// Halves the nearest part along both ways, and so on until the nearest one is small.
NearPart nearestPart(const Object& o, const Camera& camera, uint32_t patch) {
  std::vector<NearPart> parts{partOf(o, camera, patch, UvRect{})};
  for (int halvings = 0;; ++halvings) {
    const auto nearest = std::ranges::min_element(parts, {}, &NearPart::distance);
    if (nearest->size_px < kNearPart_px || nearest->distance == kInfinity || halvings == kMostHalvings) return *nearest;
    const UvRect r = std::exchange(*nearest, {}).rect;
    const float u = 0.5f * (r.u0 + r.u1), v = 0.5f * (r.v0 + r.v1);
    for (const UvRect& part :
         {UvRect{r.u0, u, r.v0, v}, UvRect{u, r.u1, r.v0, v}, UvRect{r.u0, u, v, r.v1}, UvRect{u, r.u1, v, r.v1}})
      parts.push_back(partOf(o, camera, patch, part));
  }
}

/// The effect of the displacement on a part of a patch.
struct Probe {
  PatchOfObject at;
  UvRect part;
  float amplitude_px = 0;    ///< The longest distance that it moves a point.
  float u_px = 0, v_px = 0;  ///< The longest lines along u and v of the smooth surface.
};

/// Measures the effect on one part. Pixels count as no narrower than `leastPixel`.
Probe probed(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const PatchOfObject& at,
             const UvRect& part, float leastPixel, int cells) {
  Grid grid = diceAtOpen(scene, at.object, at.patch, part, cells, cells);
  const auto inPixels = [&](const vec3& a, const vec3& b) {
    return glm::length(b - a) / std::max(camera.pixelSize(0.5f * (a + b)), leastPixel);
  };
  Probe out{at, part};
  std::vector<vec3> before;
  for (int i = 0; i < grid.vertexCount(); ++i) before.push_back(grid.position(0, i));
  for (int line = 0; line <= cells; ++line) {
    float u = 0, v = 0;
    for (int k = 0; k < cells; ++k) {
      const auto vertex = [&](int i, int j) { return before[static_cast<size_t>(j * (cells + 1) + i)]; };
      u += inPixels(vertex(k, line), vertex(k + 1, line));
      v += inPixels(vertex(line, k), vertex(line, k + 1));
    }
    out.u_px = std::max(out.u_px, u);
    out.v_px = std::max(out.v_px, v);
  }
  shading.displace(grid);
  for (int i = 0; i < grid.vertexCount(); ++i)
    out.amplitude_px = std::max(out.amplitude_px, inPixels(before[static_cast<size_t>(i)], grid.position(0, i)));
  if (!std::isfinite(out.amplitude_px)) out.amplitude_px = 0;
  return out;
}

/// The effect of the displacement on the objects of a group.
struct Relief {
  float amplitude_px = 0;
  std::vector<Probe> nearest;  ///< The near part of each patch that was probed.
};

/// Chooses group after group, the greatest displacement first, until polygons for rays are as many as there may be.
class Chooser {
 public:
  Chooser(Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log)
      : scene_(scene),
        camera_(camera),
        shading_(shading),
        log_(log),
        patches_(scene.groups.size()),
        reliefs_(scene.groups.size()),
        quadsLeft_(std::max(kAlwaysDisplacedQuads, 1.0 * camera.xResolution() * camera.yResolution())) {
    for (size_t i = 0; i < scene_.objects.size(); ++i) {
      const Object& o = scene_.objects[i];
      if (!isUndecided(*o.attributes)) continue;
      for (uint32_t p = 0; p < o.shape().patchCount(); ++p)
        patches_[static_cast<size_t>(o.group)].push_back({static_cast<int>(i), p});
    }
  }

  void choose() {
    parallelFor(patches_.size(), 1, [&](size_t begin, size_t end) {
      for (size_t g = begin; g < end; ++g) reliefs_[g] = reliefOf(patches_[g]);
    });
    std::vector<size_t> order(patches_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, std::greater{}, [&](size_t g) { return reliefs_[g].amplitude_px; });
    std::vector<size_t> left;
    for (const size_t g : order)
      if (reliefs_[g].amplitude_px >= kVisible_px && !choose(g)) left.push_back(g);
    if (!left.empty()) report(left);
  }

 private:
  Relief reliefOf(const std::vector<PatchOfObject>& patches) const {
    Relief out;
    const size_t count = std::min(patches.size(), kProbedPatches);
    if (count == 0) return out;
    const int cells = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(kProbedPoints / count))) - 1,
                                 kFewestCells, kMostCells);
    for (size_t k = 0; k < count; ++k) {
      const PatchOfObject& at = patches[k * patches.size() / count];
      const NearPart near = nearestPart(scene_.objects[static_cast<size_t>(at.object)], camera_, at.patch);
      if (near.distance == kInfinity) continue;
      out.nearest.push_back(probed(scene_, camera_, shading_, at, near.rect, near.pixel, cells));
      const Probe whole = probed(scene_, camera_, shading_, at, UvRect{}, near.pixel, cells);
      out.amplitude_px = std::max({out.amplitude_px, whole.amplitude_px, out.nearest.back().amplitude_px});
    }
    return out;
  }

  bool choose(size_t g) {
    const std::shared_ptr<const Attributes> given = scene_.groups[g].attributes;
    for (int finer = kFiner; finer >= 1; finer /= 2) {
      dress(g, changed(given, static_cast<float>(finer)));
      const double quads = countQuads(g);
      if (quads > quadsLeft_ || !isFine(reliefs_[g])) continue;
      quadsLeft_ -= quads;
      return true;
    }
    dress(g, given);
    return false;
  }

  void report(const std::vector<size_t>& left) const {
    const Object& o = scene_.objects[static_cast<size_t>(patches_[left.front()].front().object)];
    const std::string others =
        left.size() > 1 ? fmt::format(", nor those of {} more groups of objects", left.size() - 1) : "";
    log_.report(Severity::Warning, "trace-displacement", o.where,
                fmt::format("{}: rays do not see its displacement of {:.0f} pixels{}, because that takes more polygons "
                            "than the picture has pixels; shadows are those of the smooth surface. Attribute "
                            "\"trace\" \"displacements\" 1 or 0 chooses",
                            objectName(o), reliefs_[left.front()].amplitude_px, others));
  }

  std::shared_ptr<const Attributes> changed(const std::shared_ptr<const Attributes>& given, float finer) {
    std::shared_ptr<const Attributes>& out = changed_[{given, finer}];
    if (!out) out = withDisplacementForRays(*given, finer);
    return out;
  }

  void dress(size_t g, const std::shared_ptr<const Attributes>& attributes) {
    scene_.groups[g].attributes = attributes;
    int last = -1;
    for (const PatchOfObject& p : patches_[g])
      if (p.object != last) scene_.objects[static_cast<size_t>(last = p.object)].attributes = attributes;
  }

  /// Tells whether the polygons nearest to the eye are short enough to follow the surface.
  bool isFine(const Relief& relief) const {
    return std::ranges::all_of(relief.nearest, [&](const Probe& p) {
      const CoarseRate rate = coarseRate(scene_, camera_, p.at.object, p.at.patch, 1, nullptr);
      return p.u_px <= kLongest_px * static_cast<float>(rate.nu) * (p.part.u1 - p.part.u0) &&
             p.v_px <= kLongest_px * static_cast<float>(rate.nv) * (p.part.v1 - p.part.v0);
    });
  }

  /// Counts the polygons of a group. It stops when they are more than are left.
  double countQuads(size_t g) const {
    double quads = 0;
    for (const PatchOfObject& p : patches_[g]) {
      const CoarseRate rate = coarseRate(scene_, camera_, p.object, p.patch, 1, nullptr);
      quads += 1.0 * rate.nu * rate.nv;
      if (quads > quadsLeft_) break;
    }
    return quads;
  }

  Scene& scene_;
  const Camera& camera_;
  const ShadingSystem& shading_;
  Log& log_;
  std::vector<std::vector<PatchOfObject>> patches_;  ///< Indexed by group, as reliefs_ is.
  std::vector<Relief> reliefs_;
  double quadsLeft_;
  std::map<std::pair<std::shared_ptr<const Attributes>, float>, std::shared_ptr<const Attributes>> changed_;
};

}  // namespace

void chooseDisplacements(Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log) {
  const auto undecided = [](const ShadeGroup& g) { return isUndecided(*g.attributes); };
  if (std::ranges::any_of(scene.groups, undecided)) Chooser(scene, camera, shading, log).choose();
}

}  // namespace tomales
