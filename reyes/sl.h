// Shaders that read like RSL: values of a whole batch at once, with masks (reyes/shader/sl_values.h), operators
// (sl_operators.h), shadeops (sl_shadeops.h) and services (sl_services.h, sl_pictures.h, sl_light.h, sl_clouds.h). A
// compiler from RSL would write such code.
//   struct matte : sl::Surface {
//     void main() { Normal Nf = faceforward(normalize(N), I);  Oi = Os;  Ci = Os * Cs * diffuse(Nf); }
//   };
//   const rsl::Shader shader(TM_SURFACE, "matte", "doc", TM_KEEPS_OPACITY, sl::shade<matte>, {});
// A declaration sets the value at all points. An assignment (=, +=) changes it only at the points for which the
// conditionals and loops around it run, and services too take only those. Threads: a value belongs to the thread and
// the run of a shader that made it.
#pragma once
#include <type_traits>

#include "reyes/shader/sl_clouds.h"
#include "reyes/shader/sl_light.h"
#include "reyes/shader/sl_pictures.h"

namespace sl {

/// The globals that all kinds share.
struct Globals {
  Point P{rsl::view(grid()->P)};
  Normal N{rsl::view(grid()->N)}, Ng{grid()->Ng};
  Vector I{grid()->I}, dPdu{grid()->dPdu}, dPdv{grid()->dPdv};
  Float u{grid()->u}, v{grid()->v}, s{grid()->s}, t{grid()->t}, du{grid()->du}, dv{grid()->dv};
  Color Cs{grid()->Cs}, Os{grid()->Os};
  Vector dPdtime{grid()->dPdtime};
  Point E{rsl::Vec3{grid()->E[0], grid()->E[1], grid()->E[2]}};
  const float time = grid()->time, dtime = grid()->dtime;
  static constexpr int ncomps = 3;

  // RSL's names that a C++ program may have given away already. `out` may be a Float, Triple, Matrix or std::string.
#define SL_ASK(function, whom)                     \
  template <class T>                               \
  static bool function(const char* name, T& out) { \
    return ask(whom, name, out);                   \
  }
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
  static void printf(const std::string& pattern, const Values&... values) {
    print(pattern, values...);
  }

 protected:
  static void store(const Triple& from, TmVec3 to) {
    forActive([&](int i) { rsl::set(to, i, from[i]); });
  }
};

/// Shaders that ask which light arrives.
struct Lit : Globals {
  Vector L;  ///< The vector from P to the light. L and Cl count in illuminance() alone.
  Color Cl;
  int lightNumber = -1;  ///< The light's number, for ask(TM_OF_LIGHT, ...).

  /// RSL illuminance(): runs `body` once for each sample of each light. It runs for the points whose p the light
  /// reaches from within a cone around the axis. `angle` is half the angle of the cone: a number, or one for each
  /// point. Without an axis light counts from all sides. lights() makes lists.
  template <class Angle, class Body>
  void illuminance(const char* category, const Point& p, const Vector& axis, const Angle& angle, const LightList& list,
                   const Body& body) {
    const Vector around = axis;  // NOLINT(performance-unnecessary-copy-initialization): the body may change the axis
    TmIlluminance query = question(category);
    query.axis = around;
    if constexpr (std::is_arithmetic_v<Angle>) {
      query.angle = static_cast<float>(angle);
      forEachSample(query, p, list, body);
    } else {
      const Float angles = angle;
      query.angles = angles.data();
      forEachSample(query, p, list, body);
    }
  }
  template <class Angle, class Body>
  void illuminance(const char* category, const Point& p, const Vector& axis, const Angle& angle, const Body& body) {
    illuminance(category, p, axis, angle, LightList(), body);
  }
  template <class Angle, class Body>
  void illuminance(const Point& p, const Vector& axis, const Angle& angle, const Body& body) {
    illuminance("", p, axis, angle, body);
  }
  template <class Angle, class Body>
  void illuminance(const Point& p, const Vector& axis, const Angle& angle, const LightList& list, const Body& body) {
    illuminance("", p, axis, angle, list, body);
  }
  template <class Body>
  void illuminance(const char* category, const Point& p, const LightList& list, const Body& body) {
    forEachSample(question(category), p, list, body);
  }
  template <class Body>
  void illuminance(const Point& p, const LightList& list, const Body& body) {
    illuminance("", p, list, body);
  }
  template <class Body>
  void illuminance(const char* category, const Point& p, const Body& body) {
    illuminance(category, p, LightList(), body);
  }
  template <class Body>
  void illuminance(const Point& p, const Body& body) {
    illuminance("", p, body);
  }

