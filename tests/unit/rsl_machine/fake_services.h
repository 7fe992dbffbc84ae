// Part of fake_grid.h: the answers of the renderer of FakeGrid, numbers that tell what was asked.
#pragma once
#include "tests/unit/rsl_machine/fake_grid.h"

namespace tomales::compiler {

inline void FakeGrid::setServices() {
  services.structBytes = sizeof services;
  services.abi = TM_SHADER_ABI;
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
    each(g, [&](int i) {
      rsl::set(L, i, light.L);
      rsl::set(Cl, i, light.Cl);
      lit[i] = light.lit(i);
    });
    q->L = q->direction = rsl::view(L);
    q->Cl = rsl::view(Cl);
    q->lit = lit;
    q->light = q->next++;
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
    each(g, [&](int i) {
      x[i] = static_cast<float>(i % 16) / 16;
      y[i] = static_cast<float>(i / 16 % 16) / 16;
    });
  };
  services.texture = [](void* h, const TmGrid* g, const char* name, const TmTextureOptions* o, const float* s,
                        const float* t, TmVec3 out) -> int32_t {
    FakeGrid& me = of(h);
    me.seen(g);
    me.asked = name;
    me.textureOptions = *o;
    me.filter = o->filter ? o->filter : "";
    each(g, [&](int i) {
      out.x[i] = s[i];
      if (out.y) {
        out.y[i] = t[i];
        out.z[i] = static_cast<float>(o->channel);
      }
    });
    return 1;
  };
  services.environment = [](void* h, const TmGrid* g, const char* name, const TmTextureOptions* o, TmConstVec3 d,
                            TmVec3 out) -> int32_t {
    of(h).asked = name;
    of(h).textureOptions = *o;
    each(g, [&](int i) {
      out.x[i] = d.x[i];
      if (out.y) {
        out.y[i] = d.y[i];
        out.z[i] = d.z[i];
      }
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
    of(h).rayOptions = *rays;
    of(h).occlusionOptions = *o;
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
      *type = TM_FLOAT;
      *out = {{&me.lights[static_cast<size_t>(light)].dimmed, nullptr, nullptr}, 0, 1, nullptr};
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
    *type = TM_FLOAT;
    *out = {{resolution, nullptr, nullptr}, 0, 2, nullptr};
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
    me.asked = file;
    me.channels.clear();
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
