#include <algorithm>
#include <map>
#include <span>

#include "raytrace/ray_scene.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

/// Radius of the footprint of a ray without one, for each unit of its length: about a pixel.
constexpr float kLeastSpread = 5e-4f;

int widthOf(const std::vector<Primvar>& primvars, std::string_view name) {
  return std::find_if(primvars.begin(), primvars.end(), [&](const Primvar& p) { return p.name == name; })->width;
}

/// Returns the radiance of a hit, changed by Attribute "indirect" of its object (bleeding).
vec3 bled(const vec3& color, const Attributes& a) {
  return glm::mix(vec3(luminance(color)), color, a.indirect.bleeding) * a.indirect.bleedingColor;
}

/// Returns the indices of the hits, sorted by shade group, in the order of the hits inside each group.
std::vector<uint32_t> byGroup(const Scene& scene, const std::vector<Hit>& hits, std::vector<int>& group) {
  std::vector<uint32_t> order;
  order.reserve(hits.size());
  group.assign(hits.size(), -1);
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].object < 0) continue;
    group[i] = scene.objects[static_cast<size_t>(hits[i].object)].group;
    order.push_back(static_cast<uint32_t>(i));
  }
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return group[a] < group[b]; });
  return order;
}

/// Calls work(group, which) for each shade group that was met, with the indices of its hits.
template <class Work>
void forEachGroup(const Scene& scene, const std::vector<Hit>& hits, const Work& work) {
  std::vector<int> groupOf;
  const std::vector<uint32_t> order = byGroup(scene, hits, groupOf);
  for (size_t first = 0, last = 0; first < order.size(); first = last) {
    const int g = groupOf[order[first]];
    while (last < order.size() && groupOf[order[last]] == g) ++last;
    work(g, std::span(order).subspan(first, last - first));
  }
}

/// A hit later than shutter open is shaded like all other points: the surface is put back to its place at shutter open,
/// and the ray comes to it as it came to the moved surface. Drift is the motion by deformation from that place to the
/// hit.
void bringToOpen(const Scene& scene, const Ray& ray, const Hit& hit, ShadePoints& points, int i) {
  const ShadeGroup& group = scene.groups[static_cast<size_t>(points.group())];
  const float shutter = lerp(scene.options.shutterOpen, scene.options.shutterClose, ray.time);
  const mat4 openFromNow = glm::inverse(group.currentFromOpen.at(shutter));
  const vec3 I = points.get3(kIx, i);
  points.set3(kIx, i, glm::length(I) * normalizeOr(transformVector(openFromNow, I), I));
  points.set3(kDriftX, i, (transformPoint(openFromNow, points.position(i)) - hit.atOpen) / ray.time);
  points.set3(kPx, i, hit.atOpen);
}

/// Adds the point of a hit. Its parameters and primitive variables are those of the true surface; its place and normals
/// are those of the hit.
void addPoint(const RayScene::Impl& rays, const Ray& ray, const Hit& hit, SampleName name, ShadePoints& points) {
  const Scene& scene = rays.scene;
  const int i = points.add(name);
  evaluatePoint(scene, hit.object, hit.patch, hit.u, hit.v, points, i);
  const float radius = ray.radius + ray.spread * hit.t;
  if (points.hasSteps())
    evaluateSteps(scene, hit.object, hit.patch, hit.u, hit.v, std::max(radius, kLeastSpread * hit.t), points, i);
  const vec3 I = ray.direction * hit.t;
  points.set3(kPx, i, ray.origin + I);
  points.set3(kNx, i, hit.normal);
  points.set3(kNgx, i, hit.geometricNormal);
  points.set3(kIx, i, I);
  points.channel(kTime)[i] = ray.time;
  if (ray.time > 0) bringToOpen(scene, ray, hit, points, i);
  const float stands =
      std::max(radius, rays.leastRadius(static_cast<uint32_t>(points.group()), ray.level, ray.origin + I));
  if (stands > 0) points.channel(kArea)[i] = kPi * stands * stands;
}

HitMode modeOf(const Attributes& a, RayKind kind) {
  if (kind == RayKind::Transmission) return a.transmissionHitMode;
  return kind == RayKind::Diffuse ? a.diffuseHitMode : a.specularHitMode;
}

