// Queries to the renderer, on values of a batch: spaces, derivatives, random numbers, the incoming ray, messages
// (RISpec 15.1, 15.2, 15.8). Part of reyes/sl.h.
#pragma once
#include "reyes/shader/sl_lists.h"
#include "reyes/shader/sl_shadeops.h"

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
/// Returns step() averaged over the change of x across the micropolygon.
inline Float filterstep(const Float& edge, const Float& x) {
  return filterstep(edge, x, abs(Du(x) * Float(grid()->du)) + abs(Dv(x) * Float(grid()->dv)));
}
/// Returns a number in [0, 1), a different one at every call. It is a hash of 48 bits that identify the point (its
/// first stratified sample) and of the number of the call. Directions for lobes come from another hash.
inline Float randomNumber() {
  const int call = Run::now().randoms++;
  Float x, y;
  grid()->call->stratified(grid()->host, grid(), 0, 1, x.data(), y.data());
  forActive([&](int i) {
    x.data()[i] = float(rsl::latticeHash(int32_t(x[i] * 0x1p24f), int32_t(y[i] * 0x1p24f), call) >> 8) * 0x1p-24f;
  });
  return x;
}
/// Returns three random numbers.
inline Triple random3() {
  const Float x = randomNumber(), y = randomNumber();
  return {x, y, randomNumber()};
}
/// Returns filterstep() over `width` times the change of x across the micropolygon.
inline Float filterstep(const Float& edge, const Float& x, const char*, double width) {
  return filterstep(edge, x, width * (abs(Du(x) * Float(grid()->du)) + abs(Dv(x) * Float(grid()->dv))));
}
/// Returns the area of a micropolygon whose points were at p.
inline Float area(const Triple& p) { return length(cross(Du(p) * Float(grid()->du), Dv(p) * Float(grid()->dv))); }
/// "shading" and "dicing" are the same here: one point is shaded for each micropolygon.
inline Float area(const Triple& p, const char*) { return area(p); }
inline Normal calculatenormal(const Triple& p) {
  return tripleFrom([&](TmVec3 out) { grid()->call->calculateNormal(grid()->host, grid(), p, out); });
}
/// Returns 0 at the near clipping plane, and 1 at the far one.
inline Float depth(const Triple& p) {
  return (zcomp(p) - double(grid()->clip[0])) / double(grid()->clip[1] - grid()->clip[0]);
}

// --- The ray that came to these points

/// Looks up a value of the ray by its RSL name. Returns false if there is none.
inline bool rayinfo(const char* name, Triple& out) {
  Triple value;
  if (!grid()->call->rayInfo(grid()->host, grid(), name, value.out())) return false;
  out = value;
  return true;
}
inline bool rayinfo(const char* name, Float& out) {
  Triple value;
  if (!grid()->call->rayInfo(grid()->host, grid(), name, value.out())) return false;
  out = xcomp(value);
  return true;
}
/// Looks up "type" (camera, diffuse, specular or transmission) or "label".
inline bool rayinfo(const char* name, std::string& out) {
  static const char* const kTypes[] = {"camera", "diffuse", "specular", "transmission"};
  if (std::string_view(name) == "label") {
    out = grid()->call->rayLabel(grid()->host, grid());
    return true;
  }
  if (std::string_view(name) == "type") {
    out = kTypes[rsl::Batch(grid()).rayNumber("type")];
    return true;
  }
  return false;
}
inline int raydepth() { return rsl::Batch(grid()).rayDepth(); }
inline bool isshadowray() { return rsl::Batch(grid()).isShadowRay(); }
inline bool isindirectray() { return rsl::Batch(grid()).rayType() == rsl::RayType::Diffuse; }
inline std::string raylabel() { return grid()->call->rayLabel(grid()->host, grid()); }

// --- Other shaders, attributes, options

/// Asks for a value whose type is in first..last. Returns false if there is none.
inline bool askFor(TmWhom whom, int light, const char* name, int first, int last, TmValue& out) {
  int32_t type;
  return grid()->call->ask(grid()->host, grid(), whom, light, name, &type, &out) && type >= first && type <= last;
}
/// Gets a value of another shader, of the attributes or of another TmWhom. Returns false, and leaves `out` alone, if
/// there is none of that name and type.
inline bool ask(TmWhom whom, const char* name, TmVec3 out, int light = -1) {
  TmValue v;
  if (!askFor(whom, light, name, out.y ? TM_COLOR : TM_FLOAT, out.y ? TM_NORMAL : TM_FLOAT, v)) return false;
  float* const to[3] = {out.x, out.y, out.z};
  for (int k = 0; k < (out.y ? 3 : 1); ++k) forActive([&](int i) { to[k][i] = v.c[k][v.step * i]; });
  return true;
}
inline bool ask(TmWhom whom, const char* name, Float& out, int light = -1) {
  return ask(whom, name, TmVec3{out.data(), nullptr, nullptr}, light);
}
inline bool ask(TmWhom whom, const char* name, Triple& out, int light = -1) {
  return ask(whom, name, out.out(), light);
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
/// Returns an empty text if there is none.
inline std::string askText(TmWhom whom, const char* name) {
  std::string text;
  ask(whom, name, text);
  return text;
}

/// Asks the light whose sample this is, inside illuminance().
template <class T>
bool lightsource(int light, const char* name, T&& out) {
  return ask(TM_OF_LIGHT, name, out, light);
}
// These return the value at one point, for print().
inline float at(const Float& x, int i) { return x[i]; }
inline rsl::Vec3 at(const Triple& v, int i) { return v[i]; }
inline rsl::Matrix at(const Matrix& m, int i) { return m[i]; }
template <class T>
const T& at(const T& uniform, int) {
  return uniform;
}
/// Prints a line for each active point. rsl::format explains the letters.
template <class... Values>
void print(const std::string& pattern, const Values&... values) {
  forActive([&](int i) { grid()->call->print(grid()->host, grid(), rsl::format(pattern, at(values, i)...).c_str()); });
}

inline std::string shadername(TmWhom whom = TM_OF_SURFACE) { return askText(whom, "__shadername"); }

}  // namespace sl
