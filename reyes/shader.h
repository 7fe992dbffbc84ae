// The C++ face of shader_api.h, and all that a shader needs to include: typed parameters, a batch that loops
// over its active points, small vector maths and noise. Header only, C++17, no dependencies: plugins build
// against the two installed headers alone. docs/shader_writing.md is the tutorial.
//   a shader is   parameters at namespace scope, one function, one rsl::Shader that names them
//   a plugin is   TM_SHADER_LIBRARY(shader, ...) once
// Space and colour: as shader_api.h says. Threads: parameters and shaders are constant once the library is
// loaded.
#pragma once
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "reyes/shader_api.h"

namespace rsl {

struct Vec3 {
  float x = 0, y = 0, z = 0;
};
using Color = Vec3;

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(float s, Vec3 a) { return a * s; }
inline Vec3 operator/(Vec3 a, float s) { return a * (1 / s); }
inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
/// Zero stays zero, as in RSL.
inline Vec3 normalize(Vec3 a) {
  const float l = length(a);
  return l > 0 ? a / l : Vec3{};
}
/// RISpec faceforward with Nref = Ng: N on the side of the surface that I arrives at.
inline Vec3 faceforward(Vec3 N, Vec3 I, Vec3 Ng) { return dot(I, Ng) > 0 ? -N : N; }
inline Vec3 reflect(Vec3 I, Vec3 N) { return I - 2 * dot(I, N) * N; }
/// I and N of unit length, N against I; eta: index of refraction before over behind. Total reflection: zero (RISpec 15.3).
inline Vec3 refract(Vec3 I, Vec3 N, float eta) {
  const float c = -dot(I, N), k = 1 - eta * eta * (1 - c * c);
  return k < 0 ? Vec3{} : eta * I + (eta * c - std::sqrt(k)) * N;
}
/// Share of unpolarised light that is reflected where refract() would refract.
inline float fresnel(Vec3 I, Vec3 N, float eta) {
  const float c = std::min(1.0f, std::abs(dot(I, N))), k = 1 - eta * eta * (1 - c * c);
  if (k <= 0) return 1;
  const float t = std::sqrt(k), s = (eta * c - t) / (eta * c + t), p = (c - eta * t) / (c + eta * t);
  return 0.5f * (s * s + p * p);
}

inline float clamp(float x, float lo, float hi) { return std::min(std::max(x, lo), hi); }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline Vec3 mix(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }
inline float smoothstep(float lo, float hi, float x) {
  if (hi <= lo) return x < lo ? 0.0f : 1.0f;
  const float t = clamp((x - lo) / (hi - lo), 0, 1);
  return t * t * (3 - 2 * t);
}

/// Before a function of plain loops without branches: built for SSE2, AVX2 and AVX-512 and picked by CPU, with the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define RSL_HOT __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define RSL_HOT
#endif
#ifdef __GNUC__
#define RSL_INLINE inline __attribute__((always_inline))  ///< Called in such loops: clones vectorise only what is part of them.
#else
#define RSL_INLINE inline
#endif

/// A 32-bit mix of a lattice point ("lowbias32", C. Wellons, once an axis).
RSL_INLINE uint32_t latticeHash(int32_t x, int32_t y, int32_t z) {
  const auto mixIn = [](uint32_t h, int32_t c) {
    h = (h ^ static_cast<uint32_t>(c)) * 0x9e3779b9U;
    h ^= h >> 16, h *= 0x7feb352dU, h ^= h >> 15, h *= 0x846ca68bU, h ^= h >> 16;
    return h;
  };
  return mixIn(mixIn(mixIn(0, x), y), z);
}

/// One of the twelve gradients to the edges of a cube (Perlin 2002, "Improving noise"), by p.
RSL_INLINE float gradient(uint32_t hash, Vec3 p) {
  const uint32_t h = hash & 15;
  const float a = h < 8 ? p.x : p.y, b = h < 4 ? p.y : (h & 13) == 12 ? p.x : p.z;
  return (h & 1 ? -a : a) + (h & 2 ? -b : b);
}

/// Gradient noise in [-1, 1]: zero on the integer lattice, twice differentiable, the same on every machine.
RSL_INLINE float signedNoise(Vec3 p) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, f = p - cell;
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  // Lattice coordinates wrap far out instead of overflowing the integer: fmod(c, 2^20), exactly, without a call.
  const auto lattice = [](float c) { return static_cast<int32_t>(c - std::trunc(c * 0x1p-20f) * 0x1p20f); };
  const int32_t x = lattice(cell.x), y = lattice(cell.y), z = lattice(cell.z);
  const auto corner = [&](int i, int j, int k) {
    const Vec3 offset{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
    return gradient(latticeHash(x + i, y + j, z + k), f - offset);
  };
  const float u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const auto face = [&](int k) {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  return clamp(mix(face(0), face(1), w), -1, 1);
}
/// RSL's noise(): the same in [0, 1].
inline float noise(Vec3 p) { return 0.5f + 0.5f * signedNoise(p); }

// --- Parameters
// ---------------------------------------------------------------------------------------------------

/// A declared parameter. Make one of the typed ones below at namespace scope and list it in one Shader of the
/// same file.
class Param {
 public:
  Param(const char* name, int32_t type, std::vector<float> floats, const char* string, const char* doc)
      : floats_(std::move(floats)), string_(string), decl_{name, type, 1, floats_.data(), &string_, doc} {}
  Param(const Param&) = delete;

 protected:
  const TmValue& value(const TmGrid* g) const { return g->params[index_]; }

 private:
  friend class Shader;
  std::vector<float> floats_;
  const char* string_;
  TmParamDecl decl_;
  int index_ = 0;
};

class FloatParam : public Param {
 public:
  FloatParam(const char* name, float value, const char* doc) : Param(name, TM_FLOAT, {value}, "", doc) {}
  float operator()(const TmGrid* g, int i) const {
    const TmValue& v = value(g);
    return v.c[0][i * v.step];
  }
};

template <TmType type>
class TripleParam : public Param {
 public:
  TripleParam(const char* name, Vec3 v, const char* doc) : Param(name, type, {v.x, v.y, v.z}, "", doc) {}
  Vec3 operator()(const TmGrid* g, int i) const {
    const TmValue& v = this->value(g);
    return {v.c[0][i * v.step], v.c[1][i * v.step], v.c[2][i * v.step]};
  }
};
using ColorParam = TripleParam<TM_COLOR>;
using PointParam = TripleParam<TM_POINT>;
using VectorParam = TripleParam<TM_VECTOR>;
using NormalParam = TripleParam<TM_NORMAL>;

class StringParam : public Param {
 public:
  StringParam(const char* name, const char* value, const char* doc)
      : Param(name, TM_STRING, {}, value, doc) {}
  const char* operator()(const TmGrid* g) const { return value(g).string; }
};

/// An output parameter: stored, and so worth computing, only where a Display asks for its name.
template <int32_t type, class T>
class Output : public Param {
 public:
  Output(const char* name, const char* doc) : Param(name, type | TM_OUTPUT, {0, 0, 0}, "", doc) {}
  bool wanted(const TmGrid* g) const { return value(g).step == 1; }
  /// Pre: wanted.
  void set(const TmGrid* g, int i, const T& v) const {
    const float* from = reinterpret_cast<const float*>(&v);
    for (size_t k = 0; k < sizeof(T) / sizeof(float); ++k) const_cast<float*>(value(g).c[k])[i] = from[k];
  }
};
using FloatOutput = Output<TM_FLOAT, float>;
using ColorOutput = Output<TM_COLOR, Color>;
using PointOutput = Output<TM_POINT, Vec3>;
using VectorOutput = Output<TM_VECTOR, Vec3>;
using NormalOutput = Output<TM_NORMAL, Vec3>;

/// A shader as the renderer sees it.
class Shader {
 public:
  Shader(TmKind kind, const char* name, const char* doc, uint32_t capabilities, void (*shade)(const TmGrid*),
         std::initializer_list<Param*> params)
      : decls_(declare(params)),
        shader_{TM_SHADER_ABI,
                sizeof(TmShader),
                name,
                kind,
                capabilities,
                decls_.data(),
                static_cast<int32_t>(decls_.size()),
                shade,
                doc} {}
  Shader(const Shader&) = delete;
  operator const TmShader*() const { return &shader_; }

 private:
  static std::vector<TmParamDecl> declare(std::initializer_list<Param*> params) {
    std::vector<TmParamDecl> decls;
    for (Param* p : params) {
      p->index_ = static_cast<int>(decls.size());
      decls.push_back(p->decl_);
    }
    return decls;
  }
  std::vector<TmParamDecl> decls_;
  TmShader shader_;
};

// --- A batch of points
// --------------------------------------------------------------------------------------------

inline TmConstVec3 view(TmVec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 get(TmConstVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline Vec3 get(TmVec3 a, int i) { return get(view(a), i); }
inline void set(TmVec3 a, int i, Vec3 v) { a.x[i] = v.x, a.y[i] = v.y, a.z[i] = v.z; }

/// Scratch for one value a point: zero at first, aligned and padded as shader_api.h asks.
class Array {
 public:
  explicit Array(const TmGrid* g, int components = 1) : stride_(g->padded) {
    const size_t n = static_cast<size_t>(g->padded) * static_cast<size_t>(components);
    data_.reset(static_cast<float*>(::operator new (n * sizeof(float), std::align_val_t{64})));
    std::fill_n(data_.get(), n, 0.0f);
  }
  float* data() { return data_.get(); }
  float& operator[](int i) { return data_.get()[i]; }
  float operator[](int i) const { return data_.get()[i]; }

 protected:
  struct Free {
    void operator()(float* p) const { ::operator delete (p, std::align_val_t{64}); }
  };
  int stride_;
  std::unique_ptr<float, Free> data_;
};

class Vec3Array : public Array {
 public:
  explicit Vec3Array(const TmGrid* g) : Array(g, 3) {}
  operator TmVec3() const { return {data_.get(), data_.get() + stride_, data_.get() + 2 * stride_}; }
  operator TmConstVec3() const { return view(TmVec3(*this)); }
  Vec3 operator[](int i) const { return get(TmConstVec3(*this), i); }
  void set(int i, Vec3 v) { rsl::set(TmVec3(*this), i, v); }
};

inline TmRayOptions defaultRays() { return TM_RAY_DEFAULTS; }

/// `for (int i : batch)` visits the active points. Services are one call for the whole batch: ask before the
/// loop.
class Batch {
 public:
  explicit Batch(const TmGrid* grid) : g(grid) {}

  struct Iterator {
    const TmGrid* g;
    int i;
    int operator*() const { return i; }
    bool operator!=(const Iterator& other) const { return i != other.i; }
    Iterator& operator++() { return ++i, skip(); }
    Iterator& skip() {
      while (i < g->count && !g->active[i]) ++i;
      return *this;
    }
  };
  Iterator begin() const { return Iterator{g, 0}.skip(); }
  Iterator end() const { return {g, g->count}; }

  Vec3 P(int i) const { return get(g->P, i); }
  Vec3 N(int i) const { return get(g->N, i); }
  Vec3 Ng(int i) const { return get(g->Ng, i); }
  Vec3 I(int i) const { return get(g->I, i); }
  Color Cs(int i) const { return get(g->Cs, i); }
  Color Os(int i) const { return get(g->Os, i); }
  /// RSL faceforward(normalize(N), I).
  Vec3 facingNormal(int i) const { return faceforward(normalize(N(i)), I(i), Ng(i)); }
  Vec3Array facingNormals() const {
    Vec3Array out(g);
    for (int i : *this) out.set(i, facingNormal(i));
    return out;
  }
  /// Unit vectors to the viewer.
  Vec3Array towardsViewer() const {
    Vec3Array out(g);
    for (int i : *this) out.set(i, -normalize(I(i)));
    return out;
  }

  Vec3Array ambient() const {
    return filled([&](TmVec3 out) { g->call->ambient(g->host, g, out); });
  }
  Vec3Array diffuse(TmConstVec3 N) const {
    return filled([&](TmVec3 out) { g->call->diffuse(g->host, g, N, out); });
  }
  /// The part of diffuse(N) that TM_DIRECT_LIGHT or TM_INDIRECT_LIGHT brings; lights are evaluated once for all.
  Vec3Array diffuseOf(TmLightChoice which, TmConstVec3 N) const {
    return filled([&](TmVec3 out) { g->call->diffuseOf(g->host, g, which, N, out); });
  }
  Vec3Array specular(TmConstVec3 N, TmConstVec3 V, const FloatParam& roughness) const {
    Array r(g);
    for (int i : *this) r[i] = roughness(g, i);
    return filled([&](TmVec3 out) { g->call->specular(g->host, g, N, V, r.data(), out); });
  }
  /// Three channels of a texture at the surface's s, t. False: missing, reported, `out` is loud.
  bool texture(const char* name, Vec3Array& out) const {
    return g->call->texture(g->host, g, name, 0, 3, g->s, g->t, out) != 0;
  }
  /// Radiance of a latitude-longitude picture of the surroundings, in world space. Return: as texture().
  bool environment(const char* name, TmConstVec3 direction, const float* width_radians, Vec3Array& out) const {
    return g->call->environment(g->host, g, name, direction, width_radians, out) != 0;
  }
  /// Colour along rays from P; see TmServices::trace.
  Vec3Array trace(TmConstVec3 direction, const TmRayOptions& options = defaultRays()) const {
    return filled([&](TmVec3 out) { g->call->trace(g->host, g, view(g->P), direction, &options, out, nullptr); });
  }
  /// How far rays from P go; 1e30 where they meet nothing.
  Array traceDistance(TmConstVec3 direction, const TmRayOptions& options = defaultRays()) const {
    Array out(g);
    g->call->trace(g->host, g, view(g->P), direction, &options, TmVec3{}, out.data());
    return out;
  }
  /// Light that passes from P to P + toward.
  Vec3Array transmission(TmConstVec3 toward, const TmRayOptions& options = defaultRays()) const {
    return filled([&](TmVec3 out) { g->call->transmissionWith(g->host, g, view(g->P), toward, &options, out); });
  }
  /// Share of the hemisphere (or cone) around N that is covered.
  Array occlusion(TmConstVec3 N, const TmRayOptions& options) const {
    Array out(g);
    g->call->occlusion(g->host, g, view(g->P), N, &options, out.data(), TmVec3{});
    return out;
  }
  /// Mean radiance that arrives from the hemisphere (or cone) around N: rays for every point, nothing interpolated.
  Vec3Array incoming(TmConstVec3 N, const TmRayOptions& options) const {
    Array covered(g);
    return filled([&](TmVec3 out) { g->call->occlusion(g->host, g, view(g->P), N, &options, covered.data(), out); });
  }
  /// Ray `ray` of options.samples around an axis; false when there are no more.
  bool gather(TmConstVec3 axis, const TmRayOptions& options, int ray, std::vector<uint8_t>& hit,
              std::initializer_list<TmRayOutput> outputs) const {
    hit.assign(static_cast<size_t>(g->padded), 0);
    return g->call->gather(g->host, g, view(g->P), axis, &options, ray, hit.data(), outputs.begin(),
                           static_cast<int32_t>(outputs.size())) != 0;
  }
  bool isShadowRay() const {
    Vec3Array type(g);
    g->call->rayInfo(g->host, g, "type", type);
    for (int i : *this) return type[i].x == 3;
    return false;
  }
  int rayDepth() const {
    Vec3Array depth(g);
    g->call->rayInfo(g->host, g, "depth", depth);
    for (int i : *this) return static_cast<int>(depth[i].x);
    return 0;
  }

  /// P in a named space (current space where the name is unknown).
  Vec3Array positionsIn(const char* space) const {
    return filled(
        [&](TmVec3 out) { g->call->transform(g->host, g, TM_AS_POINT, "current", space, view(g->P), out); });
  }

  /// A surface's result: radiance before opacity, and opacity.
  void output(int i, Color color, Color opacity) const {
    set(g->Oi, i, opacity);
    set(g->Ci, i, opacity * color);
  }
  /// A light's result: vector from the point to the light, and the light that arrives.
  void illuminate(int i, Vec3 L, Color Cl) const {
    set(g->L, i, L);
    set(g->Cl, i, Cl);
  }
  /// Moves every point along its unit normal, then renews the normals: what most displacement shaders do.
  void displace(const Array& amount) const {
    for (int i : *this) set(g->P, i, P(i) + amount[i] * normalize(N(i)));
    g->call->calculateNormal(g->host, g, view(g->P), g->N);
  }

  /// Turns the normals as displace() would, and leaves the points: a bump.
  void bump(const Array& amount) const {
    Vec3Array moved(g);
    for (int i : *this) moved.set(i, P(i) + amount[i] * normalize(N(i)));
    g->call->calculateNormal(g->host, g, moved, g->N);
  }

  const TmGrid* const g;

 private:
  template <class Service>
  Vec3Array filled(const Service& service) const {
    Vec3Array out(g);
    service(static_cast<TmVec3>(out));
    return out;
  }
};

}  // namespace rsl

/// Exports rsl::Shader objects from a plugin.
#define TM_SHADER_LIBRARY(...)                                                                       \
  extern "C" __attribute__((visibility("default"))) const TmShaderLibrary* tomales_shaders(void) {   \
    static const TmShader* const shaders[] = {__VA_ARGS__};                                          \
    static const TmShaderLibrary library = {TM_SHADER_ABI, sizeof(TmShaderLibrary), shaders,         \
                                            static_cast<int32_t>(sizeof shaders / sizeof *shaders)}; \
    return &library;                                                                                 \
  }
