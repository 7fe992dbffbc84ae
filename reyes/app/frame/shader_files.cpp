#include "reyes/app/frame/shader_files.h"

#include "reyes/base/search_path.h"
#include "reyes/rsl_host.h"
#include "reyes/world_sum.h"

namespace tomales {

ShaderFiles shaderFilesOf(const Scene& scene, ShaderRegistry& shaders) {
  ShaderFiles out;
  const std::string path = pathOf(scene.options.searchPaths, "shader");
  std::set<const ShaderCall*> seen;
  std::vector<ShaderName> names;
  std::set<std::tuple<std::string, TmKind, std::string>> known;  // ten thousand lights may name one shader
  const auto add = [&](const ShaderCall* call, TmKind kind) {
    if (!call || !seen.insert(call).second) return;
    for (const Param& p : call->params) out.names.insert(p.strings.begin(), p.strings.end());
    std::string beside = call->where.folder().string();
    if (known.emplace(call->name, kind, beside).second) names.push_back({call->name, kind, std::move(beside)});
  };
  for (const auto& light : scene.lights) add(&light->shader, TM_LIGHT);
  if (scene.options.imager) add(&*scene.options.imager, TM_IMAGER);
  for (const ShadeGroup& group : scene.groups) {
    const Attributes& a = *group.attributes;
    add(a.surface.get(), TM_SURFACE);
    add(a.displacement.get(), TM_DISPLACEMENT);
    for (const auto& volume : {a.atmosphere, a.interior, a.exterior}) add(volume.get(), TM_VOLUME);
  }
  shaders.prepare(names, path);
  for (const ShaderName& n : names) {
    const TmShader* shader = shaders.find(n.name, n.kind, path, n.beside);
    if (!shader) continue;
    for (std::string& file : shaders.filesOf(*shader)) out.files.insert(std::move(file));
    RslReads reads = rslReads(*shader);
    out.isKnown &= reads.isKnown;
    out.names.insert(reads.names.begin(), reads.names.end());
  }
  return out;
}

std::vector<std::string> picturesOf(const ShaderFiles& files, const Scene& scene) {
  std::vector<std::string> out;
  for (const std::string& name : files.names)
    for (const std::string& tile : tilesOfPicture(name))
      if (std::string path = findFile(tile, pathOf(scene.options.searchPaths, "texture")); !path.empty())
        out.push_back(std::move(path));
  return out;
}

}  // namespace tomales