 private:
  static TmIlluminance question(const char* category) {
    TmIlluminance query = tmIlluminanceDefaults();
    query.category = category;
    return query;
  }
  template <class Body>
  void forEachSample(TmIlluminance query, const Point& p, const LightList& list, const Body& body) {
    const Point where = p;  // NOLINT(performance-unnecessary-copy-initialization): the body may change p
    const std::vector<TmMessage> sent = list.messages();
    query.P = where;
    query.sent = sent.data();
    query.sentCount = int32_t(sent.size());
    query.refresh = list.refresh;
    while (grid()->call->illuminance(grid()->host, grid(), &query))
      sl::where(query.lit, true, [&] {
        L = Vector(query.L);
        Cl = Color(query.Cl);
        lightNumber = query.light;
        for (const LightList::Wanted& w : list.wanted) lightsource(lightNumber, w.name.c_str(), w.into.fills);
        body();
      });
  }
};
/// Makes the list of illuminance(): lights("lightcache", "refresh", "send:light:NAME", value, "light:NAME", &out, ...).
template <class... List>
LightList lights(const List&... list) {
  return listed(LightList(), list...);
}

struct Surface : Lit {
  Color Ci, Oi;
  void store() const {
    Globals::store(Ci, grid()->Ci);
    Globals::store(Oi, grid()->Oi);
  }
};

struct Volume : Lit {
  Color Ci{rsl::view(grid()->Ci)}, Oi{rsl::view(grid()->Oi)};
  void store() const {
    Globals::store(Ci, grid()->Ci);
    Globals::store(Oi, grid()->Oi);
  }
};

struct Displacement : Globals {
  void store() const {
    Globals::store(P, grid()->P);
    Globals::store(N, grid()->N);
  }
};

/// P and N are those of the point being lit, or for area lights those of the point on the light.
struct Light : Globals {
  Light() {
    if (ofArea()) {
      P = Point(grid()->Pl);
      N = Normal(grid()->Nl);
    }
  }
  Point Ps{rsl::view(grid()->P)};
  /// The vector from the light to Ps. It counts in illuminate() and solar(). For area lights and skies the renderer
  /// sets it, and it counts everywhere.
  Vector L{-Vector(rsl::view(grid()->L))};
  Color Cl;

  /// RSL illuminate(): runs `body` for the points in the cone (half angle). The others get no light.
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
  /// RSL solar(): runs `body` with light along one axis, for shaders with TM_LIGHT_SOLAR.
  template <class Body>
  void solar(const Vector& axis, const Body& body) {
    L = axis;
    body();
  }
  /// Light from a cone of directions (half angle): evenly over it with TM_LIGHT_SAMPLED, else along the axis.
  template <class Body>
  void solar(const Vector& axis, double angle, const Body& body) {
    L = axis;
    if (grid()->xi0) L = inCone(axis, float(angle));
    body();
  }
  /// Light from all around, for shaders with TM_LIGHT_SKY: the renderer chooses L.
  template <class Body>
  void solar(const Body& body) {
    body();
  }
  void store() const {
    if (!ofArea()) Globals::store(-L, grid()->L);
    Globals::store(Cl, grid()->Cl);
  }

 private:
  static bool ofArea() { return grid()->Pl.x != nullptr; }
  static Vector inCone(const Vector& axis, float angle) {
    return Vector::of([&](int i) {
      const int k = std::min(i, grid()->count - 1);
      const float z = 1 - grid()->xi0[k] * (1 - std::cos(angle)), r = std::sqrt(std::max(0.0f, 1 - z * z)),
                  phi = 2 * float(rsl::kPi) * grid()->xi1[k];
      const rsl::Vec3 n = rsl::normalize(axis[i]);
      rsl::Vec3 tangent, bitangent;
      rsl::orthonormalBasis(n, tangent, bitangent);
      return r * std::cos(phi) * tangent + r * std::sin(phi) * bitangent + z * n;
    });
  }
};

/// P is the position in the picture.
struct Imager : Globals {
  Color Ci{rsl::view(grid()->Ci)}, Oi{rsl::view(grid()->Oi)};
  Float alpha{grid()->alpha};
  void store() const {
    Globals::store(Ci, grid()->Ci);
    Globals::store(Oi, grid()->Oi);
    forActive([&](int i) { grid()->alpha[i] = alpha[i]; });
  }
};

/// The function that an rsl::Shader takes.
template <class Shader>
void shade(const TmGrid* g) {
  if (g->count == 0) return;
  Run run(g);
  Shader shader;
  shader.main();
  shader.store();
}

}  // namespace sl
