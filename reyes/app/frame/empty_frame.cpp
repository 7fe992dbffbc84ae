#include "reyes/app/frame/empty_frame.h"

#include <fmt/format.h>

#include <algorithm>

namespace tomales {
namespace {

Bound3 cameraBound(const Object& object) {
  Bound3 bound;
  for (const PrimPtr& shape : object.shapes)
    for (uint32_t patch = 0; patch < shape->patchCount(); ++patch)
      for (const mat4& cameraFromObject : object.cameraFromObject.keys)
        bound.extend(transformBound(cameraFromObject, shape->bound(patch, {})));
  return bound.empty() ? bound : bound.grown(object.displacementBound);
}

/// Says which plane of the view has all of `bound` on its wrong side.
std::string sideOf(const Bound3& bound, const Camera& camera) {
  if (bound.hi.z < camera.nearClip())
    return bound.hi.z < 0 ? "behind the camera, which looks along +z" : "nearer than the near clipping plane";
  if (bound.lo.z > camera.farClip()) return "beyond the far clipping plane";
  return "outside the view, clipped, or too thin to meet a sample";
}

}  // namespace

void explainEmptyFrame(const Scene& scene, Log& log) {
  const bool whole = scene.options.cropWindow == Options().cropWindow;
  if (!whole || !hasGeometry(scene)) return;
  const Camera camera(scene.options);
  size_t unseen = 0;
  Bound3 bound;
  for (const Object& object : scene.objects)
    if (object.attributes->visibility.camera)
      bound.extend(cameraBound(object));
    else
      ++unseen;
  std::string why;
  if (scene.objects.empty())
    why = scene.procedurals.empty() ? "there is no geometry between WorldBegin and WorldEnd"
                                    : "no procedural in view brings geometry";
  else if (unseen == scene.objects.size())
    why = fmt::format(
        "every object ({} in all) is hidden from the camera by Surface \"null\" or Attribute \"visibility\"", unseen);
  else
    why = fmt::format(
        "what the camera might see lies {}: in camera space from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
        sideOf(bound, camera), bound.lo.x, bound.lo.y, bound.lo.z, bound.hi.x, bound.hi.y, bound.hi.z);
  log.report(Severity::Missing, "frame-empty", scene.where, "nothing is to be seen in this frame: " + why);
}

}  // namespace tomales
