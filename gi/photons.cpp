#include "gi/photons.h"

#include <numeric>

#include "gi/medium.h"
#include "gi/photon_emission.h"
#include "gi/state.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr size_t kPhotonsPerTask = 2048, kTasksPerWave = 64;
constexpr uint32_t kBounceStream = 0x626f756eU, kMediumStream = 0x6d656469U;

struct Path {
  Ray ray;
  vec3 power;
  uint32_t number;
  int light;
  int depth = 0;
  uint32_t collisions = 0;  ///< With media.
  bool specular = true;  ///< So far it has met nothing diffuse.
};

struct Scratch {
  std::vector<Hit> hits;
  std::vector<vec3> reflectance;   ///< At each.
  std::vector<uint8_t> scattered;  ///< Before it was reached.
  std::vector<uint32_t> number, name;
  std::vector<vec2> direction;     ///< Random numbers: of where a path goes on,
  std::vector<float> survival;     ///< and of whether it does.
};

vec3 onSphere(const vec2& xi) {
  const float z = 1 - 2 * xi.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * xi.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Reflection and refraction at a smooth dielectric.
vec3 dielectric(const vec3& d, const vec3& towards, bool entering, float index, float xi) {
  const float eta = entering ? 1 / index : index, cosine = -dot(d, towards);
  const float k = 1 - eta * eta * (1 - cosine * cosine);
  const vec3 mirrored = d + 2 * cosine * towards;
  if (k < 0) return mirrored;
  const float inside = std::sqrt(k);
  const float rs = (eta * cosine - inside) / (eta * cosine + inside), rp = (cosine - eta * inside) / (cosine + eta * inside);
  return xi < 0.5f * (rs * rs + rp * rp) ? mirrored : eta * d + (eta * cosine - inside) * towards;
}

bool isOnFor(const ShadeGroup& group, int light) {
  const std::vector<int>& on = group.attributes->lights;
  return std::find(on.begin(), on.end(), light) != on.end();
}

class Tracer {
 public:
  Tracer(const Scene& scene, const RayScene& rays, const ShadingSystem& shading, const PhotonSettings& settings, Log& log)
      : scene_(scene), rays_(rays), shading_(shading), settings_(settings), worldUnit_(std::cbrt(std::abs(glm::determinant(mat3(scene.cameraFromWorldAtOpen()))))) {
    for (const ShadeGroup& g : scene.groups) {
      const std::string& name = g.attributes->photon.shadingModel;
      const std::optional<PhotonModel> model = photonModel(name);
      if (!model)
        log.report(Severity::Warning, "photons-model-" + name, scene.where,
                   "photon shadingmodel \"" + name + "\" is not known; matte is used");
      models_.push_back(model.value_or(PhotonModel::Matte));
      media_.push_back({mediumOf(g.attributes->interior.get(), worldUnit_), mediumOf(g.attributes->exterior.get(), worldUnit_)});
      anyMedium_ |= !media_.back().inside.empty() || !media_.back().outside.empty();
    }
    askEvenSurfaces();
  }

  void trace(const PhotonSource& source, uint32_t first, size_t count, float share, std::vector<StoredPhoton>& out) const {
    std::vector<EmittedPhoton> emitted(count);
    source.emit(first, settings_.seed, emitted);
    const uint32_t stream = hashCombine(settings_.seed, static_cast<uint32_t>(source.light()), kBounceStream);
    std::vector<Path> paths;
    for (size_t i = 0; i < count; ++i) {
      const EmittedPhoton& e = emitted[i];
      if (!(maxComponent(e.power) > 0) || !isFinite(e.power)) continue;
      paths.push_back({e.ray, e.power * share, first + static_cast<uint32_t>(i), source.light()});
    }
    Scratch scratch;
    while (!paths.empty()) step(paths, stream, scratch, out);
  }

 private:
  static constexpr float kDiffuseSpread = 0.1f;  ///< As a gather ray of about a hundred; irradiance is estimated over more.

  /// Every path to its next surface; those that end there leave the list.
  void step(std::vector<Path>& paths, uint32_t stream, Scratch& s, std::vector<StoredPhoton>& out) const {
    s.hits.clear();
    for (const Path& path : paths) s.hits.push_back(rays_.closest(path.ray, kMaskPhoton));
    crossMedia(paths, stream, s, out);
    reflectances(paths, stream, s);
    draw(paths, stream, s);
    size_t kept = 0;
    for (size_t i = 0; i < paths.size(); ++i) {
      if (!s.scattered[i] && (s.hits[i].object < 0 || !bounce(paths[i], s.hits[i], s.reflectance[i], {s.direction[i], s.survival[i]}, stream, out))) continue;
      if (kept != i) paths[kept] = paths[i];
      ++kept;
    }
    paths.resize(kept);
  }

  void draw(const std::vector<Path>& paths, uint32_t stream, Scratch& s) const {
    const size_t count = paths.size();
    s.number.resize(count), s.name.resize(count), s.direction.resize(count), s.survival.resize(count);
    for (size_t i = 0; i < count; ++i) s.number[i] = paths[i].number, s.name[i] = nameOf(paths[i], stream);
    sobol2(s.number, s.name, s.direction);
    for (uint32_t& name : s.name) name = hashCombine(name, 1u);
    sobol1(s.number, s.name, s.survival);
  }

  /// What collides before it arrives is stored there, and meets no surface in this step.
  void crossMedia(std::vector<Path>& paths, uint32_t stream, Scratch& s, std::vector<StoredPhoton>& out) const {
    s.scattered.assign(paths.size(), 0);
    for (size_t i = 0; anyMedium_ && i < paths.size(); ++i) {
      Path& path = paths[i];
      Hit& hit = s.hits[i];
      if (hit.object < 0) continue;
      const Media& media = media_[static_cast<size_t>(groupOf(hit))];
      const Medium& medium = dot(path.ray.direction, hit.geometricNormal) > 0 ? media.inside : media.outside;
      const float majorant = medium.majorant(path.power);
      if (!(majorant > 0)) continue;
      const uint32_t name = hashCombine(hashCombine(stream, static_cast<uint32_t>(path.depth)), kMediumStream, path.collisions);
      const float flight = -std::log(1 - sobol1(path.number, name)) / majorant;
      if (!(flight < hit.t)) continue;
      s.scattered[i] = collides(path, medium, landsOn(path, groupOf(hit)), flight, name, out);
      hit.object = -1;
    }
  }

  /// False: it ends there.
  bool collides(Path& path, const Medium& medium, bool isLit, float flight, uint32_t name, std::vector<StoredPhoton>& out) const {
    const vec3 P = path.ray.origin + flight * path.ray.direction;
    if (isLit) out.push_back({P, vec3(0), path.power / (medium.majorant(path.power) * worldUnit_), -1, path.depth, false});
    const Collision collision = collide(medium, path.power, sobol1(path.number, hashCombine(name, 1u)));
    if (collision.event == Collision::Absorbed) return false;
    path.power = collision.power;
    ++path.collisions;
    if (collision.event == Collision::None) {  // the same ray, from there
      path.ray.origin = P;
      path.ray.offset = std::max(0.0f, path.ray.offset - flight), path.ray.bias = std::max(0.0f, path.ray.bias - flight);
      return true;
    }
    if (!isLit || ++path.depth >= settings_.maxDepth) return false;
    path.specular = false;
    path.ray = {P, onSphere(sobol2(path.number, hashCombine(name, 2u)))};
    return true;
  }

  /// Surfaces that reflect the same everywhere, at any place of theirs; and those that do not reflect by their shaders.
  void askEvenSurfaces() {
    even_.resize(scene_.groups.size());
    for (size_t g = 0; g < even_.size(); ++g) {
      if (models_[g] != PhotonModel::Matte && models_[g] != PhotonModel::Translucent) {
        even_[g] = vec3(0);
        continue;
      }
      if (!shading_.reflectsEvenly(static_cast<int>(g))) continue;
      Hit hit;
      hit.t = 1, hit.object = scene_.groups[g].exampleObject, hit.u = hit.v = 0.5f;
      hit.normal = hit.geometricNormal = {0, 0, -1};
      even_[g] = shaded({{vec3(0), vec3(0, 0, 1)}}, {hit}, {{}}).front();
    }
  }

  /// Diffuse reflectance at every hit, of surfaces that are even or by their shaders.
  void reflectances(const std::vector<Path>& paths, uint32_t stream, Scratch& s) const {
    s.reflectance.assign(s.hits.size(), vec3(0));
    bool all = true;
    for (size_t i = 0; i < s.hits.size(); ++i)
      if (s.hits[i].object >= 0) {
        const auto& even = even_[static_cast<size_t>(groupOf(s.hits[i]))];
        s.reflectance[i] = even.value_or(vec3(0)), all &= even.has_value();
      }
    if (all) return;
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<SampleName> names;
    std::vector<size_t> which;
    for (size_t i = 0; i < s.hits.size(); ++i) {
      if (s.hits[i].object < 0 || even_[static_cast<size_t>(groupOf(s.hits[i]))]) continue;
      rays.push_back(paths[i].ray), hits.push_back(s.hits[i]), which.push_back(i);
      names.push_back({hashCombine(stream, paths[i].number, static_cast<uint32_t>(paths[i].depth)), 0});
    }
    const std::vector<vec3> found = shaded(rays, hits, names);
    for (size_t k = 0; k < which.size(); ++k) s.reflectance[which[k]] = found[k];
  }

  /// What comes back of E/pi = 1, less what is emitted.
  std::vector<vec3> shaded(const std::vector<Ray>& rays, const std::vector<Hit>& hits, const std::vector<SampleName>& names) const {
    ShadeContext context{RayKind::Diffuse, 1, settings_.seed, 1, false};
    context.light = Illumination::Unit;
    std::vector<vec3> lit, dark;
    rays_.shadeHits(rays, hits, names, shading_, context, lit);
    const bool emitters = std::any_of(hits.begin(), hits.end(), [&](const Hit& h) { return h.object >= 0 && shading_.emits(groupOf(h)); });
    if (!emitters) return lit;
    context.light = Illumination::None;
    rays_.shadeHits(rays, hits, names, shading_, context, dark);
    for (size_t i = 0; i < lit.size(); ++i) lit[i] -= dark[i];
    return lit;
  }

  /// Light that comes straight from a lamp, or by mirrors, is seen by what that lamp is switched on for.
  bool landsOn(const Path& path, int group) const { return !path.specular || isOnFor(scene_.groups[static_cast<size_t>(group)], path.light); }

  int groupOf(const Hit& hit) const { return scene_.objects[static_cast<size_t>(hit.object)].group; }

  struct Draw {
    vec2 direction;
    float survival;
  };
  static uint32_t nameOf(const Path& path, uint32_t stream) { return hashCombine(stream, static_cast<uint32_t>(path.depth)); }

  bool bounce(Path& path, const Hit& hit, const vec3& reflectance, const Draw& xi, uint32_t stream, std::vector<StoredPhoton>& out) const {
    const int group = groupOf(hit);
    const Attributes& attributes = *scene_.groups[static_cast<size_t>(group)].attributes;
    const vec3 P = path.ray.origin + hit.t * path.ray.direction, d = path.ray.direction;
    const bool front = dot(d, hit.geometricNormal) < 0;
    const vec3 N = front ? hit.normal : -hit.normal, Ng = front ? hit.geometricNormal : -hit.geometricNormal;
    const uint32_t name = nameOf(path, stream);
    vec3 direction, passed;
    switch (const PhotonModel model = models_[static_cast<size_t>(group)]) {
      case PhotonModel::Matte:
      case PhotonModel::Translucent: {
        if (!landsOn(path, group)) return false;
        out.push_back({P, Ng, path.power, group, path.depth, path.specular && path.depth > 0});
        path.specular = false;
        passed = isFinite(reflectance) ? glm::clamp(reflectance, 0.0f, 1.0f) : vec3(0);
        const bool through = model == PhotonModel::Translucent && sobol1(path.number, hashCombine(name, 2u)) < 0.5f;
        // Around the interpolated normal some photons would go into the polygon, and be caught in what it bounds.
        const vec3 side = through ? -Ng : Ng, local = cosineHemisphere(xi.direction);
        vec3 tangent, bitangent;
        orthonormalBasis(side, tangent, bitangent);
        direction = local.x * tangent + local.y * bitangent + local.z * side;
        break;
      }
      case PhotonModel::Chrome:
        passed = attributes.color, direction = d - 2 * dot(d, N) * N;
        break;
      case PhotonModel::Transparent:
        passed = attributes.color, direction = d;
        break;
      default:
        passed = attributes.color;
        direction = dielectric(d, N, front, model == PhotonModel::Water ? 1.33f : 1.5f, sobol1(path.number, hashCombine(name, 2u)));
    }
    if (++path.depth >= settings_.maxDepth) return false;
    // Surviving photons keep the power that they came with, so that all that are stored weigh about the same.
    const vec3 power = path.power * passed;
    const float survival = std::min(1.0f, maxComponent(power) / maxComponent(path.power));
    if (!(xi.survival < survival)) return false;
    path.power = power / survival;
    path.ray = {P, normalizeOr(direction, N)};
    // The level of what it meets follows from its width; textures there do not.
    path.ray.spread = path.specular ? 0.0f : kDiffuseSpread;
    rays_.prepareOrigin(group, P, 0, path.ray);
    path.ray.spread = 0;
    path.ray.offset = slantedOffset(path.ray.offset, std::abs(dot(path.ray.direction, N)));
    return true;
  }

  const Scene& scene_;
  const RayScene& rays_;
  const ShadingSystem& shading_;
  const PhotonSettings& settings_;
  const float worldUnit_;                   ///< Length of one of the world.
  struct Media { Medium inside, outside; };
  std::vector<Media> media_;                ///< On both sides of the surfaces of each group.
  bool anyMedium_ = false;
  std::vector<PhotonModel> models_;         ///< Of each group,
  std::vector<std::optional<vec3>> even_;  ///< and what it reflects if that is the same everywhere.
};

std::vector<PhotonSource> sourcesOf(const Scene& scene, const RayScene& rays, const ShadingSystem& shading, Log& log) {
  const PhotonTarget target(scene);
  std::vector<PhotonSource> sources;
  for (const auto& light : scene.lights) {
    const LightKind kind = shading.lightKind(light->index);
    const bool isOn = std::any_of(scene.groups.begin(), scene.groups.end(), [&](const ShadeGroup& g) { return isOnFor(g, light->index); });
    if (!isOn || kind == LightKind::None || kind == LightKind::Indirect) continue;
    if (kind == LightKind::Ambient) {
      log.report(Severity::Warning, "photons-ambient", light->shader.where,
                 "light \"" + light->handle + "\" comes from nowhere: it emits no photons");
      continue;
    }
    PhotonSource source(light->index, shading, rays, target);
    if (source.power() > 0) sources.push_back(std::move(source));
  }
  return sources;
}

}  // namespace

