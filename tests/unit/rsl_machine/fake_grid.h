// A batch of points, and a renderer that answers from what the test has laid out.
#pragma once
#include <functional>
#include <map>
#include <memory>

#include "reyes/base/simd.h"
#include "reyes/rsl/code.h"
#include "reyes/shader.h"

namespace tomales::compiler {

/// u runs from 0 to 1 over the points; the i-th point is at (i, 2 i, 3).
class FakeGrid {
 public:
  explicit FakeGrid(int count) : n(padded(count)) {
    grid.structBytes = sizeof grid, grid.count = count, grid.padded = n;
    grid.time = 0.25f, grid.dtime = 0.5f, grid.clip[0] = 1, grid.clip[1] = 100;
    grid.P = scattered(), grid.N = triples(), grid.Ci = triples(), grid.Oi = triples(), grid.L = triples(),
    grid.Cl = triples();
    const TmVec3 Ng = triples(), I = triples(), dPdu = triples(), dPdv = triples(), dPdtime = triples(), Cs = triples(),
                 Os = triples();
    grid.Ng = rsl::view(Ng), grid.I = rsl::view(I), grid.dPdu = rsl::view(dPdu), grid.dPdv = rsl::view(dPdv),
    grid.dPdtime = rsl::view(dPdtime), grid.Cs = rsl::view(Cs), grid.Os = rsl::view(Os);
    float *const u = array(), *const v = array(), *const s = array(), *const t = array(), *const du = array(),
                 *const dv = array();
    grid.u = u, grid.v = v, grid.s = s, grid.t = t, grid.du = du, grid.dv = dv;
    grid.alpha = array();
    for (int i = 0; i < n; ++i) {
      const auto x = static_cast<float>(i);
      u[i] = x / static_cast<float>(count), v[i] = 0.5f, s[i] = x, t[i] = -x, du[i] = 0.25f, dv[i] = 0.5f;
      rsl::set(grid.P, i, {x, 2 * x, 3}), rsl::set(grid.N, i, {0, 0, -1}), rsl::set(Ng, i, {0, 0, -2}),
          rsl::set(I, i, {0, 0, 1});
      rsl::set(Cs, i, {0.25f, 0.5f, 1}), rsl::set(Os, i, {1, 0.5f, 0.25f});
      rsl::set(grid.Ci, i, kBefore), rsl::set(grid.Oi, i, kBefore);
      grid.alpha[i] = 0.125f;
    }
    active.assign(static_cast<size_t>(n), 0);
    std::fill_n(active.begin(), count, uint8_t{1});
    grid.active = active.data();
    setServices();
    grid.call = &services, grid.host = this;
  }
  FakeGrid(const FakeGrid&) = delete;

  float* array(int components = 1) {
    arrays_.push_back(std::make_unique<AlignedVector<float>>(static_cast<size_t>(n * components), 0.0f));
    return arrays_.back()->data();
  }
  /// Components lie in one array, as a host's may.
  TmVec3 triples() {
    float* const x = array(3);
    return {x, x + n, x + 2 * n};
  }
  TmVec3 scattered() {
    float *const z = array(), *const y = array();
    return {array(), y, z};
  }

  /// Values for the parameters of a code: defaults; outputs get arrays.
  void bind(const Code& code) {
    params.clear();
    for (const Parameter& p : code.parameters) {
      TmValue v{};
      v.length = std::max(1, p.type.length);
      floats_.push_back(std::make_unique<std::vector<float>>(p.floats));
      const float* const at = floats_.back()->data();
      for (int k = 0; k < 3; ++k) v.c[k] = at + (p.floats.size() >= 3 ? k : 0);
      if (p.output) {
        for (auto& c : v.c) c = array();
        v.step = 1;
      }
      texts_.push_back(std::make_unique<std::string>());
      for (const std::string& t : p.texts) texts_.back()->append(t).push_back('\0');
      v.string = texts_.back()->c_str();
      params.push_back(v);
    }
    grid.params = params.data();
  }
  const float* output(size_t k, int component = 0) const { return params[k].c[component]; }

