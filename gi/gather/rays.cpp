#include "gi/gather/rays.h"

#include "gi/gather/layers.h"

namespace tomales {

/// Each thread keeps it from one record to the next. Gather rays' hits take their indirect light from frozen caches and
/// paths, so gathering never nests.
struct GatherRays::Scratch {
  RayLayers layers;
  Surroundings surroundings;
  std::vector<Hit> hits, unknown;  ///< unknown: the hits whose radiance is not known.
  std::vector<std::pair<size_t, vec3>> mapped;
  HitQuestion question;
  HitAnswers answers, share;
  std::vector<vec3> glow;  ///< The colours of the hits when no light shines on them.
  std::vector<vec3> left;  ///< The radiance that the groups so far have not brought.
};

GatherRays::Scratch& GatherRays::emptyScratch() {
  thread_local Scratch scratch;
  scratch.layers = {};
  return scratch;
}

GatherRays::GatherRays(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
                       const GatherSettings& settings, const HitRadiance* known, std::span<const std::string> groups,
                       size_t count, uint32_t key)
    : scene_(scene),
      shading_(shading),
      point_(point),
      settings_(settings),
      known_(known),
      groups_(groups),
      key_(key),
      times_(scene, point, count, key),
      first_{point.position, point.normal, settings.maxDistance},
      scratch_(emptyScratch()) {
  orthonormalBasis(point.normal, tangent_, bitangent_);
  first_.spread = spreadOfRays(static_cast<int>(count));
  scene.prepareOrigin(point.group, point.position, point.edgeLength, first_);
  filter_.groups = groupsSeenFrom(scene, point.group, settings);
  if (settings.asked) filter_.sides = settings.asked->sides;
  if (settings.asked && settings.asked->bias >= 0) {
    first_.offset = 0;
    first_.bias = settings.asked->bias;
  }
  if (!filter_.passesAll()) first_.filter = &filter_;
  start_ = polygonStart(scene, first_, kMaskDiffuse);
  first_.origin += start_.lift;
  if (first_.offset > 0) {
    scene.lookAround(first_, slantedOffset(first_.offset, 0), kMaskDiffuse, scratch_.surroundings);
    first_.surroundings = &scratch_.surroundings;
  }
}

vec3 GatherRays::toWorld(const vec3& local) const {
  return local.x * tangent_ + local.y * bitangent_ + local.z * point_.normal;
}

vec3 GatherRays::toLocal(const vec3& direction) const {
  return {dot(direction, tangent_), dot(direction, bitangent_), dot(direction, point_.normal)};
}

vec3 GatherRays::add(int element, int cell, const vec3& local, size_t raysOfHemisphere) {
  Ray r = first_;
  r.direction = start_.above(toWorld(local));
  r.offset = slantedOffset(first_.offset, local.z);
  r.time = times_(static_cast<size_t>(cell));
  if (r.time > 0) r.origin = scene_.placeAt(point_.group, point_.position, point_.drift, r.time) + start_.lift;
  // A cell of a cosine-weighted hemisphere has the solid angle pi / (n cos).
  r.spread = 1 / std::sqrt(static_cast<float>(raysOfHemisphere) * std::max(local.z, 0.05f));
  scratch_.layers.add(element, r, {key_, number_++});
  return r.direction;
}

void GatherRays::see(Stats& stats, size_t elements, SeenLight& seen, FirstHits* first) {
  seen.all.assign(elements, vec3(settings_.isOcclusion() ? 1 : 0));
  seen.shares.resize(groups_.size());
  for (std::vector<vec3>& share : seen.shares) share.assign(elements, vec3(0));
  if (first) {
    first->distances.assign(elements, kInfinity);
    first->normals.resize(elements);
  }
  if (settings_.isOcclusion())
    uncover(stats, seen.all, first);
  else
    shade(stats, seen, first);
  scratch_.layers = {};
}

void GatherRays::uncover(Stats& stats, std::vector<vec3>& radiance, FirstHits* first) {
  meet(stats, first);
  for (size_t r = 0; r < scratch_.hits.size(); ++r)
    if (const Hit& hit = scratch_.hits[r]; hit.object >= 0)
      radiance[static_cast<size_t>(scratch_.layers.elements[r])] -=
          vec3(settings_.asked->coveredAt(std::max(0.0f, hit.t)));
}

void GatherRays::shade(Stats& stats, SeenLight& seen, FirstHits* first) {
  ShadeContext context{.kind = RayKind::Diffuse,
                       .diffuseDepth = settings_.depth,
                       .seed = settings_.seed,
                       .lightSamples = 1,
                       .indirect = settings_.indirect};
  context.illumination = settings_.light;
  context.specularRaysSeeLights = settings_.specularRaysSeeLights;
  context.highlights = highlightsOfHits(settings_.specularRaysSeeLights);
  // Diffuse rays end at these hits. Mirrors and glass still show their reflections.
  context.diffuseLimit = settings_.asked ? settings_.asked->diffuseLimit : 0;
  scratch_.question.mode = settings_.asked ? settings_.asked->mode : HitMode::Shader;
  for (int layer = 0; layer < kMostLayers && !scratch_.layers.rays.empty(); ++layer) {
    meet(stats, layer == 0 ? first : nullptr);
    answer(context);
    shadeShares(context, seen);
    scratch_.layers.goOn(scene_, scratch_.hits, scratch_.answers, 1, [&](int element, const vec3& color, const vec3&) {
      seen.all[static_cast<size_t>(element)] += color;
    });
  }
}

// Shades the same hits under each group of lights alone. Each shading includes the light of surfaces that shine by
// themselves, which is the share of the first group and is subtracted from the others. The last group is not shaded:
// its share is the rest of the whole.
void GatherRays::shadeShares(const ShadeContext& context, SeenLight& seen) {
  if (groups_.empty()) return;
  ShadeContext alone = context;
  HitAnswers& share = scratch_.share;
  std::vector<vec3>& left = scratch_.left;
  left = scratch_.answers.color;
  for (size_t g = 0; g < groups_.size(); ++g) {
    const bool isLast = g > 0 && g + 1 == groups_.size();
    alone.onlyLightGroup = &groups_[g];
    if (!isLast) {
      scene_.shadeHits(scratch_.layers.rays, scratch_.hits, scratch_.layers.names, shading_, alone, scratch_.question,
                       share);
      scene_.throughVolumes(scratch_.layers.rays, scratch_.hits, scratch_.layers.names, kMaskDiffuse, shading_, alone,
                            share);
    }
    if (g == 0) scratch_.glow = share.color;
    for (size_t r = 0; r < scratch_.hits.size(); ++r) {
      const vec3 color = isLast ? left[r] : g == 0 ? share.color[r] : share.color[r] - scratch_.glow[r];
      left[r] -= color;
      if (isFinite(color))
        seen.shares[g][static_cast<size_t>(scratch_.layers.elements[r])] += scratch_.layers.transmittance[r] * color;
    }
  }
}

void GatherRays::meet(Stats& stats, FirstHits* first) {
  const std::vector<Hit>& hits = scratch_.hits;
  stats.rays.hitlistAdjusted += scratch_.layers.meet(scene_, kMaskDiffuse, scratch_.hits);
  stats.rays.gather += static_cast<int64_t>(hits.size());
  if (!first) return;
  scene_.noteStarts(point_.group, static_cast<int64_t>(hits.size()),
                    std::count_if(hits.begin(), hits.end(), [](const Hit& h) { return h.crowded; }));
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].object < 0) continue;
    const vec3& n = hits[i].geometricNormal;
    first->distances[i] = std::max(0.0f, hits[i].t);
    first->normals[i] = dot(n, scratch_.layers.rays[i].direction) > 0 ? -n : n;
  }
}