std::optional<PhotonModel> photonModel(const std::string& name) {
  static constexpr std::pair<std::string_view, PhotonModel> kModels[] = {
      {"matte", PhotonModel::Matte}, {"translucent", PhotonModel::Translucent}, {"chrome", PhotonModel::Chrome},
      {"glass", PhotonModel::Glass}, {"water", PhotonModel::Water},             {"transparent", PhotonModel::Transparent}};
  for (const auto& [known, model] : kModels)
    if (known == name) return model;
  return std::nullopt;
}

PhotonFigures tracePhotons(const Scene& scene, const RayScene& rays, const ShadingSystem& shading, const PhotonSettings& settings,
                           const std::function<void(const StoredPhoton&)>& store,
                           const std::function<void(float)>& progress, Stats& stats, Log& log) {
  const std::vector<PhotonSource> sources = sourcesOf(scene, rays, shading, log);
  const double total = std::accumulate(sources.begin(), sources.end(), 0.0,
                                       [](double sum, const PhotonSource& s) { return sum + s.power(); });
  if (sources.empty())
    log.report(Severity::Warning, "photons-no-light", scene.where, "no light of the scene emits photons: indirect light is black");
  const Tracer tracer(scene, rays, shading, settings, log);
  PhotonFigures figures;
  std::vector<std::vector<StoredPhoton>> stored;
  for (const PhotonSource& source : sources) {
    const auto count = static_cast<size_t>(std::max(1.0, std::round(static_cast<double>(settings.emit) * source.power() / total)));
    const float share = 1 / static_cast<float>(count);
    for (size_t wave = 0; wave < count; wave += kPhotonsPerTask * kTasksPerWave) {
      const size_t end = std::min(count, wave + kPhotonsPerTask * kTasksPerWave);
      stored.resize((end - wave + kPhotonsPerTask - 1) / kPhotonsPerTask);
      parallelFor(stored.size(), 1, [&](size_t begin, size_t last) {
        for (size_t task = begin; task < last; ++task) {
          const size_t first = wave + task * kPhotonsPerTask;
          stored[task].clear();
          tracer.trace(source, static_cast<uint32_t>(first), std::min(kPhotonsPerTask, end - first), share, stored[task]);
        }
      });
      for (const auto& photons : stored) {
        for (const StoredPhoton& p : photons) store(p);
        figures.stored += static_cast<int64_t>(photons.size());
      }
      if (progress) progress(static_cast<float>(figures.emitted + static_cast<int64_t>(end)) / static_cast<float>(settings.emit));
    }
    figures.emitted += static_cast<int64_t>(count);
  }
  stats.rays.photon += figures.emitted;
  return figures;
}

}  // namespace tomales