/// Returns Cs or Os of a point: its primitive variable, or its attribute.
vec3 primitiveColor(const ShadeGroup& group, const ShadePoints& points, int i, std::string_view name,
                    const vec3& attribute) {
  const int offset = offsetOf(group.primvars, name);
  return offset < 0 ? attribute
                    : vec3(points.primvar(offset)[i], points.primvar(offset + 1)[i], points.primvar(offset + 2)[i]);
}

/// Reads the value at point i of an output that hits provide. Returns false if there is no such value.
bool readOutput(const ShadeGroup& group, const ShadePoints& points, int i, const std::string& name,
                const HitAnswers& answers, uint32_t hit, vec3& out) {
  static const std::map<std::string_view, int> kVectors = {{"P", kPx}, {"N", kNx},       {"Ng", kNgx},
                                                           {"I", kIx}, {"dPdu", kDpduX}, {"dPdv", kDpdvX}};
  static const std::map<std::string_view, int> kNumbers = {{"u", kU}, {"v", kV}, {"s", kS}, {"t", kT}};
  const size_t colon = name.find(':');
  const std::string_view what = std::string_view(name).substr(0, colon), key = std::string_view(name).substr(colon + 1);
  if (name == "surface:Ci" || name == "surface:Oi") {
    out = name == "surface:Ci" ? answers.color[hit] : answers.opacity[hit];
  } else if (what == "primitive") {
    const auto vector = kVectors.find(key);
    const auto number = kNumbers.find(key);
    const int offset = offsetOf(group.primvars, key);
    if (vector != kVectors.end())
      out = points.get3(vector->second, i);
    else if (number != kNumbers.end())
      out = vec3(points.channel(number->second)[i]);
    else if (key == "Cs" || key == "Os")
      out = primitiveColor(group, points, i, key, key == "Cs" ? group.attributes->color : group.attributes->opacity);
    else if (offset >= 0)
      for (int k = 0; k < 3; ++k) out[k] = points.primvar(offset + std::min(k, widthOf(group.primvars, key) - 1))[i];
    else
      return false;
  } else if (what == "attribute") {
    const Param* param = findParam(group.attributes->user, std::string(key));
    if (!param) return false;
    for (size_t k = 0; k < 3; ++k)
      out[static_cast<int>(k)] = param->floats.size() == 3 ? param->floats[k] : param->number(0);
  } else {
    return false;
  }
  return true;
}

/// Writes the outputs of a hit. Where a shader ran, `shaded` has its values, as ShadeContext::outputs lists them.
void writeOutputs(const ShadeGroup& group, const ShadePoints& points, int i, uint32_t hit, const ShadedPoints* shaded,
                  const HitQuestion& question, const HitAnswers& answers) {
  size_t first = 0;
  for (const RayOutput& output : question.outputs) {
    const auto put = [&](int k) -> float& { return output.c[k][question.elements[hit]]; };
    vec3 value(0);
    if (readOutput(group, points, i, output.name, answers, hit, value)) {
      for (int k = 0; k < output.floats; ++k) put(k) = value[k];
    } else if (shaded && !std::isnan(shaded->variables[first][static_cast<size_t>(i)])) {
      for (int k = 0; k < output.floats; ++k)
        put(k) = shaded->variables[first + static_cast<size_t>(k)][static_cast<size_t>(i)];
    }
    first += static_cast<size_t>(output.floats);
  }
}

}  // namespace

void RayScene::shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                         const std::vector<SampleName>& names, const ShadingSystem& shading,
                         const ShadeContext& context, std::vector<vec3>& radiance) const {
  HitQuestion question;
  question.mode = HitMode::Shader;
  HitAnswers answers;
  std::swap(answers.color, radiance);
  shadeHits(rays, hits, names, shading, context, question, answers);
  std::swap(answers.color, radiance);
}

