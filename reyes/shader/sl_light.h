// Functions of light (RISpec 15.6) and PRMan's functions of rays, on values of a batch. Part of reyes/sl.h.
#pragma once
#include "reyes/shader/sl_services.h"

namespace sl {

inline Color ambient() {
  return tripleFrom([](TmVec3 out) { grid()->call->ambient(grid()->host, grid(), out); });
}
inline Color diffuse(const Normal& n) {
  return tripleFrom([&](TmVec3 out) { grid()->call->diffuse(grid()->host, grid(), TM_ALL_LIGHT, n, out); });
}
inline Color specular(const Normal& n, const Vector& v, const Float& roughness) {
  return tripleFrom([&](TmVec3 out) { grid()->call->specular(grid()->host, grid(), n, v, roughness.data(), out); });
}
/// Phong's highlight (RISpec 15.6): the sum of Cl max(0, R.L)^size on the side of N.
inline Color phong(const Normal& n, const Vector& v, const Float& size) {
  const Normal N = normalize(n);
  const Vector R = reflect(-normalize(v), N);
  Color sum;
  if (!rsl::Batch(grid()).wantsHighlights()) return sum;
  TmIlluminance query = tmIlluminanceDefaults();
  query.axis = N;
  query.angle = float(rsl::kPi / 2);
  while (grid()->call->illuminance(grid()->host, grid(), &query)) {
    if (query.nonspecular) continue;
    where(query.lit, true, [&] { sum += Color(query.Cl) * pow(max(0, dot(R, normalize(Vector(query.L)))), size); });
  }
  return sum;
}
/// Returns the number that specular() divides by the roughness to get its exponent. Option "shade" "specular" decides
/// it (docs/decisions/0004).
inline float specularScale() {
  float& scale = Run::now().specularScale;
  if (scale == 0) scale = askText(TM_OF_OPTIONS, "shade:specular") == "rispec" ? 1 : 8;
  return scale;
}
/// Returns the lobe of specular(). L and V may have any length.
inline Float specularbrdf(const Vector& L, const Normal& N, const Vector& V, const Float& roughness) {
  return pow(max(0, dot(normalize(N), normalize(normalize(L) + normalize(V)))), specularScale() / roughness);
}
/// Returns a random number, the same at all points of a call and on all surfaces of one name (Attribute "identifier"
/// "name").
inline Float randomGrid() {
  uint32_t hash = 0;
  for (const char c : askText(TM_OF_ATTRIBUTES, "identifier:name")) hash = rsl::latticeHash(int32_t(hash), c, 0);
  return double(rsl::latticeHash(int32_t(hash), Run::now().randoms++, 1) >> 8) * 0x1p-24;
}

inline Color trace(const Point& p, const Vector& r, const TmRayOptions& options = tmRayDefaults()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->trace(grid()->host, grid(), &options, p, r, out, nullptr); });
}
template <class... List>
Color trace(const Point& p, const Vector& r, const char* first, const List&... list) {
  return trace(p, r, listed(tmRayDefaults(), first, list...));
}
/// Implements RSL's float trace(): returns how far the ray goes, or 1e30 where it meets nothing.
inline Float traceDistance(const Point& p, const Vector& r, const TmRayOptions& options = tmRayDefaults()) {
  Float out;
  grid()->call->trace(grid()->host, grid(), &options, p, r, TmVec3{}, out.data());
  return out;
}
template <class... List>
Float traceDistance(const Point& p, const Vector& r, const char* first, const List&... list) {
  return traceDistance(p, r, listed(tmRayDefaults(), first, list...));
}
inline Color transmission(const Point& from, const Point& to, const TmRayOptions& options = tmRayDefaults()) {
  return tripleFrom(
      [&](TmVec3 out) { grid()->call->transmission(grid()->host, grid(), &options, from, to - from, out); });
}
template <class... List>
Color transmission(const Point& from, const Point& to, const char* first, const List&... list) {
  return transmission(from, to, listed(tmRayDefaults(), first, list...));
}
inline void occlusion(const Point& p, const Normal& n, int samples, HemisphereList list) {
  list.rays.samples = samples;
  list.options.pointCloud = list.pointBased ? list.file : nullptr;
  grid()->call->occlusion(grid()->host, grid(), &list.rays, p, n, &list.options);
}
template <class... List>
Float occlusion(const Point& p, const Normal& n, int samples, const List&... list) {
  HemisphereList all = listed(HemisphereList(), list...);
  Float covered;
  all.options.covered = covered.data();
  occlusion(p, n, samples, all);
  return covered;
}
/// Returns the mean radiance that arrives from the hemisphere around n (or the cone of the list), not multiplied by Cs
/// or pi.
template <class... List>
Color indirectdiffuse(const Point& p, const Normal& n, int samples, const List&... list) {
  HemisphereList all = listed(HemisphereList(), list...);
  Color radiance;
  all.options.radiance = radiance.out();
  occlusion(p, n, samples, all);
  return radiance;
}
/// Does the same as indirectdiffuse(), under its old name.
template <class... List>
Color indirect(const Point& p, const Normal& n, int samples, const List&... list) {
  return indirectdiffuse(p, n, samples, list...);
}

/// A value that gather() gets of each hit, by its name.
struct Gathered {
  Gathered(const char* name, Triple* t) : output{name, t->out()} {}
  Gathered(const char* name, Float* f) : output{name, {f->data(), nullptr, nullptr}} {}
  TmChannel output;
};
/// Makes the options of gather() from a list. Rays are uniform over the cone's solid angle unless "distribution" is
/// "cosine".
template <class... List>
TmRayOptions rays(const List&... list) {
  TmRayOptions even = tmRayDefaults();
  even.uniform = 1;
  return listed(even, list...);
}
/// Implements RSL's gather(). The category "illuminance" (or "") traces rays; "samplepattern" only makes directions,
/// which all count as misses. "environment:NAME" traces no rays either. All count as misses then, and their directions
/// follow the light of that picture, whatever direction and angle are given. They have "environment:color",
/// "environment:direction" and "environment:solidangle"; the sum of color times solid angle over all rays is the light
/// of the whole picture.
template <class Hit, class Miss>
void gather(const char* category, const Point& p, const Vector& direction, float angle, int samples,
            const TmRayOptions& list, std::initializer_list<Gathered> wanted, const Hit& hit, const Miss& miss) {
  TmRayOptions options = list;
  options.samples = samples;
  options.coneAngle = angle;
  constexpr std::string_view kEnvironment = "environment:";
  const std::string_view kind(category);
  if (kind == "samplepattern")
    options.maxDistance = 0;
  else if (kind.substr(0, kEnvironment.size()) == kEnvironment)
    options.environment = kind.substr(kEnvironment.size()).data();
  else if (!kind.empty() && kind != "illuminance")
    throw std::invalid_argument(std::string("gathers \"") + category + "\", which is unknown");
  std::vector<TmChannel> outputs;
  for (const Gathered& w : wanted) outputs.push_back(w.output);
  std::vector<uint8_t> met(static_cast<size_t>(grid()->padded));
  for (int ray = 0; grid()->call->gather(grid()->host, grid(), &options, p, direction, ray, met.data(), outputs.data(),
                                         int32_t(outputs.size()));
       ++ray) {
    where(met.data(), true, hit);
    where(met.data(), false, miss);
  }
}
template <class Hit, class Miss>
void gather(const Point& p, const Vector& direction, float angle, int samples, std::initializer_list<Gathered> wanted,
            const Hit& hit, const Miss& miss) {
  gather("", p, direction, angle, samples, rays(), wanted, hit, miss);
}

}  // namespace sl
