// What shaders ask of the renderer, on values of a batch: spaces, derivatives, pictures, light, rays, point clouds, messages (rispec-table
// 9.1 to 9.6). Part of reyes/sl.h.
#pragma once
#include "reyes/sl_lists.h"
#include "reyes/sl_shadeops.h"

namespace sl {

template <class Service>
Triple tripleFrom(const Service& service) {
  Triple out;
  service(out.out());
  return out;
}

inline Triple transform(const char* from, const char* to, const Triple& p, TmTransformKind as = TM_AS_POINT) {
  return tripleFrom([&](TmVec3 out) { grid()->call->transform(grid()->host, grid(), as, from, to, p, out); });
}
inline Triple transform(const char* to, const Triple& p) { return transform("current", to, p); }
inline Triple vtransform(const char* to, const Triple& v) { return transform("current", to, v, TM_AS_VECTOR); }
inline Triple ntransform(const char* to, const Triple& n) { return transform("current", to, n, TM_AS_NORMAL); }

inline Float derivative(int direction, const Float& x) {
  Float out;
  grid()->call->derivative(grid()->host, grid(), direction, x.data(), out.data());
  return out;
}
inline Float Du(const Float& x) { return derivative(0, x); }
inline Float Dv(const Float& x) { return derivative(1, x); }
inline Triple Du(const Triple& p) { return {Du(xcomp(p)), Du(ycomp(p)), Du(zcomp(p))}; }
inline Triple Dv(const Triple& p) { return {Dv(xcomp(p)), Dv(ycomp(p)), Dv(zcomp(p))}; }
inline Float Deriv(const Float& a, const Float& b) { return Du(a) / Du(b) + Dv(a) / Dv(b); }
inline Triple Deriv(const Triple& a, const Float& b) { return Du(a) / Du(b) + Dv(a) / Dv(b); }
/// step() averaged over how x changes across the micropolygon.
inline Float filterstep(const Float& edge, const Float& x) {
  return filterstep(edge, x, abs(Du(x) * Float(grid()->du)) + abs(Dv(x) * Float(grid()->dv)));
}
/// Another number in [0, 1) at every call, by what the point is: the 48 bits of its first stratified sample name it, and a hash keeps its
/// numbers apart from the directions that its lobes draw.
inline Float randomNumber() {
  const int call = Run::now().randoms++;
  Float x, y;
  grid()->call->stratified(grid()->host, grid(), 0, 1, x.data(), y.data());
  forActive([&](int i) { x.data()[i] = float(rsl::latticeHash(int32_t(x[i] * 0x1p24f), int32_t(y[i] * 0x1p24f), call) >> 8) * 0x1p-24f; });
  return x;
}
/// Of a micropolygon whose points were at p.
inline Float area(const Triple& p) { return length(cross(Du(p) * Float(grid()->du), Dv(p) * Float(grid()->dv))); }
/// "shading" and "dicing" are the same here: one point is shaded for each micropolygon.
inline Float area(const Triple& p, const char*) { return area(p); }
inline Normal calculatenormal(const Triple& p) {
  return tripleFrom([&](TmVec3 out) { grid()->call->calculateNormal(grid()->host, grid(), p, out); });
}
/// 0 at the near clipping plane, 1 at the far one.
inline Float depth(const Triple& p) { return (zcomp(p) - double(grid()->clip[0])) / double(grid()->clip[1] - grid()->clip[0]); }

inline TmTextureLookup lookup() { return TM_TEXTURE_DEFAULTS; }
inline Triple texture(const char* name, const Float& s, const Float& t, const TmTextureLookup& options = lookup()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->textureWith(grid()->host, grid(), name, &options, s.data(), t.data(), out); });
}
inline Triple texture(const char* name) { return texture(name, Float(grid()->s), Float(grid()->t)); }
/// With a list, which begins with a name.
template <class... List>
Triple texture(const char* name, const Float& s, const Float& t, const char* first, const List&... list) { return texture(name, s, t, listed(lookup(), first, list...)); }
template <class... List>
Triple texture(const char* name, const char* first, const List&... list) { return texture(name, Float(grid()->s), Float(grid()->t), first, list...); }
/// One channel.
inline Float ftexture(const char* name, int channel, const Float& s, const Float& t) {
  TmTextureLookup one = lookup();
  one.channel = channel, one.channels = 1;
  Float out;
  grid()->call->textureWith(grid()->host, grid(), name, &one, s.data(), t.data(), {out.data(), nullptr, nullptr});
  return out;
}
/// RSL's texture(name, s1, t1, ... s4, t4): over the quadrilateral whose corners go round as a bilinear patch's, s1 and s4 opposite.
inline Triple texture(const char* name, const Float (&s)[4], const Float (&t)[4], const TmTextureLookup& options = lookup()) {
  const auto middle = [](const Float (&x)[4]) { return 0.25 * (x[0] + x[1] + x[2] + x[3]); };
  const auto along = [](const Float (&x)[4]) { return 0.5 * (x[1] - x[0] + x[3] - x[2]); };
  const auto across = [](const Float (&x)[4]) { return 0.5 * (x[2] - x[0] + x[3] - x[1]); };
  const Float sides[4] = {along(s), along(t), across(s), across(t)}, s0 = middle(s), t0 = middle(t);
  const float* steps[4] = {sides[0].data(), sides[1].data(), sides[2].data(), sides[3].data()};
  return tripleFrom([&](TmVec3 out) { grid()->call->textureOver(grid()->host, grid(), name, &options, s0.data(), t0.data(), steps, out); });
}
inline Triple environment(const char* name, const Triple& R, const TmTextureLookup& options = lookup()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->environmentWith(grid()->host, grid(), name, &options, R, out); });
}
template <class... List>
Triple environment(const char* name, const Triple& R, const char* first, const List&... list) { return environment(name, R, listed(lookup(), first, list...)); }
constexpr TmShadowLookup kShadowDefaults = {-1, 0, 1, 16};
inline Triple shadow(const char* name, const Triple& p, const TmShadowLookup& options = kShadowDefaults) {
  return tripleFrom([&](TmVec3 out) { grid()->call->shadow(grid()->host, grid(), name, p, &options, out); });
}
template <class... List>
Triple shadow(const char* name, const Triple& p, const char* first, const List&... list) { return shadow(name, p, listed(kShadowDefaults, first, list...)); }

