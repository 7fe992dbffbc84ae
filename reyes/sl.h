// Shaders that read like RSL: values of a whole batch at once, with masks, over reyes/shadeops.h. What a compiler from RSL would emit.
//   struct matte : sl::Surface { void main() { Normal Nf = faceforward(normalize(N), I);  Oi = Os;  Ci = Os * Cs * diffuse(Nf); } };
//   const rsl::Shader shader(TM_SURFACE, "matte", "doc", TM_KEEPS_OPACITY, sl::shade<matte>, {});
// Declarations take all points; assignments (=, +=) only those of the conditionals and loops around them, and so do services.
// Threads: a value belongs to the thread and the run of a shader that made it.
#pragma once
#include "reyes/sl_values.h"

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
/// Of a micropolygon whose points were at p.
inline Float area(const Triple& p) { return length(cross(Du(p) * Float(grid()->du), Dv(p) * Float(grid()->dv))); }
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
/// One channel.
inline Float ftexture(const char* name, int channel, const Float& s, const Float& t) {
  TmTextureLookup one = lookup();
  one.channel = channel, one.channels = 1;
  Float out;
  grid()->call->textureWith(grid()->host, grid(), name, &one, s.data(), t.data(), {out.data(), nullptr, nullptr});
  return out;
}
inline Triple environment(const char* name, const Triple& R, const TmTextureLookup& options = lookup()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->environmentWith(grid()->host, grid(), name, &options, R, out); });
}
inline Triple shadow(const char* name, const Triple& p, const TmShadowLookup& options = {-1, 0, 1, 16}) {
  return tripleFrom([&](TmVec3 out) { grid()->call->shadow(grid()->host, grid(), name, p, &options, out); });
}

inline Color ambient() {
  return tripleFrom([](TmVec3 out) { grid()->call->ambient(grid()->host, grid(), out); });
}
inline Color diffuse(const Normal& n) {
  return tripleFrom([&](TmVec3 out) { grid()->call->diffuse(grid()->host, grid(), n, out); });
}
inline Color specular(const Normal& n, const Vector& v, const Float& roughness) {
  return tripleFrom([&](TmVec3 out) { grid()->call->specular(grid()->host, grid(), n, v, roughness.data(), out); });
}
inline Color trace(const Point& p, const Vector& r, const TmRayOptions& options = rsl::defaultRays()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->trace(grid()->host, grid(), p, r, &options, out, nullptr); });
}
inline Color transmission(const Point& from, const Point& to, const TmRayOptions& options = rsl::defaultRays()) {
  return tripleFrom([&](TmVec3 out) { grid()->call->transmissionWith(grid()->host, grid(), from, to - from, &options, out); });
}
inline Float occlusion(const Point& p, const Normal& n, int samples) {
  TmRayOptions options = rsl::defaultRays();
  options.samples = samples;
  Float out;
  grid()->call->occlusion(grid()->host, grid(), p, n, &options, out.data(), TmVec3{});
  return out;
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

/// A value of another shader, of the attributes, ... False, and `out` as it was, where there is none of that name and type.
inline bool ask(TmWhom whom, const char* name, Float& out, int light = -1) {
  int32_t type;
  TmValue v;
  if (!grid()->call->ask(grid()->host, grid(), whom, light, name, &type, &v) || type != TM_FLOAT) return false;
  out = Float::of([&](int i) { return v.c[0][v.step * std::min(i, grid()->count - 1)]; });
  return true;
}
inline bool ask(TmWhom whom, const char* name, Triple& out, int light = -1) {
  int32_t type;
  TmValue v;
  if (!grid()->call->ask(grid()->host, grid(), whom, light, name, &type, &v) || type < TM_COLOR || type > TM_NORMAL) return false;
  out = Triple::of([&](int i) {
    const int k = v.step * std::min(i, grid()->count - 1);
    return rsl::Vec3{v.c[0][k], v.c[1][k], v.c[2][k]};
  });
  return true;
}
inline std::string askText(TmWhom whom, const char* name) {
  int32_t type;
  TmValue v;
  return grid()->call->ask(grid()->host, grid(), whom, -1, name, &type, &v) && type == TM_STRING ? v.string : "";
}

/// The globals that all kinds share.
struct Globals {
  Point P{rsl::view(grid()->P)};
  Normal N{rsl::view(grid()->N)}, Ng{grid()->Ng};
  Vector I{grid()->I}, dPdu{grid()->dPdu}, dPdv{grid()->dPdv};
  Float u{grid()->u}, v{grid()->v}, s{grid()->s}, t{grid()->t}, du{grid()->du}, dv{grid()->dv};
  Color Cs{grid()->Cs}, Os{grid()->Os};

 protected:
  static void store(const Triple& from, TmVec3 to) { forActive([&](int i) { rsl::set(to, i, from[i]); }); }
};

struct Surface : Globals {
  Color Ci, Oi;
  Vector L;  ///< From P to the light, in illuminance() alone, as Cl.
  Color Cl;
  int lightNumber = -1;  ///< Its number, for ask(TM_OF_LIGHT, ...).

  /// RSL illuminance(): `body` once for each sample, for the points that see it in the cone.
  template <class Body>
  void illuminance(const char* category, const Point&, const Vector& axis, float angle, const Body& body) {
    TmIlluminance query{sizeof(TmIlluminance), 0, category, axis, angle, 0, {}, {}, nullptr, 0, 0, 0};
    while (grid()->call->illuminance(grid()->host, grid(), &query))
      where(query.lit, true, [&] {
        L = Vector(query.L), Cl = Color(query.Cl), lightNumber = query.light;
        body();
      });
  }
  template <class Body>
  void illuminance(const Point& p, const Vector& axis, float angle, const Body& body) { illuminance("", p, axis, angle, body); }
  void store() const { Globals::store(Ci, grid()->Ci), Globals::store(Oi, grid()->Oi); }
};

struct Volume : Globals {
  Color Ci{rsl::view(grid()->Ci)}, Oi{rsl::view(grid()->Oi)};
  void store() const { Globals::store(Ci, grid()->Ci), Globals::store(Oi, grid()->Oi); }
};

struct Displacement : Globals {
  void store() const { Globals::store(P, grid()->P), Globals::store(N, grid()->N); }
};

struct Light : Globals {
  Point Ps{rsl::view(grid()->P)};
  Vector L;  ///< From the light to Ps, in illuminate() and solar().
  Color Cl;

  /// RSL illuminate(): `body` for the points in the cone (half angle); the others get no light.
  template <class Body>
  void illuminate(const Point& from, const Vector& axis, const Float& angle, const Body& body) {
    L = Ps - from;
    If(dot(normalize(L), normalize(axis)) >= cos(angle), body);
  }
  template <class Body>
  void illuminate(const Point& from, const Body& body) {
    L = Ps - from;
    body();
  }
  /// For shaders with TM_LIGHT_SOLAR.
  template <class Body>
  void solar(const Vector& axis, const Body& body) {
    L = axis;
    body();
  }
  void store() const { Globals::store(-L, grid()->L), Globals::store(Cl, grid()->Cl); }
};

/// The function of an rsl::Shader.
template <class Shader>
void shade(const TmGrid* g) {
  if (g->count == 0) return;
  Run run(g);
  Shader shader;
  shader.main();
  shader.store();
}

}  // namespace sl
