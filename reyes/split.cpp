#include "reyes/split.h"

#include <fmt/format.h>

#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr int kProbes = 4;        ///< Measuring lattice: kProbes x kProbes chords.
constexpr int kMaxDepth = 48;     ///< Halvings of one patch; beyond, the piece is smaller than a float can name.
constexpr int kMaxEyeSplits = 32; ///< Halvings of a piece that crosses the eye plane in view.
constexpr float kRasterMargin_px = 1.0f;  ///< The hider may push borders out by half a pixel.

/// Box in camera space around a rectangle, over the shutter, displacement included.
Bound3 cameraBound(const Object& o, uint32_t patch, const UvRect& rect) {
  Bound3 object;
  for (const PrimPtr& shape : o.shapes) object.extend(shape->bound(patch, rect));
  Bound3 camera;
  for (const float t : o.keyTimes) camera.extend(transformBound(o.cameraFromObject.at(t), object));
  return camera.grown(o.displacementBound);
}

std::pair<UvRect, UvRect> halves(const UvRect& r, bool alongU) {
  UvRect a = r, b = r;
  if (alongU)
    a.u1 = b.u0 = 0.5f * (r.u0 + r.u1);
  else
    a.v1 = b.v0 = 0.5f * (r.v0 + r.v1);
  return {a, b};
}

int cells(float length_px, float edge_px) {
  const float n = std::ceil(length_px / edge_px);
  return n >= 1.0f ? static_cast<int>(std::min(n, 65536.0f)) : 1;
}

/// Splits the patches of one object.
class Splitter {
 public:
  Splitter(const Scene& scene, int object, const Camera& camera, const PixelRect& window, Stats& stats)
      : object_(scene.objects[static_cast<size_t>(object)]), index_(object), gridSize_(scene.options.gridSize),
        camera_(camera), window_(window), stats_(stats),
        edge_px_(std::sqrt(std::max(object_.attributes->shadingRate, 1e-4f))) {}

  void split(uint32_t patch, const UvRect& rect, int depth, int eyeSplits, std::vector<SubPatch>& out) {
    const Bound3 bound = cameraBound(object_, patch, rect);
    if (!isFinite(bound.lo) || !isFinite(bound.hi) || camera_.outside(bound, window_)) {
      ++stats_.geometry.culled;
      return;
    }
    Bound2 raster;
    if (!camera_.rasterBound(bound, raster)) {
      if (eyeSplits == kMaxEyeSplits) {
        ++stats_.geometry.eyeSplitsGivenUp;
        return;
      }
      const PatchSize size = measure(object_, camera_, patch, rect);
      recurse(patch, rect, size.u_length >= size.v_length, depth, eyeSplits + 1, out);
      return;
    }
    const PatchSize size = measure(object_, camera_, patch, rect);
    const int nu = cells(size.u_px, edge_px_), nv = cells(size.v_px, edge_px_);
    if (static_cast<int64_t>(nu) * nv > gridSize_ && depth < kMaxDepth) {
      recurse(patch, rect, nu >= nv, depth, eyeSplits, out);
      return;
    }
    raster.lo -= vec2(kRasterMargin_px);
    raster.hi += vec2(kRasterMargin_px);
    out.push_back({index_, patch, rect, std::min(nu, gridSize_), std::min(nv, gridSize_), raster, bound.lo.z});
  }

 private:
  void recurse(uint32_t patch, const UvRect& rect, bool alongU, int depth, int eyeSplits, std::vector<SubPatch>& out) {
    const auto [a, b] = halves(rect, alongU);
    split(patch, a, depth + 1, eyeSplits, out);
    split(patch, b, depth + 1, eyeSplits, out);
  }

  const Object& object_;
  const int index_, gridSize_;
  const Camera& camera_;
  const PixelRect& window_;
  Stats& stats_;
  const float edge_px_;
};

}  // namespace