void RayScene::shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                         const std::vector<SampleName>& names, const ShadingSystem& shading,
                         const ShadeContext& context, const HitQuestion& question, HitAnswers& answers) const {
  const Scene& scene = impl_->scene;
  ShadeContext hitContext = context;
  hitContext.answers = nullptr;
  hitContext.variables = false;  // these belong to the points that the rays leave
  hitContext.outputs = question.outputs.empty() ? nullptr : &question.outputs;
  answers.color.assign(hits.size(), vec3(0));
  answers.opacity.assign(hits.size(), vec3(0));
  const bool diffuse = context.kind == RayKind::Diffuse;
  ShadedPoints shaded;
  std::vector<vec3> emission;
  forEachGroup(scene, hits, [&](int g, std::span<const uint32_t> which) {
    const ShadeGroup& group = scene.groups[static_cast<size_t>(g)];
    const Attributes& attributes = *group.attributes;
    ShadePoints points(g, floatsOfPoint(group.primvars), shading.group(g).wantsSteps());
    points.reserve(static_cast<int>(which.size()));
    for (const uint32_t i : which) addPoint(*impl_, rays[i], hits[i], names[i], points);
    const bool shades =
        question.wantsColor && question.mode.value_or(modeOf(attributes, context.kind)) == HitMode::Shader;
    if (shades) shading.shade(points, hitContext, shaded);
    emission.clear();
    if (!diffuse && context.seesAreaLights) shading.areaLightRadiance(points, emission, context);
    for (size_t k = 0; k < which.size(); ++k) {
      const uint32_t i = which[k];
      const int p = static_cast<int>(k);
      const vec3 opacity = shades ? shaded.opacity(p) : primitiveColor(group, points, p, "Os", attributes.opacity);
      const vec3 color = shades ? shaded.color(p) : opacity * primitiveColor(group, points, p, "Cs", attributes.color);
      answers.opacity[i] = opacity;
      answers.color[i] = diffuse ? bled(color, attributes) : emission.empty() ? color : color + emission[k];
      writeOutputs(group, points, p, i, shades ? &shaded : nullptr, question, answers);
    }
  });
}

void RayScene::throughVolumes(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                              const std::vector<SampleName>& names, RayMask mask, const ShadingSystem& shading,
                              const ShadeContext& context, HitAnswers& answers) const {
  if (impl_->volumes.none()) return;
  std::vector<float> ends;
  for (size_t r = 0; r < rays.size(); ++r) ends.push_back(hits[r].object < 0 ? rays[r].tMax : hits[r].t);
  impl_->volumes.cross(rays, ends, names, mask, shading, context, answers);
}

bool RayScene::hasVolumes() const { return !impl_->volumes.none(); }

vec3 RayScene::passedByVolumes(const Ray& ray, float tMax, RayMask mask) const {
  return impl_->volumes.passed(ray, tMax, mask);
}

void RayScene::crossVolumes(const std::vector<Ray>& came, const std::vector<Hit>& left, const std::vector<Ray>& rays,
                            const std::vector<Hit>& hits, const std::vector<SampleName>& names,
                            const ShadingSystem& shading, const ShadeContext& context, HitAnswers& answers) const {
  ShadeContext crossing = context;
  crossing.answers = nullptr;  // these belong to the points that the rays leave first
  ShadedPoints colors;
  forEachGroup(impl_->scene, left, [&](int g, std::span<const uint32_t> ofGroup) {
    for (const bool inside : {false, true}) {
      if (!shading.group(g).hasVolume(inside)) continue;
      ShadePoints ends(g, floatsOfPoint(impl_->scene.groups[static_cast<size_t>(g)].primvars),
                       shading.group(g).wantsSteps());
      std::vector<uint32_t> which;
      for (const uint32_t i : ofGroup) {
        if (hits[i].object < 0 || (dot(rays[i].direction, left[i].geometricNormal) < 0) != inside) continue;
        const vec3 I = std::max(hits[i].t, 0.0f) * rays[i].direction;
        addPoint(*impl_, came[i], left[i], names[i], ends);
        ends.set3(kPx, ends.count() - 1, rays[i].origin + I);
        ends.set3(kIx, ends.count() - 1, I);
        which.push_back(i);
      }
      colors.resize(ends.count());
      for (size_t k = 0; k < which.size(); ++k)
        colors.set(static_cast<int>(k), answers.color[which[k]], answers.opacity[which[k]]);
      if (which.empty() || !shading.crossVolume(ends, inside, crossing, colors)) continue;
      for (size_t k = 0; k < which.size(); ++k) {
        answers.color[which[k]] = colors.color(static_cast<int>(k));
        answers.opacity[which[k]] = colors.opacity(static_cast<int>(k));
      }
    }
  });
}

}  // namespace tomales
