#include "raytrace/trace.h"

#include "raytrace/ray_scene.h"

namespace tomales {
namespace {

// A chord along which the surface turns by 45 degrees lies at most a tenth of its length inside. Micropolygons are long
// at silhouettes, where dicing by raster size is coarse in space.
constexpr float kChordShare = 0.1f;
constexpr float kOffsetEpsilon = 1e-5f;  ///< Share of distance and size: rounding, where the coarse surface is exact.
constexpr float kBias = 1e-4f;           ///< The same for rays without a hit list.
constexpr float kMediumWidth_px = 3, kCoarseWidth_px = 16;  ///< Least widths of rays that see these levels.

std::vector<uint32_t> masksOf(const Scene& scene) {
  std::vector<uint32_t> masks;
  for (const ShadeGroup& g : scene.groups) masks.push_back(maskOf(g.attributes->visibility));
  return masks;
}

/// Returns for each group whether its opacity is that of the attributes, because no primitive variable and no shader of
/// shadow rays changes it.
std::vector<bool> constantOpacityOf(const Scene& scene, const ShadingSystem& shading) {
  std::vector<bool> constant;
  for (const ShadeGroup& g : scene.groups) {
    const bool varies =
        std::any_of(g.primvars.begin(), g.primvars.end(), [](const Primvar& p) { return p.name == "Os"; });
    const bool asks = g.attributes->transmissionHitMode == HitMode::Shader;
    constant.push_back(!varies && (!asks || shading.group(static_cast<int>(constant.size())).keepsOpacity()));
  }
  return constant;
}

std::vector<bool> opaqueOf(const Scene& scene, const std::vector<bool>& constant) {
  std::vector<bool> opaque;
  for (const ShadeGroup& g : scene.groups)
    opaque.push_back(constant[opaque.size()] && glm::all(glm::greaterThanEqual(g.attributes->opacity, vec3(1))));
  return opaque;
}

std::vector<CoarseGroup> coarseGroups(const Scene& scene, const Camera& camera, const ShadingSystem& shading,
                                      const SharedShapes& shapes, size_t mostBytes, Log& log) {
  const float longer = mostBytes > 0 ? edgesThatFit(scene, camera, shapes.shared, mostBytes, log) : 1;
  std::vector<CoarseGroup> groups = tessellate(scene, camera, shading, log, shapes.shared, longer);
  addFigures(shapes, groups);
  return groups;
}

/// Returns a list that the thread keeps, so that nothing is allocated once it has grown.
HitList& scratchList() {
  thread_local HitList list;
  return list;
}
HitList& scratchSurfaces() {
  thread_local HitList list;
  return list;
}

}  // namespace

RayScene::Impl::Impl(const Scene& s, const Camera& c, const ShadingSystem& shading, const RaySettings& settings,
                     Log& log)
    : scene(s),
      camera(c),
      hitList(settings.hitList),
      shapes(shareShapes(s, camera, shading, log)),
      groups(coarseGroups(s, camera, shading, shapes, settings.coarseBytes, log)),
      chunks(s, camera, shading, shapes.shared, log),
      opacityIsConstant(constantOpacityOf(s, shading)),
      masks(masksOf(s)),
      opaque(opaqueOf(s, opacityIsConstant)),
      embree({groups, masks, opaque}, shapes, chunks, settings.geometryCacheBytes, log),
      solids(s, groups, masks, log),
      volumes(s, shading),
      emitters(s, groups),
      unseenDisplacement(groups.size(), 0.0f) {
  for (const Object& o : scene.objects)
    if (!o.attributes->trace.displacements) {
      float& bound = unseenDisplacement[static_cast<size_t>(o.group)];
      bound = std::max(bound, o.displacementBound);
    }
  for (const CoarseGroup& g : groups)
    if (!g.laterP.empty()) moving.add(g);
  for (const Object& o : scene.objects)
    if (const int light = o.attributes->areaLight; light >= 0 && !emitters.shines(light))
      log.report(Severity::Warning, "light-no-area", o.where,
                 objectName(o) + ": the geometry of its area light has no area; it casts no light");
  for (const Object& o : scene.objects)
    if (o.solid >= 0 && o.attributes->areaLight >= 0)
      log.report(Severity::Warning, "light-in-solid", o.where,
                 objectName(o) +
                     ": it is part of a solid and an area light: it shines from its whole surface, also where the "
                     "solid removes it");
}

bool RayScene::Impl::addSolids(const Ray& ray, float window, uint32_t mask, HitList& list, bool found,
                               PolygonHit& beyond) const {
  if (solids.none()) return found;
  HitList& surfaces = scratchSurfaces();
  solids.surfaces(ray, window, mask, surfaces);
  for (const PolygonHit& s : surfaces) {
    if (s.t <= window) {
      list.push_back(s);
      continue;
    }
    if (!found || s.t < beyond.t) beyond = s;
    return true;
  }
  return found;
}

void RayScene::Impl::resolve(const Ray& ray, const PolygonHit& polygon, Hit& out) const {
  if (polygon.chunk >= 0) {
    out = resolveChunk(ray, polygon);
    return;
  }
  const CoarseInstance* instance =
      polygon.instance >= 0 ? &shapes.instances[static_cast<size_t>(polygon.instance)] : nullptr;
  const CoarseGroup& g = instance ? shapes.masters[instance->master] : groups[polygon.group];
  const Quad& q = g.quads[polygon.quad];
  const Lattice& l = g.latticeOf(polygon.quad);
  const vec2 uv = g.patchParameters(polygon.quad, polygon.u, polygon.v);
  vec3 geometric = normalizeOr(g.flipsNormal ? -polygon.normal : polygon.normal, vec3(0, 0, -1));
  vec3 normal =
      glm::mix(glm::mix(g.N[q[0]], g.N[q[1]], polygon.u), glm::mix(g.N[q[3]], g.N[q[2]], polygon.u), polygon.v);
  vec3 atOpen = ray.origin + polygon.t * ray.direction;
  if (ray.time > 0) {
    geometric = g.geometricNormal(polygon.quad);
    atOpen = g.pointOn(polygon.quad, polygon.u, polygon.v);
    if (instance) atOpen = transformPoint(instance->cameraFromObject, atOpen);
  }
  if (instance) {
    geometric = normalizeOr(instance->normals * geometric, geometric);
    normal = instance->normals * normal;
  }
  // Copying a structure that has just been written in smaller pieces would stall, so each member is assigned in place.
  out.t = polygon.t;
  out.object = instance ? instance->object : l.object;
  out.patch = l.patch;
  out.u = uv.x;
  out.v = uv.y;
  out.normal = normalizeOr(normal, geometric);
  out.geometricNormal = geometric;
  out.atOpen = atOpen;
}

Hit RayScene::Impl::resolveChunk(const Ray& ray, const PolygonHit& hit) const {
  const PatchTile& tile = chunks.all()[static_cast<size_t>(hit.chunk)].tiles[hit.quad];
  const vec3 along = groups[hit.group].flipsNormal ? -hit.normal : hit.normal, normal = embree.normal(hit);
  return {hit.t,
          tile.object,
          tile.patch,
          lerp(tile.rect.u0, tile.rect.u1, hit.u),
          lerp(tile.rect.v0, tile.rect.v1, hit.v),
          normal,
          normalizeOr(along, normal),
          false,
          false,
          ray.origin + hit.t * ray.direction};
}

/// Returns the level whose polygons are as wide as the ray, seen from the eye. The hit is assumed to be as far from P
/// as P is from the eye.
TessellationLevel RayScene::Impl::levelOf(const Ray& ray, const vec3& P) const {
  if (chunks.all().empty()) return TessellationLevel::Fine;
  const float width_px = 2 * std::max(ray.spread * glm::length(P), ray.radius) / std::max(camera.pixelSize(P), 1e-20f);
  return width_px >= kCoarseWidth_px   ? TessellationLevel::Coarse
         : width_px >= kMediumWidth_px ? TessellationLevel::Medium
                                       : TessellationLevel::Fine;
}

float RayScene::Impl::leastRadius(uint32_t group, TessellationLevel met, const vec3& P) const {
  constexpr float kHalfAndRounding = 0.5001f;
  if (met == TessellationLevel::Fine || !chunks.has(group)) return 0;
  return kHalfAndRounding * (met == TessellationLevel::Coarse ? kCoarseWidth_px : kMediumWidth_px) *
         camera.pixelSize(P);
}

RayScene::RayScene(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const RaySettings& settings,
                   Stats& stats, Log& log)
    : impl_(std::make_unique<Impl>(scene, camera, shading, settings, log)) {
  size_t polygons = 0, bytes = impl_->embree.bytes() + impl_->solids.bytes();
  for (const auto* meshes : {&impl_->groups, &impl_->shapes.masters})
    for (const CoarseGroup& g : *meshes) {
      polygons += g.quads.size();
      bytes += g.bytes();
    }
  stats.raytrace.coarsePolygons += static_cast<int64_t>(polygons);
  stats.raytrace.bytes += static_cast<int64_t>(bytes);
  stats.geometryCache.finePolygons += impl_->chunks.finePolygons();
}

RayScene::~RayScene() = default;

void RayScene::report(Stats& stats) const {
  const ResidentFigures figures = impl_->embree.chunkFigures();
  stats.geometryCache.lookups += figures.lookups;
  stats.geometryCache.misses += figures.misses;
  stats.geometryCache.bytes = std::max(stats.geometryCache.bytes.load(), figures.mostBytes);
}

Hit RayScene::closest(const Ray& ray, RayMask mask) const {
  Hit out;
  if (!traceable(ray)) return out;
  PolygonHit hit;
  HitList& list = scratchList();
  if (!(ray.offset > 0)) {
    const bool found = impl_->embree.nearest(ray, mask, hit);
    if (impl_->addSolids(ray, std::max(ray.bias, 0.0f), mask, list, found, hit)) impl_->resolve(ray, hit, out);
    return out;
  }
  const float window = recordingWindow(ray.offset);
  const bool beyond =
      impl_->addSolids(ray, window, mask, list, impl_->embree.nearestBeyond(ray, window, mask, list, hit), hit);
  sortAlongRay(list);
  const RayStart start = startOf(ray);
  const int origin = effectiveOrigin(list, start), next = nextHit(list, origin, start);
  const PolygonHit& met = next >= 0 ? list[static_cast<size_t>(next)] : hit;
  if (next >= 0 ? met.t < ray.tMax : beyond) impl_->resolve(ray, met, out);
  out.adjusted = origin >= 0;
  out.crowded = isCrowded(list, origin, start);
  return out;
}

void RayScene::prepareOrigin(int group, const vec3& P, float edgeLength, Ray& ray) const {
  const auto g = static_cast<size_t>(group);
  const auto& given = impl_->scene.groups[g].attributes->trace;
  const CoarseGroup& coarse = impl_->groups[g];
  ray.level = impl_->levelOf(ray, P);
  const float ofCoarse = ray.level == TessellationLevel::Coarse ? coarse.coarseDeviation : 0.0f;
  const float deviation = std::max({coarse.deviation, ofCoarse, impl_->chunks.deviation(g, ray.level)});
  const float scale = glm::length(P) + coarse.size;
  // Polygons that are farther from their surface than it is large stand for nothing that a ray could start from, and
  // lists of hits within such a distance would hold much of the scene.
  const float apart = deviation + kChordShare * edgeLength;
  const float automatic =
      kOffsetFactor * (impl_->unseenDisplacement[g] + (apart <= coarse.size ? apart : 0.0f)) + kOffsetEpsilon * scale;
  ray.group = group;
  ray.offset = impl_->hitList ? std::max(given.offset.value_or(automatic), 0.0f) : 0.0f;
  ray.bias = given.bias.value_or(kBias * scale);
}

void RayScene::noteStarts(int group, int64_t rays, int64_t crowded) const {
  const std::lock_guard lock(impl_->startsMutex);
  Starts& sum = impl_->starts[group];
  sum.rays += rays;
  sum.crowded += crowded;
}

std::map<int, RayScene::Starts> RayScene::starts() const {
  const std::lock_guard lock(impl_->startsMutex);
  return impl_->starts;
}

void RayScene::lookAround(const Ray& one, float largestOffset, RayMask mask, Surroundings& out) const {
  impl_->embree.around(one.origin, recordingWindow(largestOffset), mask, one.level, out);
}

const std::vector<uint8_t>* RayScene::groupsIn(const std::string& subset, const std::string& exclude) const {
  if (subset.empty() && exclude.empty()) return nullptr;
  const std::lock_guard lock(impl_->subsetsMutex);
  const auto [it, isNew] = impl_->subsets.try_emplace({subset, exclude});
  const auto inOneOf = [](const Attributes& a, const std::string& sets) {
    return std::any_of(a.membership.begin(), a.membership.end(), [&](const std::string& set) {
      for (size_t at = sets.find(set); at != std::string::npos; at = sets.find(set, at + 1)) {
        const auto ends = [&](size_t i) { return i >= sets.size() || sets[i] == ',' || sets[i] == ' '; };
        if ((at == 0 || ends(at - 1)) && ends(at + set.size())) return true;
      }
      return false;
    });
  };
  if (isNew)
    for (const ShadeGroup& g : impl_->scene.groups)
      it->second.push_back((subset.empty() || inOneOf(*g.attributes, subset)) && !inOneOf(*g.attributes, exclude));
  return &it->second;
}

bool RayScene::samplesTime(int group) const {
  return impl_->moving.any() && impl_->scene.groups[static_cast<size_t>(group)].attributes->trace.sampleMotion;
}

bool RayScene::mayMeetMotion(const Ray& ray) const { return impl_->moving.mayMeet(ray); }

vec3 RayScene::placeAt(int group, const vec3& atOpen, const vec3& drift, float time) const {
  const ShadeGroup& g = impl_->scene.groups[static_cast<size_t>(group)];
  const vec3 drifted = atOpen + time * drift;
  if (!impl_->moving.any() || time == 0 || !g.currentFromOpen.moving()) return drifted;
  const Options& o = impl_->scene.options;
  return transformPoint(g.currentFromOpen.at(lerp(o.shutterOpen, o.shutterClose, time)), drifted);
}

const Emitters& RayScene::emitters() const { return impl_->emitters; }

float RayScene::unseenDisplacement(int group) const { return impl_->unseenDisplacement[static_cast<size_t>(group)]; }
const Scene& RayScene::scene() const { return impl_->scene; }

int RayScene::groupOf(const Hit& hit) const { return impl_->scene.objects[static_cast<size_t>(hit.object)].group; }

}  // namespace tomales
