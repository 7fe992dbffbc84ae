#include "reyes/frame/matte_names.h"

#include "reyes/frame.h"

namespace tomales {

MatteNames matteNames(const Scene& scene) {
  MatteNames out;
  for (const ShadeGroup& group : scene.groups) {
    const Attributes& a = *group.attributes;
    const Param* given = findParam(a.user, "identifier:shadinggroup");
    const std::string surface = a.surface ? a.surface->name : "defaultsurface";
    out.materials.push_back(given && !given->strings.empty() ? given->strings[0] : surface);
    out.objects.push_back(a.name.empty() ? objectName(group) : a.name);
  }
  return out;
}

}  // namespace tomales
