#include "reyes/dice/evaluated.h"

namespace tomales {

TrueSurface surfaceAt(const Scene& scene, int object, uint32_t patch, float u, float v) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const mat4& m = scene.groups[static_cast<size_t>(o.group)].cameraFromObject;
  Evaluated e(1);
  evaluateAt(o, o.keyTimes.front(), 1, e,
             [&](const Prim& shape, Evaluated& out) { shape.evaluate(patch, 1, &u, &v, out.view()); });
  return {transformPoint(m, e.get(Evaluated::kP, 0)), transformVector(m, e.get(Evaluated::kDpdu, 0)),
          transformVector(m, e.get(Evaluated::kDpdv, 0)), normalMatrix(o, m) * e.get(Evaluated::kN, 0)};
}

namespace {

/// The shader's u and v at a place of a patch, and their derivatives along it: the patches of a mesh share one
/// parameter square.
struct ShaderParameters {
  float u, v, perU, perV;

  ShaderParameters(const Prim& prim, uint32_t patch, float u0, float v0) {
    const float us[3] = {u0, u0 < 0.5f ? u0 + 0.5f : u0 - 0.5f, u0},
                vs[3] = {v0, v0, v0 < 0.5f ? v0 + 0.5f : v0 - 0.5f};
    float su[3], sv[3];
    prim.surfaceParameters(patch, 3, us, vs, su, sv);
    const float dsu = (su[1] - su[0]) / (us[1] - us[0]), dsv = (sv[2] - sv[0]) / (vs[2] - vs[0]);
    u = su[0];
    v = sv[0];
    perU = dsu != 0 ? dsu : 1.0f;
    perV = dsv != 0 ? dsv : 1.0f;
  }
};

/// All primitive variables at one place, in current space.
void primvarsAt(const Prim& prim, uint32_t patch, float u, float v, const mat4& m, const mat3& normals,
                AlignedVector<float>& out) {
  out.clear();
  for (size_t k = 0; k < prim.primvars().size(); ++k) {
    const Primvar& p = prim.primvars()[k];
    const size_t first = out.size();
    out.resize(first + static_cast<size_t>(p.width));
    prim.interpolate(patch, static_cast<int>(k), 1, &u, &v, out.data() + first, 1);
    transformPrimvar(p, m, normals, 1, out.data() + first, 1);
  }
}

vec3 tripleAt(const AlignedVector<float>& values, int offset) {
  const float* v = values.data() + offset;
  return {v[0], v[1], v[2]};
}

}  // namespace

void evaluatePoint(const Scene& scene, int object, uint32_t patch, float u, float v, ShadePoints& batch, int index) {
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const Prim& prim = o.shape();
  const mat4& m = scene.groups[static_cast<size_t>(o.group)].cameraFromObject;
  const mat3 normals = normalMatrix(o, m);

  const TrueSurface surface = surfaceAt(scene, object, patch, u, v);
  const vec3 geometric = normalizeOr(surface.normal, vec3(0, 0, -1));
  batch.set3(kPx, index, surface.P);
  batch.set3(kNgx, index, geometric);
  batch.set3(kNx, index, geometric);

  const ShaderParameters shader(prim, patch, u, v);
  batch.set3(kDpduX, index, surface.dPdu / shader.perU);
  batch.set3(kDpdvX, index, surface.dPdv / shader.perV);
  batch.channel(kU)[index] = shader.u;
  batch.channel(kV)[index] = shader.v;
  batch.channel(kDu)[index] = 0;
  batch.channel(kDv)[index] = 0;
  batch.channel(kArea)[index] = 0;

  static thread_local AlignedVector<float> values;
  primvarsAt(prim, patch, u, v, m, normals, values);
  for (int c = 0; c < static_cast<int>(values.size()); ++c) batch.primvar(c)[index] = values[static_cast<size_t>(c)];
  if (const int n = offsetOf(prim.primvars(), "N"); n >= 0)
    batch.set3(kNx, index, normalizeOr(tripleAt(values, n), geometric));
  const vec2 st = o.attributes->textureAt(shader.u, shader.v);
  const int s = offsetOf(prim.primvars(), "s"), t = offsetOf(prim.primvars(), "t");
  batch.channel(kS)[index] = s >= 0 ? batch.primvar(s)[index] : st.x;
  batch.channel(kT)[index] = t >= 0 ? batch.primvar(t)[index] : st.y;
}

void evaluateSteps(const Scene& scene, int object, uint32_t patch, float u, float v, float radius, ShadePoints& batch,
                   int index) {
  constexpr float kWidest = 0.25f;  // share of a patch, so that a difference never passes both of its ends
  const Object& o = scene.objects[static_cast<size_t>(object)];
  const Prim& prim = o.shape();
  const mat4& m = scene.groups[static_cast<size_t>(o.group)].cameraFromObject;
  const mat3 normals = normalMatrix(o, m);
  const ShaderParameters here(prim, patch, u, v);
  const int N = offsetOf(prim.primvars(), "N"), s = offsetOf(prim.primvars(), "s"), t = offsetOf(prim.primvars(), "t");
  const auto normalAt = [&](float pu, float pv, const AlignedVector<float>& values) {
    return normalizeOr(N >= 0 ? tripleAt(values, N) : surfaceAt(scene, object, patch, pu, pv).normal, vec3(0));
  };
  static thread_local AlignedVector<float> moved;
  const vec3 normal = batch.get3(kNx, index);
  for (const bool alongV : {false, true}) {
    const float edge = glm::length(batch.get3(alongV ? kDpdvX : kDpduX, index)),
                per = std::abs(alongV ? here.perV : here.perU);
    const float patchStep = edge * per > 0 ? std::clamp(2 * radius / (edge * per), 1e-6f, kWidest) : kWidest;
    const float at = alongV ? v : u, sign = at + patchStep <= 1 ? 1.0f : -1.0f;
    const float pu = alongV ? u : u + sign * patchStep, pv = alongV ? v + sign * patchStep : v;
    primvarsAt(prim, patch, pu, pv, m, normals, moved);
    const auto put = [&](int value, float difference) { batch.step(value, alongV)[index] = sign * difference; };
    const vec3 turned = normalAt(pu, pv, moved) - normal;
    for (int axis = 0; axis < 3; ++axis) put(kStepN + axis, turned[axis]);
    const auto change = [&](int c) { return moved[static_cast<size_t>(c)] - batch.primvar(c)[index]; };
    for (int c = 0; c < static_cast<int>(moved.size()); ++c) put(kStepPrimvars + c, change(c));
    const ShaderParameters there(prim, patch, pu, pv);
    const vec2 st = o.attributes->textureAt(there.u, there.v) - o.attributes->textureAt(here.u, here.v);
    put(kStepS, s >= 0 ? change(s) : st.x);
    put(kStepT, t >= 0 ? change(t) : st.y);
    put(kStepU, there.u - here.u);
    put(kStepV, there.v - here.v);
    batch.channel(alongV ? kDv : kDu)[index] = patchStep * per;
  }
}

}  // namespace tomales
