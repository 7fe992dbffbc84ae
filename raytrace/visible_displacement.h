// Verb: chooses the objects whose displacement rays see, among those that Attribute "trace" "displacements" does not
// name.
//   in     a scene whose procedurals are open, and its bound shaders
//   out    Attributes::trace of objects and groups: displacements, and a finer tessellation
//   never  depends on threads or on the crop
// Rule: rays see a displacement that moves a point of a patch in view by a pixel or more, and polygons for rays are
// then a quarter as long, so that they follow the bumps. Where such polygons would be more than the pixels of the
// picture they are longer, up to the usual length. Where even these are too many, or longer than 32 pixels before the
// eye, rays see the smooth surface, and a warning says so (docs/decisions/0162).
#pragma once
#include "reyes/camera.h"
#include "reyes/shade.h"

namespace tomales {

/// Call it before the RayScene is made. Threads: nobody else may use the scene meanwhile.
void chooseDisplacements(Scene& scene, const Camera& camera, const ShadingSystem& shading, Log& log);

}  // namespace tomales