// --- The ray that came to these points

/// By its RSL name; false: there is none.
inline bool rayinfo(const char* name, Triple& out) {
  Triple value;
  if (!grid()->call->rayInfo(grid()->host, grid(), name, value.out())) return false;
  out = value;
  return true;
}
inline int raydepth() { return rsl::Batch(grid()).rayDepth(); }
inline bool isshadowray() { return rsl::Batch(grid()).isShadowRay(); }
inline bool isindirectray() { return rsl::Batch(grid()).rayType() == rsl::RayType::Diffuse; }
inline std::string raylabel() { return grid()->call->rayLabel(grid()->host, grid()); }

// --- Other shaders, attributes, options

/// One of these types, or nothing.
inline bool askFor(TmWhom whom, int light, const char* name, int first, int last, TmValue& out) {
  int32_t type;
  return grid()->call->ask(grid()->host, grid(), whom, light, name, &type, &out) && type >= first && type <= last;
}
/// A value of another shader, of the attributes, ... False, and `out` as it was, where there is none of that name and type.
inline bool ask(TmWhom whom, const char* name, Float& out, int light = -1) {
  TmValue v;
  if (!askFor(whom, light, name, TM_FLOAT, TM_FLOAT, v)) return false;
  out = Float::of([&](int i) { return v.c[0][v.step * std::min(i, grid()->count - 1)]; });
  return true;
}
inline bool ask(TmWhom whom, const char* name, Triple& out, int light = -1) {
  TmValue v;
  if (!askFor(whom, light, name, TM_COLOR, TM_NORMAL, v)) return false;
  out = Triple::of([&](int i) {
    const int k = v.step * std::min(i, grid()->count - 1);
    return rsl::Vec3{v.c[0][k], v.c[1][k], v.c[2][k]};
  });
  return true;
}
inline bool ask(TmWhom whom, const char* name, Matrix& out, int light = -1) {
  TmValue v;
  if (!askFor(whom, light, name, TM_MATRIX, TM_MATRIX, v)) return false;
  out = Matrix(rsl::Matrix::of(v.c[0]));
  return true;
}
inline bool ask(TmWhom whom, const char* name, std::string& out, int light = -1) {
  TmValue v;
  if (!askFor(whom, light, name, TM_STRING, TM_STRING, v)) return false;
  out = v.string;
  return true;
}
/// Empty: there is none.
inline std::string askText(TmWhom whom, const char* name) {
  std::string text;
  ask(whom, name, text);
  return text;
}

