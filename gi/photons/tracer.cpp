#include "gi/photons/tracer.h"

#include <utility>

#include "raytrace/emitter_shapes.h"
#include "raytrace/hit_list.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {

bool isOnFor(const ShadeGroup& group, int light) { return group.attributes->lights.contains(light); }

PhotonTracer::PhotonTracer(const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                           const PhotonSettings& settings, Log& log)
    : scene_(scene),
      rays_(rays),
      surfaces_(rays, shading, settings.seed, log),
      settings_(settings),
      worldUnit_(lengthScale(scene.cameraFromWorldAtOpen())) {
  for (const Object& o : scene.objects) groups_.push_back(o.group);
  for (int g = 0; g < static_cast<int>(scene.groups.size()); ++g) {
    media_.push_back(
        {mediumOf(shading.group(g).medium(true), worldUnit_), mediumOf(shading.group(g).medium(false), worldUnit_)});
    anyMedium_ |= !media_.back().inside.empty() || !media_.back().outside.empty();
    samplesTime_ |= rays.samplesTime(g);
  }
}

void PhotonTracer::trace(const PhotonSource& source, uint32_t seed, uint32_t first, size_t count, float share,
                         std::vector<StoredPhoton>& out) const {
  std::vector<EmittedPhoton> emitted(count);
  source.emit(first, seed, emitted);
  const uint32_t stream = hashCombine(seed, static_cast<uint32_t>(source.light()), randomStream("boun"));
  const std::vector<uint8_t>* besideLamp = nullptr;
  std::vector<Path> paths;
  Scratch scratch;
  paths.reserve(count);
  scratch.flying.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const EmittedPhoton& e = emitted[i];
    if (!(maxComponent(e.power) > 0) || !isFinite(e.power)) continue;
    scratch.flying.push_back(static_cast<uint32_t>(paths.size()));
    const uint32_t number = first + static_cast<uint32_t>(i);
    paths.push_back({e.ray, e.power * share, number, source.light()});
    paths.back().ray.time = timeOf(number, stream);
    paths.back().lift = liftOf(e.ray, e.normal);
    if (e.passesLamp && !besideLamp) besideLamp = rays_.groupsBesideLamp(source.light());
    if (e.passesLamp) paths.back().besideLamp = besideLamp;
    // Gather rays see the glow itself, so its photons begin as photons that have been scattered by a surface.
    if (source.light() < 0) {
      paths.back().depth = paths.back().bounces = 1;
      paths.back().specular = false;
    }
  }
  while (!scratch.flying.empty()) {
    throwIfStopped();
    advance(paths, stream, scratch, out);
  }
}

/// A whole path happens at one time of the shutter.
float PhotonTracer::timeOf(uint32_t number, uint32_t stream) const {
  return samplesTime_ ? sobol1(number, hashCombine(stream, randomStream("time"))) : 0.0f;
}

/// Moves every path to its next surface; paths that end there are removed from `flying`.
void PhotonTracer::advance(std::vector<Path>& paths, uint32_t stream, Scratch& s,
                           std::vector<StoredPhoton>& out) const {
  fly(paths, s);
  crossMedia(paths, stream, s, out);
  for (size_t k = 0; rays_.hasVolumes() && k < s.flying.size(); ++k)
    if (s.hits[k].object >= 0)
      paths[s.flying[k]].power *= rays_.passedByVolumes(paths[s.flying[k]].ray, s.hits[k].t, kMaskPhoton);
  ask(paths, stream, s);
  draw(paths, stream, s);
  size_t kept = 0;
  for (size_t k = 0; k < s.flying.size(); ++k) {
    Path& path = paths[s.flying[k]];
    if (s.scattered[k] || (s.hits[k].object >= 0 &&
                           interact(path, s.hits[k], *s.answers[k], {s.direction[k], s.survival[k]}, stream, out)))
      s.flying[kept++] = s.flying[k];
  }
  s.flying.resize(kept);
}

/// Finds the hits; photons that meet nothing leave the scene.
void PhotonTracer::fly(std::vector<Path>& paths, Scratch& s) const {
  s.hits.resize(s.flying.size());
  size_t kept = 0;
  for (const uint32_t i : s.flying) {
    // The hit is made in place: a copy would stall, because it reads in large pieces what has just been written in
    // small ones.
    const Hit& hit = *::new (&s.hits[kept]) Hit(firstHit(paths[i]));
    if (hit.object >= 0) s.flying[kept++] = i;
  }
  s.flying.resize(kept);
  s.hits.resize(kept);
}

/// Returns the first hit of a photon. Photons leave polygons, not the true surfaces, so a ray may start just before its
/// polygon. If that ray meets nothing near, its hit is the one that the hit list would find, at less cost.
Hit PhotonTracer::firstHit(Path& path) const {
  RayFilter filter;
  filter.also = std::exchange(path.besideLamp, nullptr);
  if (filter.also) path.ray.filter = &filter;
  Ray free = path.ray;
  const bool hasList = free.offset > 0;
  if (hasList) {
    free.origin += path.lift;
    free.offset = free.bias = 0;
  }
  Hit hit = rays_.closest(free, kMaskPhoton);
  if (hasList && hit.t <= recordingWindow(path.ray.offset))
    hit = rays_.closest(path.ray, kMaskPhoton);
  else
    path.ray.origin = free.origin;  // t counts from that origin
  path.ray.filter = nullptr;
  return hit;
}