// Takes radiance from `known_` where it has it, and shades the other hits.
void GatherRays::answer(const ShadeContext& context) {
  const auto& rays = scratch_.layers.rays;
  const auto through = [&] {
    scene_.throughVolumes(rays, scratch_.hits, scratch_.layers.names, kMaskDiffuse, shading_, context,
                          scratch_.answers);
  };
  if (!known_) {
    scene_.shadeHits(rays, scratch_.hits, scratch_.layers.names, shading_, context, scratch_.question,
                     scratch_.answers);
    return through();
  }
  scratch_.unknown = scratch_.hits;
  scratch_.mapped.clear();
  vec3 radiance;
  for (size_t r = 0; r < rays.size(); ++r)
    if (scratch_.hits[r].object >= 0 && known_->lookup(rays[r], scratch_.hits[r], radiance)) {
      scratch_.unknown[r].object = -1;
      scratch_.mapped.emplace_back(r, radiance);
    }
  scene_.shadeHits(rays, scratch_.unknown, scratch_.layers.names, shading_, context, scratch_.question,
                   scratch_.answers);
  for (const auto& [r, L] : scratch_.mapped) {
    scratch_.answers.color[r] = L;
    scratch_.answers.opacity[r] = vec3(1);
  }
  through();
}

const std::vector<uint8_t>* groupsSeenFrom(const RayScene& rays, int group, const GatherSettings& settings) {
  const std::string& asked = settings.asked ? settings.asked->subset : settings.subset;
  const Attributes& own = *rays.scene().groups[static_cast<size_t>(group)].attributes;
  return rays.groupsIn(own.trace.subsetFor(asked), settings.asked ? settings.asked->excludeSubset : "");
}

}  // namespace tomales
