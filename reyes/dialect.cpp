#include "reyes/dialect.h"

namespace tomales {

bool isMadeForBmrt(const Scene& scene) {
  const auto& options = scene.options.user;
  for (const char* key : {"limits:bucketsize", "limits:gridsize", "limits:eyesplits"})
    if (options.contains(key)) return false;
  for (const char* key : {"render:max_raylevel", "render:minshadowbias", "render:use_hierarchy"})
    if (options.contains(key)) return true;
  const auto has = [](const std::map<std::string, Param>& user, std::string_view category) {
    const auto first = user.lower_bound(std::string(category));
    return first != user.end() && first->first.starts_with(category);
  };
  if (has(options, "radiosity:")) return true;
  for (const ShadeGroup& group : scene.groups)
    if (has(group.attributes->user, "radiosity:") || has(group.attributes->user, "render:")) return true;
  return false;
}

}  // namespace tomales
