// Textures, environments and shadow maps, on values of a batch (RISpec 15.7). Part of reyes/sl.h.
#pragma once
#include "reyes/shader/sl_services.h"

namespace sl {

inline Triple texture(const char* name, const Float& s, const Float& t,
                      const TmTextureOptions& options = tmTextureDefaults()) {
  return tripleFrom(
      [&](TmVec3 out) { grid()->call->texture(grid()->host, grid(), name, &options, s.data(), t.data(), out); });
}
inline Triple texture(const char* name) { return texture(name, Float(grid()->s), Float(grid()->t)); }
/// Takes a parameter list, which begins with a name.
template <class... List>
Triple texture(const char* name, const Float& s, const Float& t, const char* first, const List&... list) {
  return texture(name, s, t, listed(tmTextureDefaults(), first, list...));
}
template <class... List>
Triple texture(const char* name, const char* first, const List&... list) {
  return texture(name, Float(grid()->s), Float(grid()->t), first, list...);
}
/// Reads one channel.
template <class... List>
Float ftexture(const char* name, int channel, const Float& s, const Float& t, const List&... list) {
  TmTextureOptions one = listed(tmTextureDefaults(), list...);
  one.channel = channel;
  Float out;
  grid()->call->texture(grid()->host, grid(), name, &one, s.data(), t.data(), {out.data(), nullptr, nullptr});
  return out;
}
/// Implements RSL's texture(name, s1, t1, ... s4, t4): averages over the quadrilateral with these corners. They are in
/// the order of a bilinear patch, so s1 and s4 are opposite each other.
inline Triple texture(const char* name, const Float (&s)[4], const Float (&t)[4],
                      TmTextureOptions options = tmTextureDefaults()) {
  const auto middle = [](const Float(&x)[4]) { return 0.25 * (x[0] + x[1] + x[2] + x[3]); };
  const auto along = [](const Float(&x)[4]) { return 0.5 * (x[1] - x[0] + x[3] - x[2]); };
  const auto across = [](const Float(&x)[4]) { return 0.5 * (x[2] - x[0] + x[3] - x[1]); };
  const Float sides[4] = {along(s), along(t), across(s), across(t)}, s0 = middle(s), t0 = middle(t);
  for (int k = 0; k < 4; ++k) options.region[k] = sides[k].data();
  return texture(name, s0, t0, options);
}
/// RSL's filterregion: the region over which texture() averages instead of the micropolygon.
struct FilterRegion {
  Float s, t, sides[4];
  /// Sets it to the region of a micropolygon whose points were at s, t.
  void calculate2d(const Float& atS, const Float& atT) {
    const Float du(grid()->du), dv(grid()->dv);
    s = atS;
    t = atT;
    sides[0] = Du(s) * du;
    sides[1] = Du(t) * du;
    sides[2] = Dv(s) * dv;
    sides[3] = Dv(t) * dv;
  }
  void scale(const Float& by) {
    for (Float& side : sides) side *= by;
  }
};
template <class... List>
Triple texture(const char* name, const FilterRegion& over, const List&... list) {
  TmTextureOptions options = listed(tmTextureDefaults(), list...);
  for (int k = 0; k < 4; ++k) options.region[k] = over.sides[k].data();
  return texture(name, over.s, over.t, options);
}
inline Triple environment(const char* name, const Triple& R, const TmTextureOptions& options = tmTextureDefaults()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->environment(grid()->host, grid(), name, &options, R, out); });
}
template <class... List>
Triple environment(const char* name, const Triple& R, const char* first, const List&... list) {
  return environment(name, R, listed(tmTextureDefaults(), first, list...));
}
/// Reads one channel.
template <class... List>
Float fenvironment(const char* name, int channel, const Triple& R, const List&... list) {
  TmTextureOptions one = listed(tmTextureDefaults(), list...);
  one.channel = channel;
  Float out;
  grid()->call->environment(grid()->host, grid(), name, &one, R, {out.data(), nullptr, nullptr});
  return out;
}
/// Averages over the cone that holds four directions.
inline Triple environment(const char* name, const Vector (&R)[4]) {
  const Vector middle = normalize(normalize(R[0]) + normalize(R[1]) + normalize(R[2]) + normalize(R[3]));
  Float least = 1;
  for (const Vector& r : R) least = min(least, dot(normalize(r), middle));
  const Float angle = 2 * acos(clamp(least, -1, 1)) / std::sqrt(2.0);
  TmTextureOptions options = tmTextureDefaults();
  options.angle = angle.data();
  return environment(name, middle, options);
}
inline Triple shadow(const char* name, const Triple& p, const TmShadowOptions& options = tmShadowDefaults()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->shadow(grid()->host, grid(), name, &options, p, out); });
}
template <class... List>
Triple shadow(const char* name, const Triple& p, const char* first, const List&... list) {
  return shadow(name, p, listed(tmShadowDefaults(), first, list...));
}

/// Returns the shadow over a quadrilateral, as the mean of its quarters. Its four corners have the order of texture().
template <class... List>
Triple shadow(const char* name, const Point (&p)[4], const List&... list) {
  const auto at = [&](double a, double b) {
    return (1 - b) * ((1 - a) * p[0] + a * p[1]) + b * ((1 - a) * p[2] + a * p[3]);
  };
  Triple sum;
  for (const double a : {0.25, 0.75})
    for (const double b : {0.25, 0.75}) sum += shadow(name, Point(at(a, b)), listed(tmShadowDefaults(), list...));
  return 0.25 * sum;
}

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

}  // namespace sl
