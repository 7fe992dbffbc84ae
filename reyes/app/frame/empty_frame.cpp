#include "reyes/app/frame/empty_frame.h"

#include <fmt/format.h>

#include <algorithm>

#include "reyes/camera_bound.h"

namespace tomales {
namespace {

/// Returns in words which side of the view `bound` is outside of. oneSided: Sides 1 hides something.
std::string sideOf(const Bound3& bound, const Camera& camera, bool oneSided) {
  if (bound.hi.z < camera.nearClip())
    return bound.hi.z < 0 ? "behind the camera, which looks along +z" : "nearer than the near clipping plane";
  if (bound.lo.z > camera.farClip()) return "beyond the far clipping plane";
  const std::string turned = oneSided ? "turned away from the camera (Sides 1), " : "";
  return "outside the view, clipped, " + turned + "or too thin to meet a sample";
}

}  // namespace

void explainEmptyFrame(const Scene& scene, Log& log) {
  const bool whole = scene.options.cropWindow == Options().cropWindow;
  if (!whole || !hasGeometry(scene)) return;
  const Camera camera(scene.options);
  size_t unseen = 0;
  bool oneSided = false;
  Bound3 bound;
  for (const Object& object : scene.objects)
    if (object.attributes->visibility.camera) {
      bound.extend(cameraBound(object));
      oneSided |= object.attributes->sides == 1;
    } else {
      ++unseen;
    }
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
        sideOf(bound, camera, oneSided), bound.lo.x, bound.lo.y, bound.lo.z, bound.hi.x, bound.hi.y, bound.hi.z);
  log.report(Severity::Missing, "frame-empty", scene.where, "nothing is visible in this frame: " + why);
}

bool cropHasPixels(const Scene& scene, Log& log) {
  const Camera camera(scene.options);
  const PixelRect crop = camera.crop();
  if (crop.width() > 0 && crop.height() > 0) return true;
  const auto& w = scene.options.cropWindow;
  log.report(Severity::Missing, "crop-empty", scene.where,
             fmt::format("CropWindow {:g} {:g} {:g} {:g} holds none of the {} x {} pixels; there is no picture of it",
                         w[0], w[1], w[2], w[3], camera.xResolution(), camera.yResolution()));
  return false;
}

}  // namespace tomales
