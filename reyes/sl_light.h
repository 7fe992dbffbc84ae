// Light and rays, on values of a batch (rispec-table 9.4, 9.6). Part of reyes/sl.h.
#pragma once
#include "reyes/sl_services.h"

namespace sl {

inline Color ambient() {
  return tripleFrom([](TmVec3 out) { grid()->call->ambient(grid()->host, grid(), out); });
}
inline Color diffuse(const Normal& n) {
  return tripleFrom([&](TmVec3 out) { grid()->call->diffuse(grid()->host, grid(), n, out); });
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
  TmIlluminance query{};
  query.structBytes = sizeof query, query.axis = N, query.angle = float(rsl::kPi / 2);
  while (grid()->call->illuminance(grid()->host, grid(), &query)) {
    if (query.nonspecular) continue;
    where(query.lit, true, [&] { sum += Color(query.Cl) * pow(max(0, dot(R, normalize(Vector(query.L)))), size); });
  }
  return sum;
}
/// What specular() divides by the roughness to get its exponent, as Option "shade" "specular" says
/// (docs/decisions/0004).
inline float specularScale() {
  float& scale = Run::now().specularScale;
  if (scale == 0) scale = askText(TM_OF_OPTIONS, "shade:specular") == "rispec" ? 1 : 8;
  return scale;
}
/// The lobe of specular(), L and V of any length.
inline Float specularbrdf(const Vector& L, const Normal& N, const Vector& V, const Float& roughness) {
  return pow(max(0, dot(normalize(N), normalize(normalize(L) + normalize(V)))), specularScale() / roughness);
}
/// The same for all points of a call that lie on surfaces of one name (Attribute "identifier" "name").
inline Float randomGrid() {
  uint32_t hash = 0;
  for (const char c : askText(TM_OF_ATTRIBUTES, "identifier:name")) hash = rsl::latticeHash(int32_t(hash), c, 0);
  return double(rsl::latticeHash(int32_t(hash), Run::now().randoms++, 1) >> 8) * 0x1p-24;
}

inline Color trace(const Point& p, const Vector& r, const TmRayOptions& options = rsl::defaultRays()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->trace(grid()->host, grid(), p, r, &options, out, nullptr); });
}
template <class... List>
Color trace(const Point& p, const Vector& r, const char* first, const List&... list) {
  return trace(p, r, listed(rsl::defaultRays(), first, list...));
}
/// RSL's float trace(): how far the ray goes, 1e30 where it meets nothing.
inline Float traceDistance(const Point& p, const Vector& r, const TmRayOptions& options = rsl::defaultRays()) {
  Float out;
  grid()->call->trace(grid()->host, grid(), p, r, &options, TmVec3{}, out.data());
  return out;
}
template <class... List>
Float traceDistance(const Point& p, const Vector& r, const char* first, const List&... list) {
  return traceDistance(p, r, listed(rsl::defaultRays(), first, list...));
}
inline Color transmission(const Point& from, const Point& to, const TmRayOptions& options = rsl::defaultRays()) {
  return tripleFrom(
      [&](TmVec3 out) { grid()->call->transmissionWith(grid()->host, grid(), from, to - from, &options, out); });
}
template <class... List>
Color transmission(const Point& from, const Point& to, const char* first, const List&... list) {
  return transmission(from, to, listed(rsl::defaultRays(), first, list...));
}
inline void hemisphere(const Point& p, const Normal& n, int samples, const HemisphereList& list, Float* covered,
                       Triple* radiance) {
  const auto of = [](Triple* t) { return t ? t->out() : TmVec3{}; };
  const TmHemisphere out{sizeof(TmHemisphere), covered ? covered->data() : nullptr, of(radiance),
                         of(list.environmentColor), of(list.environmentDirection)};
  const TmRayOptions options = list.options(samples);
  grid()->call->hemisphere(grid()->host, grid(), p, n, &options, &out);
}
template <class... List>
Float occlusion(const Point& p, const Normal& n, int samples, const List&... list) {
  Float covered;
  hemisphere(p, n, samples, listed(HemisphereList(), list...), &covered, nullptr);
  return covered;
}
/// Mean radiance that arrives from the hemisphere around n (or the cone of the list): not multiplied by Cs or pi.
template <class... List>
Color indirectdiffuse(const Point& p, const Normal& n, int samples, const List&... list) {
  const HemisphereList all = listed(HemisphereList(), list...);
  Color radiance;
  hemisphere(p, n, samples, all, all.covered, &radiance);
  return radiance;
}
/// Its old name.
template <class... List>
Color indirect(const Point& p, const Normal& n, int samples, const List&... list) {
  return indirectdiffuse(p, n, samples, list...);
}

/// One value of each hit, by its gather() name.
struct Gathered {
  Gathered(const char* name, Triple* t) : output{name, 3, {t->out().x, t->out().y, t->out().z}} {}
  Gathered(const char* name, Float* f) : output{name, 1, {f->data(), nullptr, nullptr}} {}
  TmRayOutput output;
};
/// Of gather(): evenly over the cone, unless "distribution" is "cosine".
template <class... List>
TmRayOptions rays(const List&... list) {
  TmRayOptions even = rsl::defaultRays();
  even.uniform = 1;
  return listed(even, list...);
}
/// category: "illuminance" (or ""): rays are traced; "samplepattern": they are not, and all miss; "environment:NAME":
/// nor are they, but leave by the light of that picture, whatever direction and angle, with "environment:color",
/// "environment:direction" and "environment:solidangle" (the sum of color times solid angle over all is the light of
/// the whole picture).
template <class Hit, class Miss>
void gather(const char* category, const Point& p, const Vector& direction, float angle, int samples,
            const TmRayOptions& list, std::initializer_list<Gathered> wanted, const Hit& hit, const Miss& miss) {
  TmRayOptions options = list;
  options.samples = samples, options.coneAngle = angle;
  constexpr std::string_view kEnvironment = "environment:";
  const std::string_view kind(category);
  if (kind == "samplepattern")
    options.maxDistance = 0;
  else if (kind.substr(0, kEnvironment.size()) == kEnvironment)
    options.environment = kind.substr(kEnvironment.size()).data();
  else if (!kind.empty() && kind != "illuminance")
    throw std::invalid_argument(std::string("gathers \"") + category + "\", which there is not");
  std::vector<TmRayOutput> outputs;
  for (const Gathered& w : wanted) outputs.push_back(w.output);
  std::vector<uint8_t> met(static_cast<size_t>(grid()->padded));
  for (int ray = 0; grid()->call->gather(grid()->host, grid(), p, direction, &options, ray, met.data(), outputs.data(),
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