  static constexpr rsl::Vec3 kBefore{-7, -7, -7};
  struct FakeLight {
    std::function<bool(int i)> lit;
    rsl::Vec3 L, Cl;
    float dimmed = 0;
  };
  struct Answer {
    int32_t type = TM_FLOAT;
    std::vector<float> floats;
    std::string text;
  };

  const int n;
  TmGrid grid{};
  std::vector<uint8_t> active;
  std::vector<TmValue> params;
  TmServices services{};
  std::vector<FakeLight> lights;
  std::map<std::string, Answer> answers;  ///< By "whom:name", or of gather() by the name.
  std::vector<std::string> reports, printed;
  std::vector<std::vector<uint8_t>> masks;  ///< Of each call of illuminance, ambient, texture and gather.
  TmTextureOptions textureOptions{};
  TmRayOptions rayOptions{};
  TmOcclusion occlusionOptions{};
  std::string asked;  ///< Of the last file that was asked for.
  std::vector<std::string> channels;
  std::vector<std::pair<std::string, float>> sent;
  bool hasP = false;

 private:
  static FakeGrid& of(void* host) { return *static_cast<FakeGrid*>(host); }
  void seen(const TmGrid* g) { masks.emplace_back(g->active, g->active + g->padded); }
  template <class Body>
  static void each(const TmGrid* g, const Body& body) {
    for (int i = 0; i < g->count; ++i)
      if (g->active[i]) body(i);
  }
  void setServices();
  std::vector<std::unique_ptr<AlignedVector<float>>> arrays_;
  std::vector<std::unique_ptr<std::vector<float>>> floats_;
  std::vector<std::unique_ptr<std::string>> texts_;
};

inline void FakeGrid::setServices() {
  services.structBytes = sizeof services, services.abi = TM_SHADER_ABI;
  services.report = [](void* h, const TmGrid*, int32_t, const char* what) { of(h).reports.emplace_back(what); };
  services.print = [](void* h, const TmGrid*, const char* what) { of(h).printed.emplace_back(what); };
  services.ambient = [](void* h, const TmGrid* g, TmVec3 out) {
    of(h).seen(g);
    each(g, [&](int i) { rsl::set(out, i, {1, 2, static_cast<float>(i)}); });
  };
  services.diffuse = [](void*, const TmGrid* g, int32_t, TmConstVec3 N, TmVec3 out) {
    each(g, [&](int i) { rsl::set(out, i, 2 * rsl::get(N, i)); });
  };
  services.specular = [](void*, const TmGrid* g, TmConstVec3 N, TmConstVec3 V, const float* r, TmVec3 out) {
    each(g, [&](int i) { rsl::set(out, i, rsl::get(N, i) + r[i] * rsl::get(V, i)); });
  };
  services.illuminance = [](void* h, const TmGrid* g, TmIlluminance* q) -> int32_t {
    FakeGrid& me = of(h);
    me.seen(g);
    me.hasP = q->P.x != nullptr;
    if (q->next == 0)
      for (int k = 0; k < q->sentCount; ++k) me.sent.emplace_back(q->sent[k].name, q->sent[k].value.c[0][0]);
    if (q->next == static_cast<int32_t>(me.lights.size())) return 0;
    const FakeLight& light = me.lights[static_cast<size_t>(q->next)];
    const TmVec3 L = me.triples(), Cl = me.triples();
    uint8_t* const lit = reinterpret_cast<uint8_t*>(me.array());
    each(g, [&](int i) { rsl::set(L, i, light.L), rsl::set(Cl, i, light.Cl), lit[i] = light.lit(i); });
    q->L = q->direction = rsl::view(L), q->Cl = rsl::view(Cl), q->lit = lit, q->light = q->next++;
    return 1;
  };
  services.transform = [](void*, const TmGrid* g, int32_t kind, const char*, const char* to, TmConstVec3 in,
                          TmVec3 out) -> int32_t {
    const bool world = std::string_view(to) == "world";
    each(g, [&](int i) {
      rsl::set(
          out, i,
          world ? 2 * rsl::get(in, i) + (kind == TM_AS_POINT ? rsl::Vec3{1, 2, 3} : rsl::Vec3{}) : rsl::get(in, i));
    });
    return world;
  };
  services.derivative = [](void*, const TmGrid* g, int32_t direction, const float* x, float* out) {
    each(g, [&](int i) { out[i] = direction == 0 ? 4 * x[i] : 8 * x[i]; });
  };
  services.calculateNormal = [](void*, const TmGrid* g, TmConstVec3 P, TmVec3 out) {
    each(g, [&](int i) { rsl::set(out, i, -rsl::get(P, i)); });
  };
  services.stratified = [](void*, const TmGrid* g, int32_t, int32_t, float* x, float* y) {
    each(g, [&](int i) { x[i] = static_cast<float>(i % 16) / 16, y[i] = static_cast<float>(i / 16 % 16) / 16; });
  };
  services.texture = [](void* h, const TmGrid* g, const char* name, const TmTextureOptions* o, const float* s,
                        const float* t, TmVec3 out) -> int32_t {
    FakeGrid& me = of(h);
    me.seen(g);
    me.asked = name, me.textureOptions = *o;
    each(g, [&](int i) {
      out.x[i] = s[i];
      if (out.y) out.y[i] = t[i], out.z[i] = static_cast<float>(o->channel);
    });
    return 1;
  };
  services.environment = [](void* h, const TmGrid* g, const char* name, const TmTextureOptions* o, TmConstVec3 d,
                            TmVec3 out) -> int32_t {
    of(h).asked = name, of(h).textureOptions = *o;
    each(g, [&](int i) {
      out.x[i] = d.x[i];
      if (out.y) out.y[i] = d.y[i], out.z[i] = d.z[i];
    });
    return 1;
  };
  services.trace = [](void* h, const TmGrid* g, const TmRayOptions* o, TmConstVec3 P, TmConstVec3 d, TmVec3 color,
                      float* distance) {
    of(h).rayOptions = *o;
    each(g, [&](int i) {
      if (color.x) rsl::set(color, i, rsl::get(P, i) + rsl::get(d, i));
      if (distance) distance[i] = rsl::length(rsl::get(d, i));
    });
  };
  services.transmission = [](void* h, const TmGrid* g, const TmRayOptions* o, TmConstVec3, TmConstVec3 toward,
                             TmVec3 out) {
    of(h).rayOptions = *o;
    each(g, [&](int i) { rsl::set(out, i, rsl::get(toward, i)); });
  };
  services.occlusion = [](void* h, const TmGrid* g, const TmRayOptions* rays, TmConstVec3, TmConstVec3 N,
                          const TmOcclusion* o) -> int32_t {
    of(h).rayOptions = *rays, of(h).occlusionOptions = *o;
    each(g, [&](int i) {
      if (o->covered) o->covered[i] = 0.5f;
      if (o->radiance.x) rsl::set(o->radiance, i, rsl::get(N, i));
      if (o->environmentDirection.x) rsl::set(o->environmentDirection, i, {0, 1, 0});
    });
    return 1;
  };
  services.gather = [](void* h, const TmGrid* g, const TmRayOptions* o, TmConstVec3, TmConstVec3, int32_t ray,
                       uint8_t* hit, const TmChannel* outputs, int32_t count) -> int32_t {
    FakeGrid& me = of(h);
    me.seen(g);
    me.rayOptions = *o;
    if (ray == o->samples) return 0;
    each(g, [&](int i) {
      hit[i] = (i + ray) % 2 == 0;
      for (int k = 0; hit[i] && k < count; ++k) {
        if (outputs[k].value.y)
          rsl::set(outputs[k].value, i, {1, 2, 3});
        else
          outputs[k].value.x[i] = static_cast<float>(10 * ray + i);
      }
    });
    me.channels.clear();
    for (int k = 0; k < count; ++k) me.channels.emplace_back(outputs[k].name);
    return 1;
  };
  services.ask = [](void* h, const TmGrid*, int32_t whom, int32_t light, const char* name, int32_t* type,
                    TmValue* out) -> int32_t {
    FakeGrid& me = of(h);
    if (whom == TM_OF_LIGHT && light >= 0 && std::string_view(name) == "dimmed") {
      *type = TM_FLOAT, *out = {{&me.lights[static_cast<size_t>(light)].dimmed, nullptr, nullptr}, 0, 1, nullptr};
      return 1;
    }
    const auto it = me.answers.find(std::to_string(whom) + ":" + name);
    if (it == me.answers.end()) return 0;
    const Answer& a = it->second;
    *type = a.type;
    const bool three = a.type >= TM_COLOR && a.type <= TM_NORMAL;
    const size_t width = a.type == TM_MATRIX ? 16 : three ? 3 : 1;
    *out = {{a.floats.data(), three ? a.floats.data() + 1 : nullptr, three ? a.floats.data() + 2 : nullptr},
            0,
            static_cast<int32_t>(std::max<size_t>(1, a.floats.size() / width)),
            a.text.c_str()};
    return 1;
  };
  services.rayInfo = [](void*, const TmGrid* g, const char* name, TmVec3 out) -> int32_t {
    if (std::string_view(name) != "type" && std::string_view(name) != "origin") return 0;
    each(g, [&](int i) { rsl::set(out, i, {2, 5, 6}); });
    return 1;
  };
  services.rayLabel = [](void*, const TmGrid*) { return "mirror"; };
  services.textureInfo = [](void*, const TmGrid*, const char*, const char* what, int32_t* type,
                            TmValue* out) -> int32_t {
    static const float resolution[2] = {640, 480};
    if (std::string_view(what) != "resolution") return 0;
    *type = TM_FLOAT, *out = {{resolution, nullptr, nullptr}, 0, 2, nullptr};
    return 1;
  };
  services.shadow = [](void* h, const TmGrid* g, const char* name, const TmShadowOptions* o, TmConstVec3 P,
                       TmVec3 out) {
    of(h).asked = name;
    each(g, [&](int i) { rsl::set(out, i, {P.x[i], o->bias, o->blur}); });
  };
  services.bake3d = [](void* h, const TmGrid* g, const char* file, const TmCloudOptions* o, TmConstVec3, TmConstVec3,
                       const TmChannel* values, int32_t count) -> int32_t {
    FakeGrid& me = of(h);
    me.seen(g);
    me.asked = file, me.channels.clear();
    for (int k = 0; k < count; ++k)
      me.channels.emplace_back(std::string(values[k].name) + (values[k].value.y ? " 3 " : " 1 ") +
                               std::to_string(values[k].value.x[0]));
    if (o->radius) me.channels.emplace_back("radius " + std::to_string(o->radius[0]));
    return 1;
  };
  services.texture3d = [](void* h, const TmGrid* g, const char* file, const TmCloudOptions*, TmConstVec3, TmConstVec3,
                          const TmChannel* values, int32_t count, float* found) -> int32_t {
    of(h).asked = file;
    each(g, [&](int i) {
      found[i] = i % 2 == 0;
      for (int k = 0; k < count && i % 2 == 0; ++k) values[k].value.x[i] = 5;
    });
    return 1;
  };
  services.photonMap = [](void* h, const TmGrid* g, const char* file, const TmPhotonOptions* o, TmConstVec3,
                          TmConstVec3, TmVec3 out) -> int32_t {
    of(h).asked = file;
    each(g, [&](int i) { rsl::set(out, i, {static_cast<float>(o->estimator), o->maxDistance, 0}); });
    return 1;
  };
  services.subsurface = [](void* h, const TmGrid* g, const char* file, const TmSubsurfaceOptions* o, TmConstVec3,
                           TmVec3 out) -> int32_t {
    of(h).asked = file;
    each(g, [&](int i) { rsl::set(out, i, {o->scattering[0], o->ior, o->material ? 1.0f : 0.0f}); });
    return 1;
  };
}

}  // namespace tomales::compiler