vec3 PhotonTracer::liftOf(const Ray& ray, const vec3& normal) {
  return std::copysign(roundingAt(ray.origin), dot(ray.direction, normal)) * normal;
}

void PhotonTracer::draw(const std::vector<Path>& paths, uint32_t stream, Scratch& s) const {
  const size_t count = s.flying.size();
  s.number.resize(count);
  s.name.resize(count);
  s.xi.resize(count);
  s.direction.resize(count);
  s.survival.resize(count);
  for (size_t k = 0; k < count; ++k) {
    const Path& path = paths[s.flying[k]];
    s.number[k] = path.number;
    s.name[k] = keyOf(path, stream);
  }
  sobol2(s.number, s.name, s.xi);
  cosineHemispheres(s.xi, s.direction);
  for (uint32_t& name : s.name) name = hashCombine(name, 1u);
  sobol1(s.number, s.name, s.survival);
}

/// A photon that collides before it arrives is stored there, and meets no surface in this step.
void PhotonTracer::crossMedia(std::vector<Path>& paths, uint32_t stream, Scratch& s,
                              std::vector<StoredPhoton>& out) const {
  s.scattered.assign(s.flying.size(), 0);
  for (size_t k = 0; anyMedium_ && k < s.flying.size(); ++k) {
    Path& path = paths[s.flying[k]];
    Hit& hit = s.hits[k];
    const Media& media = media_[static_cast<size_t>(groupOf(hit))];
    const Medium& medium = dot(path.ray.direction, hit.geometricNormal) > 0 ? media.inside : media.outside;
    const float majorant = medium.majorant(path.power);
    if (!(majorant > 0)) continue;
    const uint32_t name = hashCombine(keyOf(path, stream), randomStream("medi"), path.collisions);
    const float flight = -std::log(1 - sobol1(path.number, name)) / majorant;
    if (!(flight < hit.t)) continue;
    s.scattered[k] = collideWith(path, medium, landsOn(path, groupOf(hit)), flight, name, out);
    hit.object = -1;
  }
}

/// Returns false where the path ends.
bool PhotonTracer::collideWith(Path& path, const Medium& medium, bool isLit, float flight, uint32_t name,
                               std::vector<StoredPhoton>& out) const {
  const vec3 P = path.ray.origin + flight * path.ray.direction;
  const vec3 passed = rays_.hasVolumes() ? rays_.passedByVolumes(path.ray, flight, kMaskPhoton) : vec3(1);
  if (isLit)
    out.push_back({P, vec3(0), passed * path.power / (medium.majorant(path.power) * worldUnit_), -1, path.depth,
                   path.bounces, path.specularFirst});
  const Collision collision = collide(medium, path.power, sobol1(path.number, hashCombine(name, 1u)));
  if (collision.event == Collision::Absorbed) return false;
  path.power = passed * collision.power;
  ++path.collisions;
  if (collision.event == Collision::None) {  // the same ray goes on from there
    path.ray.origin = P;
    path.ray.offset = std::max(0.0f, path.ray.offset - flight);
    path.ray.bias = std::max(0.0f, path.ray.bias - flight);
    return true;
  }
  if (!isLit || ++path.depth >= settings_.maxDepth || !countScattering(path)) return false;
  const float time = path.ray.time;
  path.ray = {P, directionOnSphere(sobol2(path.number, hashCombine(name, 2u)))};
  path.ray.time = time;
  return true;
}

/// Finds the answer of the surface at every hit: that of its group, or of its shader.
void PhotonTracer::ask(const std::vector<Path>& paths, uint32_t stream, Scratch& s) const {
  s.answers.resize(s.hits.size());
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<SampleName> names;
  std::vector<size_t> which;
  for (size_t k = 0; k < s.hits.size(); ++k) {
    if (s.hits[k].object < 0) continue;
    if ((s.answers[k] = surfaces_.even(groupOf(s.hits[k])))) continue;
    const Path& path = paths[s.flying[k]];
    rays.push_back(path.ray);
    hits.push_back(s.hits[k]);
    which.push_back(k);
    names.push_back({hashCombine(stream, path.number, static_cast<uint32_t>(path.depth)), 0});
  }
  if (which.empty()) return;
  s.found = surfaces_.ask(rays, hits, names);
  for (size_t i = 0; i < which.size(); ++i) s.answers[which[i]] = &s.found[i];
}

uint32_t PhotonTracer::keyOf(const Path& path, uint32_t stream) {
  return hashCombine(stream, static_cast<uint32_t>(path.depth) | path.surfacesPassed << 16);
}

}  // namespace tomales
