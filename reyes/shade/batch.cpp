#include "reyes/shade/batch.h"

#include <fmt/format.h>

#include <utility>

namespace tomales {

Batch::Batch(const BoundScene& s, const BoundGroup& g, const ShadeContext& c, Arena& a)
    : scene(s), group(g), context(c), arena(a) {}

TmConstVec3 Batch::constant(const vec3& v) {
  const TmVec3 out = arena.vec3(tm.count);
  for (int i = 0; i < tm.padded; ++i) set(out, i, v);
  return view(out);
}

void Batch::setCommon(int count, const BoundShader& shader, const std::vector<Override>& overrides,
                      const std::function<const float*(int)>& primvar) {
  tm = {};
  tm.structBytes = sizeof(TmGrid);
  tm.count = count, tm.padded = padded(count);
  uint8_t* active = arena.bytes(tm.padded);
  std::fill_n(active, count, uint8_t{1});
  tm.active = active;
  tm.call = &kServices, tm.host = this;
  tm.time = scene.scene.options.shutterOpen;
  tm.clip[0] = scene.scene.options.nearClip, tm.clip[1] = scene.scene.options.farClip;
  lights = {};
  gathered.who = nullptr;

  params_ = shader.values;
  for (const Override& o : overrides) {
    TmValue& value = params_[static_cast<size_t>(o.param)];
    for (int k = 0; k < o.width; ++k) value.c[k] = primvar(o.primvarOffset + k);
    value.step = 1;
  }
  tm.params = params_.data();

  const Attributes& a = *group.group->attributes;
  const auto color = [&](int offset, const vec3& attribute) {
    if (offset < 0) return constant(attribute);
    return TmConstVec3{primvar(offset), primvar(offset + 1), primvar(offset + 2)};
  };
  tm.Cs = color(group.CsOffset, a.color), tm.Os = color(group.OsOffset, a.opacity);
}

void Batch::setPoints(ShadePoints& p, const BoundShader& shader, const std::vector<Override>& overrides,
                      ShadedPoints& out, int begin) {
  points = &p;
  setCommon(p.count(), shader, overrides, [&](int offset) { return p.primvar(offset); });
  tm.P = {p.channel(kPx), p.channel(kPy), p.channel(kPz)};
  tm.N = {p.channel(kNx), p.channel(kNy), p.channel(kNz)};
  tm.Ng = p.vec(kNgx), tm.I = p.vec(kIx);
  tm.dPdu = p.vec(kDpduX), tm.dPdv = p.vec(kDpdvX);
  tm.u = p.channel(kU), tm.v = p.channel(kV), tm.s = p.channel(kS), tm.t = p.channel(kT);
  tm.du = p.channel(kDu), tm.dv = p.channel(kDv);
  tm.Ci = {out.Ci[0].data() + begin, out.Ci[1].data() + begin, out.Ci[2].data() + begin};
  tm.Oi = {out.Oi[0].data() + begin, out.Oi[1].data() + begin, out.Oi[2].data() + begin};
}

void Batch::setLit(const LightProbe& probe, const BoundShader& shader) {
  const int n = static_cast<int>(probe.P.size());
  setCommon(n, shader, {}, [](int) { return nullptr; });
  const TmConstVec3 zero = constant(vec3(0.0f));
  const auto copy = [&](const std::vector<vec3>& from) {
    const TmVec3 to = arena.vec3(n);
    for (int i = 0; i < n; ++i) set(to, i, from[static_cast<size_t>(i)]);
    return to;
  };
  tm.P = copy(probe.P), tm.N = copy(probe.N);
  tm.Ng = view(tm.N);
  tm.I = tm.dPdu = tm.dPdv = zero;
  tm.u = tm.v = tm.s = tm.t = tm.du = tm.dv = zero.x;
  if (!probe.Pl.empty()) tm.Pl = view(copy(probe.Pl)), tm.Nl = view(copy(probe.Nl));
  tm.L = arena.vec3(n), tm.Cl = arena.vec3(n);
  tm.sample = 0, tm.samples = 1;
}

void Batch::setPixels(ShadedPixels& p, const BoundShader& shader) {
  const int n = static_cast<int>(p.alpha.size());
  setCommon(n, shader, {}, [](int) { return nullptr; });
  const TmConstVec3 zero = constant(vec3(0.0f));
  tm.P = arena.vec3(n), tm.N = arena.vec3(n);
  for (int i = 0; i < n; ++i) set(tm.P, i, {p.x + static_cast<float>(i), p.y, 0});
  tm.Ng = tm.I = tm.dPdu = tm.dPdv = zero;
  tm.u = tm.v = tm.s = tm.t = tm.du = tm.dv = zero.x;
  tm.Ci = {p.colors.Ci[0].data(), p.colors.Ci[1].data(), p.colors.Ci[2].data()};
  tm.Oi = {p.colors.Oi[0].data(), p.colors.Oi[1].data(), p.colors.Oi[2].data()};
  tm.alpha = p.alpha.data();
}

void Batch::blackOutNonFinite(const BoundShader& shader) {
  bool bad = false;
  for (int i = 0; i < tm.count; ++i) {
    if (isFinite(get(tm.Ci, i)) && isFinite(get(tm.Oi, i))) continue;
    bad = true;
    if (!isFinite(get(tm.Oi, i))) set(tm.Oi, i, vec3(1.0f));
    set(tm.Ci, i, vec3(0.0f));
  }
  running = &shader;
  if (bad) report(Severity::Warning, "shader-not-finite", "returned NaN or infinity; such points are black");
}

bool Batch::run(const BoundShader& shader, const TmGrid& tmGrid) {
  const BoundShader* caller = std::exchange(running, &shader);
  bool finished = true;
  const auto threw = [&](const char* what) {
    report(Severity::Missing, "shader-exception",
           fmt::format("threw an exception ({}); its result is discarded", what));
    finished = false;
  };
  try {
    shader.shader->shade(&tmGrid);
  } catch (const std::exception& e) {
    threw(e.what());
  } catch (...) {
    threw("of an unknown type");
  }
  running = caller;
  return finished;
}

void Batch::report(Severity severity, const char* code, const std::string& problem) const {
  const std::string who =
      running->user == group.object ? running->user : running->user + ", on " + group.object;
  scene.log.report(severity, fmt::format("{}-{}", code, running->shader->name), running->where,
                   fmt::format("{}: shader \"{}\" {}", who, running->shader->name, problem));
}

}  // namespace tomales
