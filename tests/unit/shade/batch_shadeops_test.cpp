// Every shadeop of RISpec 15.1 to 15.5 on values of a batch, against values computed here by other means: varying and
// uniform, and under a mask, which must leave the other points alone.
#include <cmath>
#include <complex>

#include "reyes/sl.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

using sl::Float;
using sl::Triple;
using D3 = std::array<double, 3>;

/// What a shadeop is tried on at one point: three numbers and two triples.
struct In {
  double a, b, c;
  D3 p, q;
};
struct Values {
  Float a, b, c;
  Triple p, q;
};
struct Case {
  const char* name;
  std::function<Triple(const Values&)> run;
  std::function<D3(const In&)> truth;
};

D3 all(double x) { return {x, x, x}; }
D3 each(const In& in, double (*f)(double, double)) {
  return {f(in.p[0], in.q[0]), f(in.p[1], in.q[1]), f(in.p[2], in.q[2])};
}
double dot(const D3& a, const D3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
D3 add(const D3& a, const D3& b, double s = 1) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }
D3 times(const D3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
D3 unit(const D3& a) { return times(a, 1 / std::sqrt(dot(a, a))); }
D3 cross(const D3& a, const D3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
rsl::Vec3 vec(const D3& a) { return {float(a[0]), float(a[1]), float(a[2])}; }
D3 of(const rsl::Vec3& v) { return {double{v.x}, double{v.y}, double{v.z}}; }
/// de Casteljau.
double bezier(double t, const std::array<double, 4>& k) {
  std::vector<double> v(k.begin(), k.end());
  for (size_t n = 3; n > 0; --n)
    for (size_t i = 0; i < n; ++i) v[i] += t * (v[i + 1] - v[i]);
  return v[0];
}
/// A Catmull-Rom segment is the cubic with these ends and half the chords around them as slopes.
double catmullRom(double t, const std::array<double, 4>& k) {
  const double m0 = (k[2] - k[0]) / 2, m1 = (k[3] - k[1]) / 2;
  return bezier(t, {k[1], k[1] + m0 / 3, k[2] - m1 / 3, k[2]});
}
/// Quaternions: v' = q v q*.
D3 turned(const D3& v, double angle, const D3& axis) {
  const D3 u = times(unit(axis), std::sin(angle / 2));
  const double w = std::cos(angle / 2);
  const D3 t = times(cross(u, v), 2);
  return add(add(v, t, w), cross(u, t));
}
/// Reflected share by the amplitudes of both polarisations, from the angles of Snell's law.
double reflectance(double cosine, double eta) {
  const double i = std::acos(cosine), s = eta * std::sin(i);
  if (s >= 1) return 1;
  const double t = std::asin(s), rs = std::sin(i - t) / std::sin(i + t), rp = std::tan(i - t) / std::tan(i + t);
  return (rs * rs + rp * rp) / 2;
}

const D3 kAway{0.3, -0.8, 0.5};
D3 arriving(const In& in) { return unit(add(in.p, {0, 0, 3})); }
Triple arriving(const Values& v) { return sl::normalize(v.p + Triple(0, 0, 3)); }

rsl::FloatArrayParam knots("knots", {0, 0.2f, 0.9f, 1, 0.5f}, "");

/// The list, in the order of the table.
const std::vector<Case>& cases() {
  using namespace sl;
  static const std::vector<Case> list = {
#define ONE(name, truth)                                                                                                 \
  {                                                                                                                      \
#name, [](const Values& v) { return Triple(name(v.a)); }, [](const In& in) { const double x = in.a; return all(truth); } \
  }
#define TWO(name, truth)                                                                                                                \
  {                                                                                                                                     \
#name, [](const Values& v) { return Triple(name(v.a, v.b)); }, [](const In& in) { const double x = in.a, y = in.b; return all(truth); } \
  }
      ONE(radians, x * M_PI / 180),
      ONE(degrees, x * 180 / M_PI),
      ONE(sin, std::imag(std::polar(1.0, x))),
      ONE(cos, std::real(std::polar(1.0, x))),
      ONE(tan, std::sin(x) / std::cos(x)),
      ONE(asin, std::atan2(x, std::sqrt(1 - x * x))),
      ONE(acos, std::atan2(std::sqrt(1 - x * x), x)),
      ONE(atan, std::arg(std::complex<double>(1, x))),
      TWO(atan, std::arg(std::complex<double>(y, x))),
      TWO(pow, std::exp(y * std::log(x))),
      ONE(exp, std::pow(M_E, x)),
      ONE(sqrt, std::pow(x, 0.5)),
      ONE(inversesqrt, std::pow(x, -0.5)),
      ONE(log, std::log2(x) / std::log2(M_E)),
      TWO(log, std::log2(x) / std::log2(y)),
      ONE(abs, x < 0 ? -x : x),
      ONE(sign, double((x > 0) - (x < 0))),
      ONE(floor, double(std::lround(x - 0.5))),
      ONE(ceil, -std::floor(-x)),
      ONE(round, std::floor(x + 0.5)),
      TWO(min, x < y ? x : y),
      TWO(max, x < y ? y : x),
      TWO(step, y < x ? 0 : 1),
      ONE(erf, 1 - std::erfc(x)),
      ONE(erfc, 1 - std::erf(x)),
#undef ONE
#undef TWO
      {"mod", [](const Values& v) { return Triple(mod(8 * v.a, v.b)); },
       [](const In& in) {
         double m = std::fmod(8 * in.a, in.b);
         return all(m < 0 ? m + in.b : m);
       }},
      {"min of three", [](const Values& v) { return Triple(min(v.a, v.b, v.c)); },
       [](const In& in) {
         return all(std::min({in.a, in.b, in.c}));
       }},
      {"max of four", [](const Values& v) { return Triple(max(v.a, v.b, v.c, Float(0.4))); },
       [](const In& in) {
         return all(std::max({in.a, in.b, in.c, 0.4}));
       }},
      {"min of triples", [](const Values& v) { return min(v.p, v.q); },
       [](const In& in) { return each(in, [](double x, double y) { return x < y ? x : y; }); }},
      {"max of triples", [](const Values& v) { return max(v.p, v.q); },
       [](const In& in) { return each(in, [](double x, double y) { return x < y ? y : x; }); }},
      {"clamp", [](const Values& v) { return Triple(clamp(v.a, 0.3, v.b)); },
       [](const In& in) {
         return all(in.a < 0.3 ? 0.3 : in.a > in.b ? in.b : in.a);
       }},
      {"clamp of triples", [](const Values& v) { return clamp(v.p, Triple(0.1), Triple(0.6)); },
       [](const In& in) {
         D3 r = in.p;
         for (double& x : r) x = std::clamp(x, 0.1, 0.6);
         return r;
       }},
      {"mix", [](const Values& v) { return Triple(mix(v.a, v.b, v.c)); },
       [](const In& in) { return all((1 - in.c) * in.a + in.c * in.b); }},
      {"mix of triples", [](const Values& v) { return mix(v.p, v.q, v.c); },
       [](const In& in) { return add(times(in.p, 1 - in.c), in.q, in.c); }},
      {"mix by a colour", [](const Values& v) { return mix(v.p, v.q, v.q); },
       [](const In& in) { return each(in, [](double x, double y) { return (1 - y) * x + y * y; }); }},
      {"smoothstep", [](const Values& v) { return Triple(smoothstep(0.2, 0.7, v.a)); },
       [](const In& in) {
         return all(bezier(std::clamp((in.a - 0.2) / 0.5, 0.0, 1.0), {0, 0, 1, 1}));
       }},
      {"filterstep", [](const Values& v) { return Triple(filterstep(0.5, v.a, 0.3)); },
       [](const In& in) { return all(std::clamp((in.a + 0.15 - 0.5) / 0.3, 0.0, 1.0)); }},
      {"filterstep between", [](const Values& v) { return Triple(filterstepBetween(v.c, v.a, v.a + 0.4)); },
       [](const In& in) { return all(std::clamp((in.a + 0.4 - in.c) / 0.4, 0.0, 1.0)); }},
      {"spline",
       [](const Values& v) {
         return Triple(spline(v.a, {0.1f, 0.4f, 0.9f, 0.2f}));
       },
       [](const In& in) {
         return all(catmullRom(in.a, {0.1, 0.4, 0.9, 0.2}));
       }},
      {"spline of colours",
       [](const Values& v) {
         return spline(v.a, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
       },
       [](const In& in) {
         return D3{catmullRom(in.a, {0, 1, 0, 0}), catmullRom(in.a, {0, 0, 1, 0}), catmullRom(in.a, {0, 0, 0, 1})};
       }},
      {"spline of a basis",
       [](const Values& v) {
         return Triple(spline(rsl::Basis::Bezier, v.a, {0.1f, 0.4f, 0.9f, 0.2f}));
       },
       [](const In& in) {
         return all(bezier(in.a, {0.1, 0.4, 0.9, 0.2}));
       }},
      {"spline through values",
       [](const Values& v) {
         return Triple(spline(rsl::Basis::Bezier, v.c, std::vector<Float>{v.a, v.b, v.a, v.b}));
       },
       [](const In& in) {
         return all(bezier(in.c, {in.a, in.b, in.a, in.b}));
       }},
      {"spline through an array", [](const Values& v) { return Triple(spline(rsl::Basis::CatmullRom, v.a, knots)); },
       [](const In& in) {
         const double x = 2 * in.a;
         return all(x < 1 ? catmullRom(x, {0, 0.2, 0.9, 1}) : catmullRom(x - 1, {0.2, 0.9, 1, 0.5}));
       }},
      {"solvespline",
       [](const Values& v) {
         return Triple(solveSpline(rsl::Basis::Linear, v.a, {-1, 0, 2, 3}));
       },
       [](const In& in) { return all(in.a / 2); }},

      {"noise of 1", [](const Values& v) { return Triple(noise(5 * v.a)); },
       [](const In& in) { return all(double{rsl::noise(5 * float(in.a))}); }},
      {"noise of 2", [](const Values& v) { return Triple(noise(5 * v.a, 5 * v.b)); },
       [](const In& in) { return all(double{rsl::noise(5 * float(in.a), 5 * float(in.b))}); }},
      {"noise of 3", [](const Values& v) { return Triple(noise(v.p)); },
       [](const In& in) { return all(double{rsl::noise(vec(in.p))}); }},
      {"noise of 4", [](const Values& v) { return Triple(noise(v.p, v.a)); },
       [](const In& in) { return all(double{rsl::noise(vec(in.p), float(in.a))}); }},
      {"colour noise of 1", [](const Values& v) { return noise3(v.a); },
       [](const In& in) { return of(rsl::noise3(float(in.a))); }},
      {"colour noise of 2", [](const Values& v) { return noise3(v.a, v.b); },
       [](const In& in) { return of(rsl::noise3(float(in.a), float(in.b))); }},
      {"colour noise of 3", [](const Values& v) { return noise3(v.p); },
       [](const In& in) { return of(rsl::noise3(vec(in.p))); }},
      {"colour noise of 4", [](const Values& v) { return noise3(v.p, v.a); },
       [](const In& in) { return of(rsl::noise3(vec(in.p), float(in.a))); }},
      {"pnoise of 1", [](const Values& v) { return Triple(pnoise(v.a + 3, 3)); },
       [](const In& in) { return all(double{rsl::pnoise(float(in.a), 3)}); }},
      {"pnoise of 2", [](const Values& v) { return Triple(pnoise(v.a + 3, v.b, 3, 4)); },
       [](const In& in) { return all(double{rsl::pnoise(float(in.a), float(in.b), 3, 4)}); }},
      {"pnoise of 3", [](const Values& v) { return Triple(pnoise(v.p, Triple(3))); },
       [](const In& in) {
         return all(double{rsl::pnoise(vec(in.p), {3, 3, 3})});
       }},
      {"pnoise of 4", [](const Values& v) { return Triple(pnoise(v.p, v.a, Triple(3), 2)); },
       [](const In& in) {
         return all(double{rsl::pnoise(vec(in.p), float(in.a), {3, 3, 3}, 2)});
       }},
      {"colour pnoise", [](const Values& v) { return pnoise3(v.p, Triple(3)); },
       [](const In& in) {
         return of(rsl::pnoise3(vec(in.p), {3, 3, 3}));
       }},
      {"cellnoise of 1", [](const Values& v) { return Triple(cellnoise(9 * v.a)); },
       [](const In& in) { return all(double{rsl::cellnoise(std::floor(9 * float(in.a)))}); }},
      {"cellnoise of 2", [](const Values& v) { return Triple(cellnoise(9 * v.a, v.b)); },
       [](const In& in) { return all(double{rsl::cellnoise(std::floor(9 * float(in.a)), 0)}); }},
      {"cellnoise of 3", [](const Values& v) { return Triple(cellnoise(v.p)); },
       [](const In& in) {
         return all(double{rsl::cellnoise(
             rsl::Vec3{std::floor(float(in.p[0])), std::floor(float(in.p[1])), std::floor(float(in.p[2]))})});
       }},
      {"cellnoise of 4", [](const Values& v) { return Triple(cellnoise(v.p, v.a + 2)); },
       [](const In& in) { return all(double{rsl::cellnoise(vec(in.p), 2)}); }},
      {"colour cellnoise", [](const Values& v) { return cellnoise3(v.p); },
       [](const In& in) { return of(rsl::cellnoise3(vec(in.p))); }},
      {"colour cellnoise of 4", [](const Values& v) { return cellnoise3(v.p, 5.5); },
       [](const In& in) { return of(rsl::cellnoise3(vec(in.p), 5)); }},

      {"wnoise", [](const Values& v) { return Triple(wnoise(v.p)); },
       [](const In& in) { return all(double{rsl::wnoise(vec(in.p))}); }},
      {"wnoise over a width", [](const Values& v) { return Triple(wnoise(v.p, v.a)); },
       [](const In& in) { return all(double{rsl::wnoise(vec(in.p), float(in.a))}); }},
      {"components", [](const Values& v) { return Triple(xcomp(v.p), ycomp(v.q), comp(v.p, 2)); },
       [](const In& in) {
         return D3{in.p[0], in.q[1], in.p[2]};
       }},
      {"zcomp", [](const Values& v) { return Triple(zcomp(v.q)); }, [](const In& in) { return all(in.q[2]); }},
      {"setcomp",
       [](const Values& v) {
         Triple t = v.p;
         setxcomp(t, v.a);
         setycomp(t, v.b);
         setzcomp(t, v.c);
         return t;
       },
       [](const In& in) {
         return D3{in.a, in.b, in.c};
       }},
      {"setcomp by number",
       [](const Values& v) {
         Triple t = v.p;
         setcomp(t, 1, v.a);
         return t;
       },
       [](const In& in) {
         return D3{in.p[0], in.a, in.p[2]};
       }},
      {"dot", [](const Values& v) { return Triple(dot(v.p, v.q)); }, [](const In& in) { return all(dot(in.p, in.q)); }},
      {"cross", [](const Values& v) { return cross(v.p, v.q); }, [](const In& in) { return cross(in.p, in.q); }},
      {"length", [](const Values& v) { return Triple(length(v.p)); },
       [](const In& in) { return all(std::hypot(in.p[0], in.p[1], in.p[2])); }},
      {"distance", [](const Values& v) { return Triple(distance(v.p, v.q)); },
       [](const In& in) { return all(std::hypot(in.p[0] - in.q[0], in.p[1] - in.q[1], in.p[2] - in.q[2])); }},
      {"normalize", [](const Values& v) { return normalize(v.p); }, [](const In& in) { return unit(in.p); }},
      {"ptlined", [](const Values& v) { return Triple(ptlined(v.p, v.q, Triple(1, 2, 3))); },
       [](const In& in) {
         const D3 d = add(in.q, in.p, -1), w = add({1, 2, 3}, in.p, -1);
         const double t = std::clamp(dot(w, d) / dot(d, d), 0.0, 1.0);
         const D3 r = add(w, d, -t);
         return all(std::sqrt(dot(r, r)));
       }},
      {"rotate", [](const Values& v) { return rotate(v.p, v.a, v.q, v.q + Triple(0.3f, -0.8f, 0.5f)); },
       [](const In& in) { return add(in.q, turned(add(in.p, in.q, -1), in.a, kAway)); }},
      {"faceforward", [](const Values& v) { return faceforward(v.p, v.q - 0.5 * Triple(1.0), v.p); },
       [](const In& in) { return times(in.p, dot(add(in.q, all(-0.5)), in.p) > 0 ? -1 : 1); }},
      {"reflect", [](const Values& v) { return reflect(v.p, normalize(v.q)); },
       [](const In& in) {
         const D3 n = unit(in.q);
         return add(in.p, n, -2 * dot(in.p, n));
       }},
      {"refract", [](const Values& v) { return refract(arriving(v), Triple(0, 0, -1), 0.7); },
       [](const In& in) {
         const D3 i = arriving(in);
         const double x = 0.7 * i[0], y = 0.7 * i[1];
         return D3{x, y, std::sqrt(1 - x * x - y * y)};
       }},
      {"total reflection",
       [](const Values& v) { return refract(normalize(v.p + Triple(3, 0, 0)), Triple(0, 0, -1), 1.9); },
       [](const In&) { return all(0); }},
      {"fresnel",
       [](const Values& v) {
         Float Kr, Kt;
         fresnel(arriving(v), Triple(0, 0, -1), 0.7, Kr, Kt);
         return Triple(Kr, Kt, 0);
       },
       [](const In& in) {
         const double k = reflectance(arriving(in)[2], 0.7);
         return D3{k, 1 - k, 0};
       }},
      {"fresnel with directions",
       [](const Values& v) {
         Float Kr, Kt;
         Triple R, T;
         fresnel(arriving(v), Triple(0, 0, -1), 0.7, Kr, Kt, R, T);
         return Triple(zcomp(R), xcomp(T), Kr);
       },
       [](const In& in) {
         const D3 i = arriving(in);
         return D3{-i[2], 0.7 * i[0], reflectance(i[2], 0.7)};
       }},

      {"ctransform", [](const Values& v) { return ctransform("hsv", "rgb", Triple(v.a, 1, 1)); },
       [](const In& in) {
         const auto ramp = [&](double at) {
           double d = std::fabs(in.a - at);
           d = std::min(d, 1 - d);
           return std::clamp(2 - 6 * d, 0.0, 1.0);
         };
         return D3{ramp(0), ramp(1 / 3.0), ramp(2 / 3.0)};
       }},
      {"ctransform from rgb", [](const Values& v) { return ctransform("YIQ", Triple(v.a)); },
       [](const In& in) {
         return D3{in.a, 0, 0};
       }},
      {"matrices move points", [](const Values& v) { return transform(translate(Matrix(), v.q), v.p); },
       [](const In& in) { return add(in.p, in.q); }},
      {"matrices leave vectors", [](const Values& v) { return vtransform(translate(Matrix(), v.q), v.p); },
       [](const In& in) { return in.p; }},
      {"matrices scale normals inversely",
       [](const Values& v) { return ntransform(scale(Matrix(), Triple(2, v.b, 1)), v.p); },
       [](const In& in) {
         return D3{in.p[0] / 2, in.p[1] / in.b, in.p[2]};
       }},
      {"matrices turn",
       [](const Values& v) { return transform(rotate(Matrix(), v.a, Triple(0.3f, -0.8f, 0.5f)), v.p); },
       [](const In& in) { return turned(in.p, in.a, kAway); }},
      {"matrices multiply",
       [](const Values& v) { return transform(scale(Matrix(), Triple(2)) * translate(Matrix(), v.q), v.p); },
       [](const In& in) { return add(times(in.p, 2), in.q); }},
      {"determinant",
       [](const Values& v) { return Triple(determinant(scale(rotate(Matrix(), v.c, v.p), Triple(v.a, v.b, 3)))); },
       [](const In& in) { return all(3 * in.a * in.b); }},
      {"inverse",
       [](const Values& v) {
         const Matrix m = scale(translate(Matrix(), v.q), Triple(v.b));
         return transform(inverse(m) * m, v.p);
       },
       [](const In& in) { return in.p; }},
  };
  return list;
}

// --- The shader that tries one of them

const Case* trying = nullptr;
bool uniform = false;
constexpr float kAlone = -7;

/// Numbers that the logarithm, the arcsine and all others are defined for.
In inputs(double u, double v) {
  return {0.05 + 0.9 * u,
          0.3 + 0.6 * v,
          0.1 + 0.3 * u + 0.4 * v,
          {0.2 + u, 0.9 - v, 0.4 + 0.5 * u * v},
          {0.7 - 0.6 * u, 0.15 + v, 0.3 + 0.2 * v}};
}

struct trial : sl::Surface {
  void main() {
    const Float x = uniform ? Float(0.375) : u, y = uniform ? Float(0.25) : v;
    const Values values{0.05 + 0.9 * x, 0.3 + 0.6 * y, 0.1 + 0.3 * x + 0.4 * y,
                        Triple(0.2 + x, 0.9 - y, 0.4 + 0.5 * x * y), Triple(0.7 - 0.6 * x, 0.15 + y, 0.3 + 0.2 * y)};
    Ci = Triple(double{kAlone});
    Oi = Triple(1.0);
    sl::If(v > 0.35, [&] { Ci = trying->run(values); });
  }
};
const rsl::Shader trialShader(TM_SURFACE, "trial", "", TM_TRACES, sl::shade<trial>, {&knots});

class BatchShadeops : public Stage {
 protected:
  BatchShadeops() {
    static const TmShader* const shaders[] = {trialShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    surface("trial");
  }
};

TEST_F(BatchShadeops, AreWhatTheyAreByOtherMeansAtThePointsOfTheMaskAndNoOthers) {
  ShadePoints grid = points(std::vector<vec3>(40, vec3(0, 0, 5)));
  for (int i = 0; i < grid.count(); ++i) {
    grid.channel(kU)[i] = static_cast<float>(i % 8) / 8 + 0.01f;
    grid.channel(kV)[i] = static_cast<float>(i / 8) / 5 + 0.02f;
  }
  for (const Case& c : cases())
    for (const bool same : {false, true}) {
      trying = &c;
      uniform = same;
      const ShadedPoints out = shade(grid);
      for (int i = 0; i < grid.count(); ++i) {
        const double u = static_cast<double>(grid.channel(kU)[i]), v = static_cast<double>(grid.channel(kV)[i]);
        if (v <= 0.35) {
          EXPECT_EQ(out.color(i), vec3(kAlone)) << c.name << " changed a point outside of its mask";
          continue;
        }
        const D3 truth = c.truth(same ? inputs(0.375, 0.25) : inputs(u, v));
        for (int k = 0; k < 3; ++k)
          ASSERT_NEAR(out.color(i)[k], truth[static_cast<size_t>(k)],
                      2e-5 * (1 + std::fabs(truth[static_cast<size_t>(k)])))
              << c.name << (same ? ", uniform" : ", varying") << " at " << u << ", " << v << " component " << k;
      }
    }
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchShadeops, WaveletNoiseFadesToItsMeanBeyondItsBand) {
  double sum = 0, squares = 0;
  constexpr int kMany = 20000;
  for (int k = 0; k < kMany; ++k) {
    const rsl::Vec3 p{0.61803f * static_cast<float>(k), 0.75487f * static_cast<float>(k),
                      0.56984f * static_cast<float>(k)};
    const float w = rsl::wnoise(p);
    ASSERT_TRUE(w >= 0 && w <= 1);
    ASSERT_EQ(rsl::wnoise(p, 1), 0.5f);
    if (w > 0 && w < 1) {
      ASSERT_NEAR(rsl::wnoise(p, 0.75f) - 0.5f, 0.5f * (w - 0.5f), 1e-6f);
    }
    sum += w;
    squares += (w - 0.5) * (w - 0.5);
  }
  EXPECT_NEAR(sum / kMany, 0.5, 0.01);
  EXPECT_NEAR(std::sqrt(squares / kMany), 1.0 / 6, 0.01);
}

// Its defining property: the noise has nothing that quadratic B-splines of twice the spacing could hold, so that its
// integral with any is 0.
TEST(WaveletNoise, IsOrthogonalToEveryCoarserGrid) {
  const auto spline = [](double x) {
    const double a = std::fabs(x);
    return a < 0.5 ? 0.75 - a * a : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0.0;
  };
  constexpr int kSteps = 24;
  double worst = 0, mean = 0;
  for (int place = 0; place < 20; ++place) {
    double held = 0, both = 0;
    for (int k = 0; k < kSteps * kSteps * kSteps; ++k) {
      const double x[3] = {(k % kSteps + 0.5) / 4 - 3, (k / kSteps % kSteps + 0.5) / 4 - 3,
                           (k / kSteps / kSteps + 0.5) / 4 - 3};  // the spline's 6 units
      const double weight = spline(x[0] / 2) * spline(x[1] / 2) * spline(x[2] / 2);
      const rsl::Vec3 p{float(x[0] + 2 * place - 0.5), float(x[1] - 4 * place - 0.5),
                        float(x[2] + 5.5)};  // coarse ones stand halfway between fine ones
      const double noise = rsl::WaveletTile::get()(p);
      held += weight * noise / 64;
      both += weight * std::fabs(noise) / 64;
    }
    worst = std::max(worst, std::fabs(held));
    mean += both / 20;
  }
  EXPECT_LT(worst, 0.02 * mean);
}

TEST(Text, IsJoinedWrittenAndMatched) {
  const std::string name = "wood";
  EXPECT_EQ(rsl::concat("a_", name, "_", std::string("b")), "a_wood_b");
  EXPECT_EQ(rsl::format("%s at %f%% of %p, %d", name, 0.5f, rsl::Vec3{1, 2, 3}, 7),
            "wood at 0.500000% of 1.000000 2.000000 3.000000, 7");
  EXPECT_EQ(rsl::format("%s %f %d %04d", 3, 4, 16777217, 5), "3 4 16777217 0005");  // whole numbers stay whole
  EXPECT_EQ(rsl::format("%c, %f left", rsl::Color{1, 0, 0}), "1.000000 0.000000 0.000000, %f left");
  EXPECT_EQ(rsl::format("%m", rsl::Matrix()).size(), 16 * 8 + 15u);
  EXPECT_TRUE(rsl::match("^w[aeiou]+d$", name));
  EXPECT_TRUE(rsl::match("o+", name));
  EXPECT_FALSE(rsl::match("^o", name));
  EXPECT_FALSE(rsl::match("(", name));
}

}  // namespace
}  // namespace tomales