// --- Light

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
  TmIlluminance query{sizeof(TmIlluminance), 0, "", N, float(rsl::kPi / 2), 0, {}, {}, nullptr, 0, 0, 0};
  while (grid()->call->illuminance(grid()->host, grid(), &query)) {
    if (query.nonspecular) continue;
    where(query.lit, true, [&] { sum += Color(query.Cl) * pow(max(0, dot(R, normalize(Vector(query.L)))), size); });
  }
  return sum;
}
/// What specular() divides by the roughness to get its exponent, as Option "shade" "specular" says (docs/decisions/0004).
inline float specularScale() {
  float& scale = Run::now().specularScale;
  if (scale == 0) scale = askText(TM_OF_OPTIONS, "shade:specular") == "rispec" ? 1 : 8;
  return scale;
}
/// The lobe of specular(), L and V of any length.
inline Float specularbrdf(const Vector& L, const Normal& N, const Vector& V, const Float& roughness) {
  return pow(max(0, dot(normalize(N), normalize(normalize(L) + normalize(V)))), specularScale() / roughness);
}
inline Color trace(const Point& p, const Vector& r, const TmRayOptions& options = rsl::defaultRays()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->trace(grid()->host, grid(), p, r, &options, out, nullptr); });
}
template <class... List>
Color trace(const Point& p, const Vector& r, const char* first, const List&... list) { return trace(p, r, listed(rsl::defaultRays(), first, list...)); }
/// RSL's float trace(): how far the ray goes, 1e30 where it meets nothing.
inline Float traceDistance(const Point& p, const Vector& r, const TmRayOptions& options = rsl::defaultRays()) {
  Float out;
  grid()->call->trace(grid()->host, grid(), p, r, &options, TmVec3{}, out.data());
  return out;
}
inline Color transmission(const Point& from, const Point& to, const TmRayOptions& options = rsl::defaultRays()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->transmissionWith(grid()->host, grid(), from, to - from, &options, out); });
}
template <class... List>
Color transmission(const Point& from, const Point& to, const char* first, const List&... list) {
  return transmission(from, to, listed(rsl::defaultRays(), first, list...));
}
template <class... List>
Float occlusion(const Point& p, const Normal& n, int samples, const List&... list) {
  TmRayOptions options = listed(rsl::defaultRays(), list...);
  options.samples = samples;
  Float out;
  grid()->call->occlusion(grid()->host, grid(), p, n, &options, out.data(), TmVec3{});
  return out;
}
/// Mean radiance that arrives from the hemisphere around n (or the cone of the list): not multiplied by Cs or pi.
template <class... List>
Color indirectdiffuse(const Point& p, const Normal& n, int samples, const List&... list) {
  TmRayOptions options = listed(rsl::defaultRays(), list...);
  options.samples = samples;
  Float covered;
  return tripleFrom([&](TmVec3 out) { grid()->call->occlusion(grid()->host, grid(), p, n, &options, covered.data(), out); });
}

// --- Point clouds

