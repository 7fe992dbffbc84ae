#include "tests/bench/rsl/batch.h"

#include <cmath>
#include <cstring>

#include "tests/bench/rsl/loops.h"

namespace tomales::bench {
namespace {

Batch& batchOf(void* host) { return *static_cast<Batch*>(host); }

TOMALES_HOT void transformed(const uint8_t* active, bool point, TmConstVec3 in, TmVec3 out) {
  const auto& m = Batch::kSpace;
  float* const to[3] = {out.x, out.y, out.z};
  for (int c = 0; c < 3; ++c)
#pragma GCC ivdep
    for (int i = 0; i < kPoints; ++i) {
      const float value = m[c][0] * in.x[i] + m[c][1] * in.y[i] + m[c][2] * in.z[i] + (point ? m[c][3] : 0);
      to[c][i] = active[i] ? value : to[c][i];
    }
}

TOMALES_HOT void patterned(const uint8_t* active, const float* s, const float* t, float* out) {
#pragma GCC ivdep
  for (int i = 0; i < kPoints; ++i) {
    const float x = s[i] - rsl::wholeBelow(s[i]), y = t[i] - rsl::wholeBelow(t[i]);
    out[i] = active[i] ? 4 * x * (1 - x) * y : out[i];
  }
}

}  // namespace

float* Batch::array() {
  arrays_.emplace_back(static_cast<size_t>(kPoints), 0.0f);
  return arrays_.back().data();
}

TmVec3 Batch::triple() {
  arrays_.emplace_back(static_cast<size_t>(3 * kPoints), 0.0f);
  float* const x = arrays_.back().data();
  return {x, x + kPoints, x + 2 * kPoints};
}

Batch::Batch() : active_(static_cast<size_t>(kPoints), 1) {
  grid.structBytes = sizeof grid;
  grid.count = grid.padded = kPoints;
  grid.clip[0] = 1;
  grid.clip[1] = 100;
  grid.P = triple();
  grid.N = triple();
  grid.Ci = triple();
  grid.Oi = triple();
  grid.L = triple();
  grid.Cl = triple();
  const TmVec3 Ng = triple(), I = triple(), dPdu = triple(), dPdv = triple(), dPdtime = triple(), Cs = triple(),
               Os = triple(), stepU = triple(), stepV = triple();
  float *const u = array(), *const v = array(), *const du = array(), *const dv = array(), *const ds = array(),
               *const dt = array();
  constexpr int kSide = 16;
  constexpr float kStep = 1.0f / 64;
  for (int i = 0; i < kPoints; ++i) {
    u[i] = (static_cast<float>(i % kSide) + 0.5f) * kStep + 0.3f;
    v[i] = (static_cast<float>(i / kSide) + 0.5f) * kStep + 0.4f;
    du[i] = dv[i] = ds[i] = dt[i] = kStep;
    const auto x = 4 * u[i] - 2, y = 4 * v[i] - 2, slope = 1.2f * std::cos(12 * u[i]);
    const rsl::Vec3 P = {x, y, 5 + 0.1f * std::sin(12 * u[i])}, across = {4, 0, slope}, along = {0, 4, 0};
    rsl::set(grid.P, i, P);
    rsl::set(I, i, P);
    rsl::set(dPdu, i, across);
    rsl::set(dPdv, i, along);
    rsl::set(stepU, i, kStep * across);
    rsl::set(stepV, i, kStep * along);
    rsl::set(grid.N, i, rsl::cross(along, across));
    rsl::set(Ng, i, rsl::cross(along, across));
    rsl::set(Cs, i, {0.8f, 0.7f, 0.6f});
    rsl::set(Os, i, {1, 1, 1});
  }
  grid.Ng = rsl::view(Ng);
  grid.I = rsl::view(I);
  grid.dPdu = rsl::view(dPdu);
  grid.dPdv = rsl::view(dPdv);
  grid.dPdtime = rsl::view(dPdtime);
  grid.Cs = rsl::view(Cs);
  grid.Os = rsl::view(Os);
  grid.u = grid.s = u;
  grid.v = grid.t = v;
  grid.du = du;
  grid.dv = dv;
  sStep = ds;
  tStep = dt;
  PStepU = rsl::view(stepU);
  PStepV = rsl::view(stepV);
  grid.active = active_.data();
  const rsl::Vec3 towards[kLights] = {{0.3f, 0.2f, -1}, {-0.5f, 0.5f, -1}, {0, -0.7f, -1}, {1, 0.1f, -0.3f}};
  for (const rsl::Vec3& L : towards) {
    const TmVec3 to = triple();
    for (int i = 0; i < kPoints; ++i) rsl::set(to, i, rsl::normalize(L));
    lights.push_back({rsl::view(to), {0.5f, 0.6f, 0.7f}});
  }
  setServices();
  grid.call = &services_;
  grid.host = this;
}

void Batch::bind(const TmShader& shader) {
  params_.clear();
  for (int32_t k = 0; k < shader.paramCount; ++k) {
    const TmParamDecl& p = shader.params[k];
    const int32_t type = TM_TYPE_OF(p.type);
    const bool three = type >= TM_COLOR && type <= TM_NORMAL;
    TmValue value{{p.floats, three ? p.floats + 1 : p.floats, three ? p.floats + 2 : p.floats}, 0, p.arrayLength, ""};
    if (type == TM_STRING) value.string = p.strings[0];
    params_.push_back(value);
  }
  grid.params = params_.data();
  grid.shader = &shader;
}

void Batch::lookUp(const TmGrid* g, const float* s, const float* t, TmVec3 out) {
  patterned(g->active, s, t, out.x);
  if (!out.y) return;
  patterned(g->active, t, s, out.y);
  patterned(g->active, s, s, out.z);
}

void Batch::setServices() {
  services_.structBytes = sizeof services_;
  services_.abi = TM_SHADER_ABI;
  services_.report = [](void*, const TmGrid*, int32_t, const char*) {};
  services_.ambient = [](void*, const TmGrid*, TmVec3 out) {
    for (float* c : {out.x, out.y, out.z}) std::fill_n(c, kPoints, 0.1f);
  };
  services_.diffuse = [](void* h, const TmGrid*, int32_t, TmConstVec3 N, TmVec3 out) {
    vectorServices().diffuse(batchOf(h), N, out);
  };
  services_.specular = [](void* h, const TmGrid*, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out) {
    vectorServices().specular(batchOf(h), N, V, roughness, out);
  };
  services_.illuminance = [](void* h, const TmGrid* g, TmIlluminance* q) -> int32_t {
    const Batch& me = batchOf(h);
    if (q->next == kLights) return 0;
    const Light& light = me.lights[static_cast<size_t>(q->next)];
    alignas(64) static thread_local float Cl[3][kPoints];
    alignas(64) static thread_local uint8_t lit[kPoints];
    const float color[3] = {light.Cl.x, light.Cl.y, light.Cl.z};
    for (int c = 0; c < 3; ++c) std::fill_n(Cl[c], kPoints, color[c]);
    std::memcpy(lit, g->active, sizeof lit);
    q->L = q->direction = light.L;
    q->Cl = {Cl[0], Cl[1], Cl[2]};
    q->lit = lit;
    q->light = q->next++;
    return 1;
  };
  services_.transform = [](void*, const TmGrid* g, int32_t kind, const char*, const char*, TmConstVec3 in,
                           TmVec3 out) -> int32_t {
    transformed(g->active, kind == TM_AS_POINT, in, out);
    return 1;
  };
  services_.derivative = [](void* h, const TmGrid* g, int32_t direction, const float* x, float* out) {
    const Batch& me = batchOf(h);
    const TmConstVec3& step = direction == 0 ? me.PStepU : me.PStepV;
    const float* const size = direction == 0 ? g->du : g->dv;
    const float* of = nullptr;
    if (x == g->P.x) of = step.x;
    if (x == g->P.y) of = step.y;
    if (x == g->P.z) of = step.z;
    if (x == (direction == 0 ? g->s : g->t)) of = me.sStep;
    for (int i = 0; i < kPoints; ++i) out[i] = of ? of[i] / size[i] : 0.0f;
  };
  services_.texture = [](void*, const TmGrid* g, const char*, const TmTextureOptions*, const float* s, const float* t,
                         TmVec3 out) -> int32_t {
    lookUp(g, s, t, out);
    return 1;
  };
  services_.transmission = [](void*, const TmGrid*, const TmRayOptions*, TmConstVec3, TmConstVec3, TmVec3 out) {
    for (float* c : {out.x, out.y, out.z}) std::fill_n(c, kPoints, 1.0f);
  };
  services_.ask = [](void*, const TmGrid*, int32_t, int32_t, const char*, int32_t*, TmValue*) -> int32_t { return 0; };
}

}  // namespace tomales::bench
