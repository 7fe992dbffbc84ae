#include "gi/radiosity_bricks.h"

#include <array>
#include <map>

#include "gi/radiosity/bake.h"
#include "gi/world_from_current.h"
#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr size_t kRunsPerWave = 256;   ///< Runs that are baked before they are written.
constexpr uint32_t kBricksMethod = 1;  ///< Has to be increased when the same inputs begin to make other files.

uint64_t inputsOf(const MapNames& names, const RadiositySettings& s) {
  return contentSum(kBricksMethod, names.world, names.global, names.surface, s.texels, s.seed, s.mostTexels);
}

class RadiosityBaking {
 public:
  RadiosityBaking(const RayScene& rays, const ShadingSystem& shading, const MapNames& names,
                  const std::vector<SurfaceCharts>& surfaces, const RadiositySettings& settings)
      : bake_{rays, shading, settings}, scene_(rays.scene()), names_(names), surfaces_(surfaces), world_(scene_) {}

  void run(std::map<std::string, PointFileWriter>& files) const {
    const std::vector<TexelRun> runs = texelRuns(surfaces_);
    for (size_t wave = 0; wave < runs.size(); wave += kRunsPerWave) {
      std::vector<std::vector<BakedTexel>> baked(std::min(kRunsPerWave, runs.size() - wave));
      parallelFor(baked.size(), 1, [&](size_t r, size_t) {
        throwIfStopped();
        baked[r] = bakeTexels(bake_, chartsOf(runs[wave + r]), runs[wave + r]);
      });
      for (size_t r = 0; r < baked.size(); ++r) write(runs[wave + r], baked[r], files);
      if (bake_.settings.progress)
        bake_.settings.progress(static_cast<float>(wave + baked.size()) / static_cast<float>(runs.size()));
    }
  }

 private:
  const std::vector<RadiosityChart>& chartsOf(const TexelRun& run) const {
    return surfaces_[static_cast<size_t>(run.object)].side(run.back);
  }

  void write(const TexelRun& run, const std::vector<BakedTexel>& baked,
             std::map<std::string, PointFileWriter>& files) const {
    const auto group = static_cast<size_t>(scene_.objects[static_cast<size_t>(run.object)].group);
    PointFileWriter& file = files.at(names_.global[group]);
    const std::vector<RadiosityChart>& charts = chartsOf(run);
    size_t k = 0;
    forEachTexel(charts, run, [&](uint32_t patch, size_t t) {
      const BakedTexel& texel = baked[k++];
      if (!(texel.coverage > 0)) return;
      const TexelSquare square = texelSquare(charts[patch], t);
      const vec2 middle = square.corner + 0.5f * square.size;
      const TrueSurface surface = surfaceAt(scene_, run.object, patch, middle.x, middle.y);
      const vec3 N = normalizeOr(world_.normals * surface.normal, vec3(0)), B = kPi * texel.radiance;
      const std::array values{B.x, B.y, B.z, static_cast<float>(names_.surface[group])};
      if (N != vec3(0))
        file.add(transformPoint(world_.points, surface.P), run.back ? -N : N,
                 kDiskOfSquare * world_.scale * charts[patch].texelSize, values.data());
    });
  }

  const RadiosityBake bake_;
  const Scene& scene_;
  const MapNames& names_;
  const std::vector<SurfaceCharts>& surfaces_;
  const WorldFromCurrent world_;
};

bool holdsAll(const fs::path& folder, const std::set<std::string>& maps, uint64_t inputs) {
  return std::all_of(maps.begin(), maps.end(), [&](const std::string& name) {
    return pointsMadeFrom(atlasFile(folder, name, ".ptc")).inputs == inputs;
  });
}

/// Bakes the points of all maps into the folder.
void bakePoints(const fs::path& folder, const RayTools& tools, const MapNames& names,
                const std::vector<SurfaceCharts>& surfaces, const RadiositySettings& settings) {
  std::map<std::string, PointFileWriter> files;
  for (const std::string& name : names.all())
    files.try_emplace(name, atlasFile(folder, name, ".ptc").string(),
                      std::vector<CloudChannel>{{"radiosity", 3}, kSurfaceChannel});
  RadiosityBaking(*tools.rays, *tools.shading, names, surfaces, settings).run(files);
  for (auto& [name, file] : files) file.finish({names.world, inputsOf(names, settings)});
}

}  // namespace

RadiosityBricks::RadiosityBricks(const fs::path& folder, const RayTools& tools, const Camera& camera,
                                 const MapNames& atlas, const RadiosityBrickSettings& settings, Stats& stats, Log& log)
    : scene_(tools.rays->scene()) {
  const MapNames names = atlas.withoutCausticsAndMedia();
  const fs::path own = folder / "radiosity";  // a folder of its own, so that FOLDER may be that of an atlas as well
  makeAtlasFolder(own);
  const std::vector<int> objects = bakedObjects(scene_, *tools.shading, log);
  sides_.resize(scene_.objects.size());
  for (const int object : objects)
    sides_[static_cast<size_t>(object)] = scene_.objects[static_cast<size_t>(object)].attributes->sides == 2 ? 2 : 1;
  const std::set<std::string> maps = names.all();
  if (!holdsAll(own, maps, inputsOf(names, settings.points)))
    bakePoints(own, tools, names, layOutCharts(scene_, objects, camera, settings.points, log), settings.points);
  for (const std::string& name : maps)
    renewIrradianceBricks(atlasFile(own, name, ".ptc"), atlasFile(own, name, ".bkm"), settings.bricks, stats);
  maps_ = std::make_unique<const IrradianceAtlas>(own, scene_, names, settings.cacheBytes, log);
}

bool RadiosityBricks::lookup(const Ray& ray, const Hit& hit, vec3& radiance) const {
  const uint8_t sides = sides_[static_cast<size_t>(hit.object)];
  if (sides == 0) return false;
  const bool back = dot(ray.direction, hit.geometricNormal) > 0;
  if (back && sides == 1) return false;
  const auto found = maps_->bakedOverPi(scene_.objects[static_cast<size_t>(hit.object)].group, hit.atOpen,
                                        back ? -hit.normal : hit.normal, ray.radius + ray.spread * hit.t);
  radiance = found.value_or(vec3(0));
  return found.has_value();
}

void RadiosityBricks::report(Stats& stats) const { maps_->report(stats); }

}  // namespace tomales