PatchSize measure(const Object& o, const Camera& camera, uint32_t patch, const UvRect& r) {
  constexpr int kRow = kProbes + 1, kCount = kRow * kRow;
  float u[kCount], v[kCount], data[12][kCount];
  for (int j = 0, k = 0; j < kRow; ++j)
    for (int i = 0; i < kRow; ++i, ++k) {
      u[k] = lerp(r.u0, r.u1, static_cast<float>(i) / kProbes);
      v[k] = lerp(r.v0, r.v1, static_cast<float>(j) / kProbes);
    }
  o.shape().evaluate(patch, kCount, u, v,
                     {data[0], data[1], data[2], data[3], data[4], data[5], data[6], data[7], data[8], data[9], data[10], data[11]});
  const mat4 m = o.cameraFromObject.at(o.keyTimes.front());
  vec3 p[kCount];
  vec2 raster[kCount];
  for (int k = 0; k < kCount; ++k) {
    p[k] = transformPoint(m, {data[0][k], data[1][k], data[2][k]});
    const vec3 inFront(p[k].x, p[k].y, std::max(p[k].z, camera.nearClip()));
    raster[k] = camera.perspective() ? camera.raster(inFront) : camera.raster(p[k]);
  }
  PatchSize size{0, 0, 0, 0};
  const bool rasterOrient = o.attributes->rasterOrient;
  for (int line = 0; line < kRow; ++line) {
    float du_px = 0, dv_px = 0, du = 0, dv = 0;
    for (int k = 0; k < kProbes; ++k) {
      const int a = line * kRow + k, b = k * kRow + line;
      const float lu = glm::length(p[a + 1] - p[a]), lv = glm::length(p[b + kRow] - p[b]);
      du += lu;
      dv += lv;
      // Without rasterorient a micropolygon is as large as if it faced the camera (rispec-table 4, dice:rasterorient).
      du_px += rasterOrient ? glm::length(raster[a + 1] - raster[a]) : lu / camera.pixelSize(p[a]);
      dv_px += rasterOrient ? glm::length(raster[b + kRow] - raster[b]) : lv / camera.pixelSize(p[b]);
    }
    size.u_px = std::max(size.u_px, du_px), size.v_px = std::max(size.v_px, dv_px);
    size.u_length = std::max(size.u_length, du), size.v_length = std::max(size.v_length, dv);
  }
  return size;
}

std::vector<SubPatch> splitScene(const Scene& scene, const Camera& camera, const PixelRect& window, Stats& stats, Log& log) {
  struct Work { int object; uint32_t first, last; };
  constexpr uint32_t kPatchesAtOnce = 64;
  std::vector<Work> work;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& o = scene.objects[i];
    if (!o.attributes->visibility.camera) continue;
    ++stats.geometry.primitives;
    const uint32_t patches = o.shape().patchCount();
    for (uint32_t p = 0; p < patches; p += kPatchesAtOnce)
      work.push_back({static_cast<int>(i), p, std::min(p + kPatchesAtOnce, patches)});
  }
  std::vector<std::vector<SubPatch>> pieces(work.size());
  parallelFor(work.size(), 1, [&](size_t begin, size_t end) {
    for (size_t w = begin; w < end; ++w) {
      Splitter splitter(scene, work[w].object, camera, window, stats);
      const int64_t before = stats.geometry.eyeSplitsGivenUp;
      for (uint32_t p = work[w].first; p < work[w].last; ++p) splitter.split(p, UvRect{}, 0, 0, pieces[w]);
      if (stats.geometry.eyeSplitsGivenUp > before)
        log.report(Severity::Warning, "split-eye-plane", scene.objects[static_cast<size_t>(work[w].object)].where,
                   fmt::format("{} passes through the eye: what lies nearer than the smallest piece is not drawn; "
                               "set Clipping near by hand if it shows",
                               objectName(scene.objects[static_cast<size_t>(work[w].object)])));
    }
  });
  std::vector<SubPatch> all;
  for (auto& p : pieces) all.insert(all.end(), p.begin(), p.end());
  stats.geometry.subpatches += static_cast<int64_t>(all.size());
  return all;
}

}  // namespace tomales
