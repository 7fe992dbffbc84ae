#include "reyes/app/commands/scene_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "reyes/app/commands/scene_needs.h"
#include "reyes/app/settings.h"

namespace tomales {
namespace {

Json frameInfo(const Scene& scene) {
  std::set<std::string> shaders;
  int64_t patches = 0;
  for (const Object& object : scene.objects) {
    patches += object.shape().patchCount();
    for (const auto& call : {object.attributes->surface, object.attributes->displacement})
      if (call) shaders.insert(call->name);
  }
  for (const auto& light : scene.lights) shaders.insert(light->shader.name);
  Json displays = Json::array();
  for (const DisplayCall& d : scene.options.displays)
    displays.push_back({{"name", d.name}, {"type", d.type}, {"mode", d.mode}});
  return {{"frame", scene.options.frame},
          {"resolution", {scene.options.xResolution, scene.options.yResolution}},
          {"pixel_samples", {scene.options.xSamples, scene.options.ySamples}},
          {"objects", scene.objects.size()},
          {"procedurals", scene.procedurals.size()},
          {"patches", patches},
          {"lights", scene.lights.size()},
          {"shade_groups", scene.groups.size()},
          {"shaders", shaders},
          {"displays", displays}};
}

}  // namespace

Json sceneInfo(const std::string& file, const Trust& trust, Log& log) {
  Json frames = Json::array();
  SceneNeeds needs(pluginTrust(trust), log);
  RibSettings rib;
  rib.trust = trust;
  rib.onFile = [&](const FileUse& use) { needs.add(use); };
  rib.onMake = [&](const Request& request) { needs.addMade(request); };
  rib.onScene = [&](Scene&& scene) {
    needs.add(scene);
    frames.push_back(frameInfo(scene));
  };
  readRib({file}, rib, log);
  Json all = needs.json();
  const int64_t missing = missingOf(all);
  return {{"file", file}, {"kind", "rib"}, {"frames", frames}, {"needs", std::move(all)}, {"missing", missing}};
}

int64_t missingOf(const Json& needs) {
  return std::count_if(needs.begin(), needs.end(), [](const Json& n) { return !n.at("found").get<bool>(); });
}

void printNeeds(const Json& needs) {
  for (const bool found : {true, false})
    for (const Json& n : needs) {
      if (n.at("found").get<bool>() != found) continue;
      const std::string hint = n.contains("hint") ? "; " + n.at("hint").get<std::string>() : "";
      std::puts(fmt::format("{:8} {:12} {:24} {}{}", found ? "found" : "missing", n.at("kind").get<std::string>(),
                            n.at("name").get<std::string>(), n.at("from").get<std::string>(), hint)
                    .c_str());
    }
  std::puts(fmt::format("missing: {} of {}", missingOf(needs), needs.size()).c_str());
}

}  // namespace tomales
