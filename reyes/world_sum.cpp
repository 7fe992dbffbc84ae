#include "reyes/world_sum.h"

#include <filesystem>

#include "reyes/base/file_guesses.h"
#include "reyes/base/file_stamp.h"
#include "reyes/base/search_path.h"
#include "reyes/pictures.h"
#include "reyes/scene_changes.h"
#include "reyes/state_fields.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Sums of files that have been looked for: many lights name one shader, and many surfaces one picture.
struct Stamps {
  std::map<fs::path, uint64_t> files{};
  std::map<std::string, uint64_t> pictures{};
};

/// A checksum to which shaders add facts about the files that they name, and not their locations.
struct WorldSum : ContentSum {
  std::map<std::string, std::string> searchPaths{};
  std::shared_ptr<Stamps> stamps{};
  uint64_t stampOf(const fs::path& file) const {
    const auto [it, isNew] = stamps->files.try_emplace(file, 0);
    if (isNew) it->second = fileStamp(file);
    return it->second;
  }
  uint64_t stampsOf(const std::string& picture) const {
    const auto [it, isNew] = stamps->pictures.try_emplace(picture, 0);
    if (isNew) it->second = stampsOfPicture(picture, pathOf(searchPaths, "texture"));
    return it->second;
  }
};

/// Adds every file that a shader's name may stand for, along the search path and in `beside`.
void addShaderFile(WorldSum& sum, const std::string& name, const std::string& beside) {
  std::vector<std::string> folders = foldersOf(pathOf(sum.searchPaths, "shader"));
  folders.insert(folders.begin(), ".");
  if (beside != ".") folders.push_back(beside);
  for (const fs::path folder : folders) {
    uint64_t stamp = name.empty() ? 0 : sum.stampOf(folder / name);
    if (stamp != 0) each(sum, stamp);
  }
}

void fields(WorldSum& a, ShaderCall& x) {
  each(a, x.name, x.params, x.worldFromShader);
  const std::string beside = x.where.folder().string();
  for (const char* ending : {".so", ".sl"}) addShaderFile(a, x.name + ending, beside.empty() ? "." : beside);
  for (const Param& p : x.params)
    for (const std::string& s : p.strings)
      if (uint64_t stamps = a.stampsOf(s)) each(a, stamps);
}

}  // namespace

uint64_t stampsOfPicture(const std::string& name, const std::string& searchPath) {
  uint64_t sum = 0;
  if (name.empty()) return sum;
  const auto add = [&](const std::string& file) {
    for (const std::string& candidate : candidateFiles(file, searchPath, textureEndings()))
      if (const uint64_t stamp = fileStamp(candidate)) sum = contentSum(sum, uint64_t{stamp});
  };
  add(name);
  for (const std::string_view mark : {"<UDIM>", "_MAPID_"})
    if (const size_t at = name.find(mark); at != std::string::npos)
      for (int tile = 1001; tile <= 1100; ++tile) add(std::string(name).replace(at, mark.size(), std::to_string(tile)));
  return sum;
}

uint64_t worldSum(const Scene& scene, bool photonsOnly) {
  WorldSum sum;
  sum.stamps = std::make_shared<Stamps>();
  sum.searchPaths = scene.options.searchPaths;
  Options options = scene.options;
  options.searchPaths.erase("texturecache");
  std::erase_if(options.user, [](const auto& o) {  // options of memory, and of the order of work
    return o.first.starts_with("limits:") || o.first.starts_with("bucket:");
  });
  std::map<std::string, mat4> spaces = scene.worldFromNamed;  // without openings: another camera finds different ones
  each(sum, options.searchPaths, options.user, options.shutterOpen, options.shutterClose, options.maxRayDepth, spaces);
  for (std::shared_ptr<LightCall> light : scene.lights) field(sum, light);
  std::map<std::shared_ptr<const Attributes>, uint64_t> known;
  std::vector<uint64_t> solids;
  for (const Solid& solid : scene.solids) {
    uint64_t blocks = 0;
    for (int b = 0; b < solid.blockCount(); ++b) blocks = contentSum(blocks, solid.operation(b), solid.parent(b));
    solids.push_back(blocks);
  }
  uint64_t objects = 0;
  for (const Object& o : scene.objects) {
    // Photons start at an area light even if they do not meet it.
    if (photonsOnly && !o.attributes->visibility.photon && o.attributes->areaLight < 0) continue;
    auto [attributes, isNew] = known.try_emplace(o.attributes, 0);
    if (isNew) {
      WorldSum part;
      part.stamps = sum.stamps;
      part.searchPaths = scene.options.searchPaths;
      std::shared_ptr<const Attributes> shared = asTheSceneSays(o.attributes);
      field(part, shared);
      attributes->second = part.sum;
    }
    objects += contentSum(attributes->second, o.contents, o.shapeTimes, o.worldFromObject, o.solid, o.solidBlock,
                          o.solid < 0 ? 0 : solids[static_cast<size_t>(o.solid)]);
  }
  field(sum, objects);
  return sum.sum;
}

}  // namespace tomales