/// A number or a triple of the batch under the name of a channel.
struct Channel {
  Channel(const char* name, const Float& x) : value{name, 1, {x.data(), nullptr, nullptr}} {}
  Channel(const char* name, const Triple& v) : value{name, 3, {v.out().x, v.out().y, v.out().z}} {}
  TmCloudValue value;
};
inline TmCloudLookup cloudLookup() { return TM_CLOUD_DEFAULTS; }
inline bool bake3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels, const TmCloudLookup& options = cloudLookup()) {
  std::vector<TmCloudValue> values;
  for (const Channel& c : channels) values.push_back(c.value);
  return grid()->call->bake3d(grid()->host, grid(), file, p, n, &options, values.data(), int32_t(values.size())) != 0;
}
/// 1 where the file has data, which the channels then hold.
inline Float texture3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels, const TmCloudLookup& options = cloudLookup()) {
  std::vector<TmCloudValue> values;
  for (const Channel& c : channels) values.push_back(c.value);
  Float found;
  grid()->call->texture3d(grid()->host, grid(), file, p, n, &options, values.data(), int32_t(values.size()), found.data());
  return found;
}
/// E/pi of the nearest photons.
inline Color photonmap(const char* file, const Point& p, const Normal& n, int estimator = 50) {
  return tripleFrom([&](TmVec3 out) { grid()->call->photonMap(grid()->host, grid(), file, p, n, estimator, out); });
}

/// Of the photons of Attribute "photon" "causticmap"; none: black.
inline Color caustic(const Point& p, const Normal& n) {
  const std::string file = askText(TM_OF_ATTRIBUTES, "photon:causticmap");
  return file.empty() ? Color() : photonmap(file.c_str(), p, n);
}
/// Light that was baked as "_radiance_t" with "_area", where it leaves after diffusion: of the material of the list, else of marble. E/pi. The
/// approximation does not look at the normal.
template <class... List>
Color subsurface(const Point& p, const Normal&, const char* file, const List&... list) {
  const TmSubsurface material = listed(TmSubsurface(TM_SUBSURFACE_DEFAULTS), list...);
  return tripleFrom([&](TmVec3 out) { grid()->call->subsurface(grid()->host, grid(), file, p, &material, out); });
}

/// One value of each hit, by its gather() name.
using Gathered = std::pair<const char*, Triple*>;
template <class Hit, class Miss>
void gather(const Point& p, const Vector& direction, float angle, int samples, std::initializer_list<Gathered> wanted, const Hit& hit, const Miss& miss) {
  TmRayOptions options = rsl::defaultRays();
  options.samples = samples, options.coneAngle = angle;
  std::vector<TmRayOutput> outputs;
  for (const Gathered& w : wanted) outputs.push_back({w.first, 3, {w.second->out().x, w.second->out().y, w.second->out().z}});
  std::vector<uint8_t> met(static_cast<size_t>(grid()->padded));
  for (int ray = 0; grid()->call->gather(grid()->host, grid(), p, direction, &options, ray, met.data(), outputs.data(), int32_t(outputs.size())); ++ray) {
    where(met.data(), true, hit);
    where(met.data(), false, miss);
  }
}

/// Inside illuminance(): of that light.
template <class T>
bool lightsource(int light, const char* name, T& out) { return ask(TM_OF_LIGHT, name, out, light); }
inline bool textureinfo(const char* name, const char* what, std::vector<float>& numbers) {
  int32_t type;
  TmValue v;
  if (!grid()->call->textureInfo(grid()->host, grid(), name, what, &type, &v) || type == TM_STRING) return false;
  numbers.assign(v.c[0], v.c[0] + (type == TM_MATRIX ? 16 : v.length));
  return true;
}
inline bool textureinfo(const char* name, const char* what, std::string& text) {
  int32_t type;
  TmValue v;
  if (!grid()->call->textureInfo(grid()->host, grid(), name, what, &type, &v) || type != TM_STRING) return false;
  text = v.string;
  return true;
}

// What print() prints of a value at one point.
inline float at(const Float& x, int i) { return x[i]; }
inline rsl::Vec3 at(const Triple& v, int i) { return v[i]; }
inline rsl::Matrix at(const Matrix& m, int i) { return m[i]; }
template <class T>
const T& at(const T& uniform, int) { return uniform; }
/// A line for each active point; the letters are rsl::format's.
template <class... Values>
void print(const std::string& pattern, const Values&... values) {
  forActive([&](int i) { grid()->call->print(grid()->host, grid(), rsl::format(pattern, at(values, i)...).c_str()); });
}

inline std::string shadername(TmWhom whom = TM_OF_SURFACE) { return askText(whom, "__shadername"); }

}  // namespace sl
