#include "raytrace/volumes.h"

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// Rays that are shaded together.
constexpr size_t kTogether = 256;

}  // namespace

Volumes::Volumes(const Scene& scene, const ShadingSystem& shading)
    : worldFromCurrent_(glm::inverse(scene.cameraFromWorldAtOpen())) {
  for (const Object& o : scene.objects) {
    const DensityGrid* density = o.attributes->volume && !o.shapes.empty() ? o.shape().density() : nullptr;
    if (!density) continue;
    const MediumColors medium = shading.group(o.group).medium(true);
    const Visibility& v = o.attributes->visibility;
    list_.push_back({density, o.group, maskOf(v) | (v.camera ? kMaskCamera : 0u),
                     glm::inverse(o.currentFromObject.at(scene.options.shutterOpen)),
                     medium.scattering + medium.absorption});
  }
}

bool Volumes::seenBy(const Ray& ray, const Volume& volume, uint32_t mask) const {
  const auto* groups = ray.filter ? ray.filter->groups : nullptr;
  return (volume.mask & mask) && (!groups || (*groups)[static_cast<size_t>(volume.group)]);
}

vec3 Volumes::passed(const Ray& ray, float tMax, uint32_t mask) const {
  vec3 depth(0);
  for (const Volume& v : list_)
    if (seenBy(ray, v, mask))
      depth += v.extinction * v.density->columnDensity(transformPoint(v.objectFromCurrent, ray.origin),
                                                       transformVector(v.objectFromCurrent, ray.direction), 0, tMax);
  return depth == vec3(0) ? vec3(1) : glm::exp(-unitAlong(ray.direction) * depth);
}

// The farthest volume changes the light first. Volumes that overlap count as if the farther began where it leaves the
// nearer.
void Volumes::cross(const std::vector<Ray>& rays, const std::vector<float>& ends, const std::vector<SampleName>& names,
                    uint32_t mask, const ShadingSystem& shading, const ShadeContext& context,
                    HitAnswers& answers) const {
  std::vector<Crossing> all, ofTurn;
  std::vector<size_t> first;  // index of each ray's first crossing
  for (size_t r = 0; r < rays.size(); ++r) {
    first.push_back(all.size());
    const Ray& ray = rays[r];
    for (const Volume& v : list_) {
      Crossing c{static_cast<uint32_t>(r), &v, 0, ends[r]};
      if (seenBy(ray, v, mask) && cutLine(v.density->bound(), transformPoint(v.objectFromCurrent, ray.origin),
                                          transformVector(v.objectFromCurrent, ray.direction), c.enters, c.leaves))
        all.push_back(c);
    }
    std::stable_sort(all.begin() + static_cast<ptrdiff_t>(first[r]), all.end(),
                     [](const Crossing& a, const Crossing& b) { return a.enters > b.enters; });
  }
  first.push_back(all.size());
  for (size_t turn = 0;; ++turn) {
    ofTurn.clear();
    for (size_t r = 0; r < rays.size(); ++r)
      if (first[r] + turn < first[r + 1]) ofTurn.push_back(all[first[r] + turn]);
    if (ofTurn.empty()) return;
    std::stable_sort(ofTurn.begin(), ofTurn.end(),
                     [](const Crossing& a, const Crossing& b) { return a.volume < b.volume; });
    for (size_t begin = 0, end = 0; begin < ofTurn.size(); begin = end) {
      while (end < ofTurn.size() && end - begin < kTogether && ofTurn[end].volume == ofTurn[begin].volume) ++end;
      crossOne({ofTurn.data() + begin, end - begin}, rays, names, static_cast<uint32_t>(turn), shading, context,
               answers);
    }
  }
}

/// Lets rays cross the one Volume that they are all in. Those that meet nothing of it keep what they bring.
void Volumes::crossOne(std::span<const Crossing> crossings, const std::vector<Ray>& rays,
                       const std::vector<SampleName>& names, uint32_t turn, const ShadingSystem& shading,
                       const ShadeContext& context, HitAnswers& answers) const {
  const Volume& volume = *crossings[0].volume;
  ShadePoints ends(volume.group, 0, shading.group(volume.group).wantsSteps());
  std::vector<DensityAlongRay> ways;
  std::vector<uint32_t> which;
  for (const Crossing& c : crossings) {
    const Ray& ray = rays[c.ray];
    DensityAlongRay& way = ways.emplace_back();
    volume.density->cross(transformPoint(volume.objectFromCurrent, ray.origin),
                          transformVector(volume.objectFromCurrent, ray.direction), c.enters, c.leaves,
                          unitAlong(ray.direction), way);
    if (way.empty()) {
      ways.pop_back();
      continue;
    }
    const SampleName& name = names[c.ray];
    const int p = ends.add({hashCombine(name.key, randomStream("volu"), turn), name.sequence});
    for (int k = 0; k < ends.channelCount(); ++k) ends.channel(k)[p] = 0;
    ends.set3(kPx, p, ray.origin + c.leaves * ray.direction);
    ends.set3(kIx, p, (c.leaves - c.enters) * ray.direction);
    ends.set3(kNx, p, -ray.direction);
    ends.set3(kNgx, p, -ray.direction);
    ends.channel(kTime)[p] = ray.time;
    which.push_back(c.ray);
  }
  if (which.empty()) return;
  ShadedPoints colors;
  colors.resize(ends.count());
  for (size_t k = 0; k < which.size(); ++k)
    colors.set(static_cast<int>(k), answers.color[which[k]], answers.opacity[which[k]]);
  ShadeContext crossing = context;
  crossing.answers = nullptr;  // these belong to the rays' own points
  crossing.outputs = nullptr;
  crossing.variables = false;
  crossing.densities = ways;
  if (!shading.crossVolume(ends, true, crossing, colors)) return;
  for (size_t k = 0; k < which.size(); ++k) {
    answers.color[which[k]] = colors.color(static_cast<int>(k));
    answers.opacity[which[k]] = colors.opacity(static_cast<int>(k));
  }
}

}  // namespace tomales
