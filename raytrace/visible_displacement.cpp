#include "raytrace/visible_displacement.h"

#include <fmt/format.h>

#include <map>

#include "raytrace/tessellate.h"
#include "reyes/base/parallel.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

constexpr float kVisible_px = 1;
constexpr float kFiner =
    4;  ///< Polygons of 16 pixels cut the tops off bumps that are as wide (docs/measured/truth.md).
/// All polygons of chosen objects are no more than the pixels of the picture, or than this.
constexpr double kAlwaysQuads = 1 << 17;
/// A displacement is measured at about so many points of a group.
constexpr size_t kProbedPoints = 4096, kProbedPatches = 64;
constexpr int kFewestCells = 4, kMostCells = 32;  ///< Of a probed patch, along u and v.

bool isUndecided(const Attributes& a) {
  return a.displacement && !a.trace.displacements && !a.user.contains("trace:displacements") && raysNeed(a);
}

struct PatchOfObject {
  int object;
  uint32_t patch;
};

/// The longest way in pixels that the displacement moves a point of the patch that is in view.
float amplitudeOf(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const PatchOfObject& at,
                  int cells) {
  Grid grid = dice(scene, at.object, at.patch, UvRect{}, cells, cells, 1);
  std::vector<vec3> before;
  for (int i = 0; i < grid.vertexCount(); ++i) before.push_back(grid.position(0, i));
  shading.displace(grid);
  float longest = 0;
  for (int i = 0; i < grid.vertexCount(); ++i) {
    const vec3 p = grid.position(0, i), way = p - before[static_cast<size_t>(i)];
    Bound3 point;
    point.extend(p);
    if (!camera.outside(point, {0, 0, camera.xResolution(), camera.yResolution()}))
      longest = std::max(longest, glm::length(way) / std::max(camera.pixelSize(p), 1e-20f));
  }
  return std::isfinite(longest) ? longest : 0;
}

/// Chooses group after group, until polygons for rays are as many as there may be.
class Chooser {
 public:
  Chooser(Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log)
      : scene_(scene),
        camera_(camera),
        shading_(shading),
        log_(log),
        patches_(scene.groups.size()),
        amplitudes_(scene.groups.size()),
        quadsLeft_(std::max(kAlwaysQuads, 1.0 * camera.xResolution() * camera.yResolution())) {
    for (size_t i = 0; i < scene_.objects.size(); ++i) {
      const Object& o = scene_.objects[i];
      if (!isUndecided(*o.attributes) || !o.attributes->visibility.camera) continue;
      for (uint32_t p = 0; p < o.shape().patchCount(); ++p)
        patches_[static_cast<size_t>(o.group)].push_back({static_cast<int>(i), p});
    }
  }

  void choose() {
    parallelFor(patches_.size(), 1, [&](size_t begin, size_t end) {
      for (size_t g = begin; g < end; ++g) amplitudes_[g] = measured(patches_[g]);
    });
    for (size_t g = 0; g < patches_.size(); ++g)
      if (amplitudes_[g] >= kVisible_px) choose(g);
  }

 private:
  float measured(const std::vector<PatchOfObject>& patches) const {
    if (patches.empty()) return 0;
    const size_t probed = std::min(patches.size(), kProbedPatches);
    const int cells = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(kProbedPoints / probed))) - 1,
                                 kFewestCells, kMostCells);
    float longest = 0;
    for (size_t k = 0; k < probed; ++k)
      longest = std::max(longest, amplitudeOf(scene_, camera_, shading_, patches[k * patches.size() / probed], cells));
    return longest;
  }

  void choose(size_t g) {
    const std::shared_ptr<const Attributes> given = scene_.groups[g].attributes;
    for (float finer = kFiner; finer >= 1; finer /= 2) {
      dress(g, changed(given, finer));
      const double quads = countQuads(g);
      if (quads > quadsLeft_) continue;
      quadsLeft_ -= quads;
      return;
    }
    dress(g, given);
    const Object& o = scene_.objects[static_cast<size_t>(patches_[g].front().object)];
    log_.report(
        Severity::Warning, "trace-displacement", o.where,
        fmt::format("{}: rays do not see its displacement of {:.0f} pixels, because that takes more polygons than "
                    "the picture has pixels; its shadows on itself are those of the smooth surface. Attribute "
                    "\"trace\" \"displacements\" 1 or 0 chooses",
                    objectName(o), amplitudes_[g]),
        o.where.text());
  }

  std::shared_ptr<const Attributes> changed(const std::shared_ptr<const Attributes>& given, float finer) {
    std::shared_ptr<const Attributes>& out = changed_[{given, finer}];
    if (!out) {
      auto copy = std::make_shared<Attributes>(*given);
      copy->trace.displacements = true, copy->trace.tessellation *= finer;
      out = std::move(copy);
    }
    return out;
  }

  void dress(size_t g, const std::shared_ptr<const Attributes>& attributes) {
    scene_.groups[g].attributes = attributes;
    int last = -1;
    for (const PatchOfObject& p : patches_[g])
      if (p.object != last) scene_.objects[static_cast<size_t>(last = p.object)].attributes = attributes;
  }

  /// Stops at the number that is left.
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
  std::vector<std::vector<PatchOfObject>> patches_;  ///< Indexed by group, as amplitudes_ is.
  std::vector<float> amplitudes_;                    ///< In pixels.
  double quadsLeft_;
  std::map<std::pair<std::shared_ptr<const Attributes>, float>, std::shared_ptr<const Attributes>> changed_;
};

}  // namespace

void chooseDisplacements(Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log) {
  const auto undecided = [](const ShadeGroup& g) { return isUndecided(*g.attributes); };
  if (std::ranges::any_of(scene.groups, undecided)) Chooser(scene, camera, shading, log).choose();
}

}  // namespace tomales
