#include "raytrace/shared_shapes.h"

#include <map>

namespace tomales {
namespace {

/// A handful of polygons costs less in its group than as an instance.
constexpr uint32_t kFewPatches = 16;

bool isAffine(const mat4& m) { return m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1; }

bool mayShare(const Object& o) {
  const Attributes& a = *o.attributes;
  return raysNeed(a) && o.shapes.size() == 1 && !o.cameraFromObject.moving() && a.areaLight < 0 && o.solid < 0 &&
         a.detail.whole() && !displacesForRays(o) && o.shape().patchCount() > kFewPatches &&
         isAffine(o.cameraFromObject.keys.front());
}

/// Returns an upper bound of the factor by which lengths grow: the Frobenius norm, exact within sqrt(3).
float growth(const mat3& m) {
  const float columns = dot(m[0], m[0]) + dot(m[1], m[1]) + dot(m[2], m[2]);
  const float even = std::sqrt(columns / 3);  // exact for rotations with uniform scale
  const mat3 square = glm::transpose(m) * m;
  const bool isEven = std::abs(square[0][1]) + std::abs(square[0][2]) + std::abs(square[1][2]) +
                          std::abs(square[0][0] - square[1][1]) + std::abs(square[0][0] - square[2][2]) <=
                      1e-4f * columns;
  return isEven ? even * 1.0001f : std::sqrt(columns);
}

Bound3 wholeBound(const Prim& prim) {
  Bound3 bound;
  for (uint32_t p = 0; p < prim.patchCount(); ++p) bound.extend(prim.bound(p, UvRect{}));
  return bound;
}

/// Ordering key for how large an object looks in pixels; objects in view count as larger than those out of view.
std::pair<bool, float> looks(const Object& o, const Bound3& bound, const Camera& camera) {
  const Bound3 box = transformBound(o.cameraFromObject.keys.front(), bound);
  const vec3 nearest = glm::clamp(vec3(0), box.lo, box.hi);
  const bool seen =
      o.attributes->visibility.camera && !camera.outside(box, {0, 0, camera.xResolution(), camera.yResolution()});
  return {seen, glm::length(box.size()) / (std::max(camera.pixelSize(nearest), 1e-20f) *
                                           std::sqrt(std::max(o.attributes->shadingRate, 1e-4f)))};
}

/// Moves a mesh from current space to that of the object, in double precision: every instance shows its rounding
/// errors.
void toObjectSpace(const mat4& cameraFromObject, bool flipsNormal, CoarseGroup& mesh) {
  const glm::dmat4 inverse = glm::inverse(glm::dmat4(cameraFromObject));
  const mat3 normals = glm::transpose(mat3(cameraFromObject));
  for (vec3& p : mesh.P) p = vec3(inverse * glm::dvec4(p, 1));
  for (vec3& n : mesh.N) n = normalizeOr(normals * n, n);
  mesh.flipsNormal = flipsNormal;
}

}  // namespace

SharedShapes shareShapes(const Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log) {
  // Objects with the same shape and orientation, in order.
  std::map<std::pair<PrimPtr, bool>, std::vector<int>> alike;
  for (size_t i = 0; i < scene.objects.size(); ++i)
    if (const Object& o = scene.objects[i]; mayShare(o))
      alike[{o.shapes[0], o.attributes->insideOut}].push_back(static_cast<int>(i));
  std::vector<const std::vector<int>*> uses;
  for (const auto& [key, objects] : alike)
    if (objects.size() > 1) uses.push_back(&objects);
  // The map is sorted by addresses, which differ from run to run.
  std::sort(uses.begin(), uses.end(), [](const auto* a, const auto* b) { return a->front() < b->front(); });

  SharedShapes out;
  out.shared.resize(scene.objects.size());
  for (const std::vector<int>* objects : uses) {
    const auto object = [&](int i) -> const Object& { return scene.objects[static_cast<size_t>(i)]; };
    const Bound3 bound = wholeBound(object(objects->front()).shape());
    const int largest = *std::max_element(objects->begin(), objects->end(), [&](int a, int b) {
      return looks(object(a), bound, camera) < looks(object(b), bound, camera);
    });
    CoarseGroup& mesh = out.masters.emplace_back(tessellateObject(scene, camera, shading, largest, log));
    const mat4 cameraFromLargest = object(largest).cameraFromObject.keys.front();
    toObjectSpace(cameraFromLargest, object(largest).attributes->insideOut, mesh);
    const float shrink = growth(mat3(glm::inverse(cameraFromLargest)));
    mesh.deviation *= shrink;
    mesh.size *= shrink;
    for (const int i : *objects) {
      const mat4& m = object(i).cameraFromObject.keys.front();
      out.instances.push_back({i, static_cast<uint32_t>(object(i).group), static_cast<uint32_t>(out.masters.size() - 1),
                               m, glm::transpose(glm::inverse(mat3(m)))});
      out.shared[static_cast<size_t>(i)] = true;
    }
  }
  return out;
}

void addFigures(const SharedShapes& shapes, std::vector<CoarseGroup>& groups) {
  for (const CoarseInstance& instance : shapes.instances) {
    const CoarseGroup& mesh = shapes.masters[instance.master];
    const float grow = growth(mat3(instance.cameraFromObject));
    CoarseGroup& group = groups[instance.group];
    group.deviation = std::max(group.deviation, mesh.deviation * grow);
    group.size = std::max(group.size, mesh.size * grow);
  }
}

}  // namespace tomales
