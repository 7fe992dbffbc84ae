// Shaders that read like RSL: values of a whole batch at once, with masks (reyes/sl_values.h), shadeops
// (sl_shadeops.h) and services (sl_services.h, sl_pictures.h, sl_light.h, sl_clouds.h). What a compiler from RSL would emit.
//   struct matte : sl::Surface { void main() { Normal Nf = faceforward(normalize(N), I);  Oi = Os;  Ci = Os * Cs * diffuse(Nf); } };
//   const rsl::Shader shader(TM_SURFACE, "matte", "doc", TM_KEEPS_OPACITY, sl::shade<matte>, {});
// Declarations take all points; assignments (=, +=) only those of the conditionals and loops around them, and so do services.
// Threads: a value belongs to the thread and the run of a shader that made it.
#pragma once
#include "reyes/sl_clouds.h"
#include "reyes/sl_light.h"
#include "reyes/sl_pictures.h"

namespace sl {

/// The globals that all kinds share.
struct Globals {
  Point P{rsl::view(grid()->P)};
  Normal N{rsl::view(grid()->N)}, Ng{grid()->Ng};
  Vector I{grid()->I}, dPdu{grid()->dPdu}, dPdv{grid()->dPdv};
  Float u{grid()->u}, v{grid()->v}, s{grid()->s}, t{grid()->t}, du{grid()->du}, dv{grid()->dv};
  Color Cs{grid()->Cs}, Os{grid()->Os};

  // RSL's names that a C++ program may have given away already. `out` may be a Float, Triple, Matrix or std::string.
#define SL_ASK(function, whom) \
  template <class T>           \
  static bool function(const char* name, T& out) { return ask(whom, name, out); }
  SL_ASK(surface, TM_OF_SURFACE)
  SL_ASK(displacement, TM_OF_DISPLACEMENT)
  SL_ASK(atmosphere, TM_OF_ATMOSPHERE)
  SL_ASK(incident, TM_OF_INCIDENT)
  SL_ASK(opposite, TM_OF_OPPOSITE)
  SL_ASK(attribute, TM_OF_ATTRIBUTES)
  SL_ASK(option, TM_OF_OPTIONS)
  SL_ASK(rendererinfo, TM_OF_RENDERER)
#undef SL_ASK
  static Float random() { return randomNumber(); }
  static Float randomgrid() { return randomGrid(); }
  template <class... Values>
  static void printf(const std::string& pattern, const Values&... values) { print(pattern, values...); }

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
