// The C++ face of shader_api.h, and all that a shader needs to include: typed parameters, a batch that loops
// over its active points, small vector maths and noise. Header only, C++17, no dependencies: plugins build
// against the installed headers alone. docs/shader_writing.md is the tutorial.
//   a shader is   parameters at namespace scope, one function, one rsl::Shader that names them
//   a plugin is   TM_SHADER_LIBRARY(shader, ...) once
// Space and colour: as shader_api.h says. Threads: parameters and shaders are constant once the library is
// loaded.
#pragma once
#include <memory>
#include <new>

#include "reyes/shader/noise.h"
#include "reyes/shader/params.h"

namespace rsl {

// --- A batch of points

inline TmConstVec3 view(TmVec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 get(TmConstVec3 a, int i) { return {a.x[i], a.y[i], a.z[i]}; }
inline Vec3 get(TmVec3 a, int i) { return get(view(a), i); }
inline void set(TmVec3 a, int i, Vec3 v) {
  a.x[i] = v.x;
  a.y[i] = v.y;
  a.z[i] = v.z;
}

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

enum class RayType { Camera, Diffuse, Specular, Transmission };  ///< rayInfo("type")

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
    Iterator& operator++() {
      ++i;
      return skip();
    }
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
  /// Returns what RSL's faceforward(normalize(N), I) returns.
  Vec3 facingNormal(int i) const { return faceforward(normalize(N(i)), I(i), Ng(i)); }
  Vec3Array facingNormals() const {
    return forAll([this](int i) { return facingNormal(i); });
  }
  /// Returns unit vectors to the viewer.
  Vec3Array towardsViewer() const {
    return forAll([this](int i) { return -normalize(I(i)); });
  }

  Vec3Array ambient() const {
    return filled([&](TmVec3 out) { g->call->ambient(g->host, g, out); });
  }
  Vec3Array diffuse(TmConstVec3 N) const { return diffuse(TM_ALL_LIGHT, N); }
  /// Returns the part of diffuse(N) that TM_DIRECT_LIGHT or TM_INDIRECT_LIGHT brings; lights are evaluated once for
  /// all.
  Vec3Array diffuse(TmLightChoice which, TmConstVec3 N) const {
    return filled([&](TmVec3 out) { g->call->diffuse(g->host, g, which, N, out); });
  }
  /// Gets the next sample of a light: `for (TmIlluminance light = tmIlluminanceDefaults(); b.illuminance(light);)`.
  bool illuminance(TmIlluminance& light) const { return g->call->illuminance(g->host, g, &light) != 0; }
  Vec3Array specular(TmConstVec3 N, TmConstVec3 V, const FloatParam& roughness) const {
    Array r(g);
    for (int i : *this) r[i] = roughness(g, i);
    return filled([&](TmVec3 out) { g->call->specular(g->host, g, N, V, r.data(), out); });
  }
  /// Looks up three channels of a texture at s, t. Returns false if it is missing: that is reported, and `out` is a
  /// loud substitute.
  bool texture(const char* name, Vec3Array& out, const TmTextureOptions& options = tmTextureDefaults()) const {
    return g->call->texture(g->host, g, name, &options, g->s, g->t, out) != 0;
  }
  /// Looks up the radiance of a latitude-longitude picture of the surroundings, in world space. Returns as texture().
  bool environment(const char* name, TmConstVec3 direction, Vec3Array& out,
                   const TmTextureOptions& options = tmTextureDefaults()) const {
    return g->call->environment(g->host, g, name, &options, direction, out) != 0;
  }
  /// Returns the colour along rays from P; see TmServices::trace.
  Vec3Array trace(TmConstVec3 direction, const TmRayOptions& options = tmRayDefaults()) const {
    return filled([&](TmVec3 out) { g->call->trace(g->host, g, &options, view(g->P), direction, out, nullptr); });
  }
  /// Returns how far rays from P go, 1e30 where they meet nothing.
  Array traceDistance(TmConstVec3 direction, const TmRayOptions& options = tmRayDefaults()) const {
    Array out(g);
    g->call->trace(g->host, g, &options, view(g->P), direction, TmVec3{}, out.data());
    return out;
  }
  /// Returns the share of light that passes from P to P + toward.
  Vec3Array transmission(TmConstVec3 toward, const TmRayOptions& options = tmRayDefaults()) const {
    return filled([&](TmVec3 out) { g->call->transmission(g->host, g, &options, view(g->P), toward, out); });
  }
  /// Returns the share of the hemisphere (or cone) around N that is covered.
  Array occlusion(TmConstVec3 N, const TmRayOptions& rays, TmOcclusion options = tmOcclusionDefaults()) const {
    Array out(g);
    options.covered = out.data();
    g->call->occlusion(g->host, g, &rays, view(g->P), N, &options);
    return out;
  }
  /// Returns the mean radiance that arrives from the hemisphere (or cone) around N: every point traces its own rays.
  Vec3Array incoming(TmConstVec3 N, const TmRayOptions& rays, TmOcclusion options = tmOcclusionDefaults()) const {
    Vec3Array out(g);
    options.radiance = out;
    g->call->occlusion(g->host, g, &rays, view(g->P), N, &options);
    return out;
  }
  /// Traces ray number `ray` of options.samples around an axis. Returns false when there are no more rays.
  bool gather(TmConstVec3 axis, const TmRayOptions& options, int ray, std::vector<uint8_t>& hit,
              std::initializer_list<TmChannel> outputs) const {
    hit.assign(static_cast<size_t>(g->padded), 0);
    return g->call->gather(g->host, g, &options, view(g->P), axis, ray, hit.data(), outputs.begin(),
                           static_cast<int32_t>(outputs.size())) != 0;
  }
  /// Returns the number that rayInfo() has for the ray that came to these points; it is one number for all of them.
  int rayNumber(const char* name) const {
    Vec3Array value(g);
    g->call->rayInfo(g->host, g, name, value);
    for (int i : *this) return static_cast<int>(value[i].x);
    return 0;
  }
  RayType rayType() const { return static_cast<RayType>(rayNumber("type")); }
  bool isShadowRay() const { return rayType() == RayType::Transmission; }
  int rayDepth() const { return rayNumber("depth"); }
  bool wantsHighlights() const { return rayNumber("highlights") != 0; }

  /// Returns P in a named space, or in current space where the name is unknown.
  Vec3Array positionsIn(const char* space) const {
    return filled([&](TmVec3 out) { g->call->transform(g->host, g, TM_AS_POINT, "current", space, view(g->P), out); });
  }

  /// Sets a surface's result: its radiance, not yet multiplied by its opacity, and the opacity.
  void output(int i, Color color, Color opacity) const {
    set(g->Oi, i, opacity);
    set(g->Ci, i, opacity * color);
  }
  /// Sets a light's result: the vector from the point to the light, and the light that arrives.
  void illuminate(int i, Vec3 L, Color Cl) const {
    set(g->L, i, L);
    set(g->Cl, i, Cl);
  }
  /// Moves every point along its unit normal, then renews the normals, as most displacement shaders do.
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
  /// Works on inactive points as well, since a loop without branches can be vectorised.
  template <class Body>
  Vec3Array forAll(const Body& body) const {
    Vec3Array out(g);
    const TmVec3 to = out;
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (int i = 0; i < g->count; ++i) rsl::set(to, i, body(i));
    return out;
  }
  template <class Service>
  Vec3Array filled(const Service& service) const {
    Vec3Array out(g);
    service(static_cast<TmVec3>(out));
    return out;
  }
};

}  // namespace rsl

/// Exports rsl::Shader objects from a plugin.
#define TM_SHADER_LIBRARY(...)                                                                     \
  extern "C" __attribute__((visibility("default"))) const TmShaderLibrary* tomales_shaders(void) { \
    static const TmShader* const shaders[] = {__VA_ARGS__};                                        \
    static const TmShaderLibrary library = rsl::libraryOf(shaders, rsl::faultOfParameters());      \
    return &library;                                                                               \
  }
