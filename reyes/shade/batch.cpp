#include "reyes/shade/batch.h"

#include "reyes/shade/illuminate.h"
#include "reyes/shade/remote_batch.h"

namespace tomales {
namespace {

/// Lays out a varying array or matrix (kArrayVaries in reyes/rsl_host.h).
TmValue arrayOf(const Override& o, int32_t length, const Batch& batch) {
  TmValue out{{}, 1, length, nullptr};
  const int count = batch.tm.count, apart = batch.tm.padded;
  float* const all = batch.arena.floats(apart * o.width);
  const auto place = [&](int k) { return all + static_cast<ptrdiff_t>(k) * apart; };
  for (int k = 0; k < o.width; ++k) std::copy_n(batch.primvar(o.primvarOffset + k), count, place(k));
  for (int k = 0; k < std::min(3, o.width / length); ++k) out.c[k] = place(k);
  return out;
}

}  // namespace

Batch::Batch(const BoundScene& s, const BoundGroup& g, const ShadeContext& c, Arena& a)
    : scene(s), group(g), context(c), arena(a) {}

Batch::~Batch() = default;

TmConstVec3 Batch::constant(const vec3& v) {
  const TmVec3 out = arena.vec3(tm.count);
  std::fill_n(out.x, tm.padded, v.x);
  std::fill_n(out.y, tm.padded, v.y);
  std::fill_n(out.z, tm.padded, v.z);
  return view(out);
}

bool Batch::hasPrimvars() const { return grid || (points && points->primvarFloats() >= group.primvarFloats); }

const float* Batch::primvar(int offset) const {
  return grid ? grid->primvar(offset) : (wide_ ? wide_->points : *points).primvar(offset);
}

const std::vector<TmValue>& Batch::valuesOf(const BoundShader& shader) {
  const auto [place, isNew] = values_.try_emplace(&shader);
  if (isNew) place->second = laidOut(shader);
  return place->second;
}

std::vector<TmValue> Batch::laidOut(const BoundShader& shader) const {
  std::vector<TmValue> out = shader.values;
  if (!hasPrimvars()) return out;
  for (const Override& o : group.overridesOf(shader)) {
    TmValue& value = out[static_cast<size_t>(o.param)];
    if ((shader.shader->params[o.param].type & kArrayVaries) != 0)
      value = arrayOf(o, value.length, *this);
    else
      for (int k = 0; k < o.width; ++k) value.c[k] = primvar(o.primvarOffset + k);
    value.step = 1;
  }
  return out;
}

void Batch::setCommon(int count, const BoundShader& shader) {
  own = &shader;
  tm.structBytes = sizeof(TmGrid);
  tm.count = count;
  tm.padded = padded(count);
  uint8_t* active = arena.bytes(tm.padded);
  std::fill_n(active, count, uint8_t{1});
  tm.active = active;
  tm.call = &kServices;
  tm.host = this;
  const Options& options = scene.scene.options;
  tm.time = options.shutterOpen;
  tm.dtime = options.shutterClose - options.shutterOpen;
  tm.clip[0] = options.nearClip;
  tm.clip[1] = options.farClip;
}

void Batch::setVariables() {
  params_ = laidOut(*own);
  tm.params = params_.data();
  const Attributes& a = *group.group->attributes;
  const auto color = [&](int offset, const vec3& attribute) {
    if (offset < 0 || !hasPrimvars()) return constant(attribute);
    return TmConstVec3{primvar(offset), primvar(offset + 1), primvar(offset + 2)};
  };
  tm.Cs = color(group.CsOffset, a.color);
  tm.Os = color(group.OsOffset, a.opacity);
}

void Batch::setPoints(ShadePoints& p, const BoundShader& shader, ShadedPoints& out, int begin) {
  const bool wide = shader.can(TM_NEIGHBOURS) && p.hasSteps();
  std::optional<Widened> neighbours;
  if (wide) neighbours = widened(p, context.kind == RayKind::Camera && !scene.camera.perspective(), arena);
  setCommon(wide ? neighbours->points.count() : p.count(), shader);
  points = &p;
  wide_ = std::move(neighbours);
  ShadePoints& all = wide ? wide_->points : p;
  setVariables();
  tm.P = {all.channel(kPx), all.channel(kPy), all.channel(kPz)};
  tm.N = {all.channel(kNx), all.channel(kNy), all.channel(kNz)};
  tm.Ng = all.vec(kNgx);
  tm.I = all.vec(kIx);
  tm.dPdu = all.vec(kDpduX);
  tm.dPdv = all.vec(kDpdvX);
  tm.u = all.channel(kU);
  tm.v = all.channel(kV);
  tm.s = all.channel(kS);
  tm.t = all.channel(kT);
  tm.du = all.channel(kDu);
  tm.dv = all.channel(kDv);
  tm.dPdtime = velocity();
  tm.Ci = {out.Ci[0].data() + begin, out.Ci[1].data() + begin, out.Ci[2].data() + begin};
  tm.Oi = {out.Oi[0].data() + begin, out.Oi[1].data() + begin, out.Oi[2].data() + begin};
  if (!wide) return;
  tm.Ci = arena.vec3(tm.count);
  tm.Oi = arena.vec3(tm.count);
  stencil = wide_->stencil;
}

TmConstVec3 Batch::velocity() {
  const Motion& motion = group.group->currentFromOpen;
  if (tm.dtime <= 0) {
    const float* zero = arena.floats(tm.count);
    return {zero, zero, zero};
  }
  const TmVec3 out = arena.vec3(tm.count);
  const int n = points->count();
  const mat4 atClose = motion.at(scene.scene.options.shutterClose);
  for (int i = 0; i < tm.count; ++i) {
    const vec3 P = get(tm.P, i), end = P + points->get3(kDriftX, i % n);
    set(out, i, ((motion.moving() ? transformPoint(atClose, end) : end) - P) / tm.dtime);
  }
  return view(out);
}

void Batch::openOutputs(const std::vector<BoundVariable>& variables, ShadedPoints& out, int begin) {
  for (const BoundVariable& v : variables) {
    if (v.from != VariableSource::Output) continue;
    TmValue& value = params_[static_cast<size_t>(v.index)];
    for (int k = 0; k < v.width; ++k) {
      float* to = out.variables[static_cast<size_t>(v.first + k)].data() + begin;
      if (hasNeighbours()) std::fill_n(to = arena.floats(tm.count), tm.count, v.fill);
      value.c[k] = to;
    }
    value.step = 1;
  }
}

void Batch::closeOutputs(const std::vector<BoundVariable>& variables, ShadedPoints& out, int begin) {
  if (!hasNeighbours()) return;
  const int n = points->count();
  for (int k = 0; k < 3; ++k) {
    std::copy_n(k == 0 ? tm.Ci.x : k == 1 ? tm.Ci.y : tm.Ci.z, n, out.Ci[k].data() + begin);
    std::copy_n(k == 0 ? tm.Oi.x : k == 1 ? tm.Oi.y : tm.Oi.z, n, out.Oi[k].data() + begin);
  }
  for (const BoundVariable& v : variables)
    for (int k = 0; v.from == VariableSource::Output && k < v.width; ++k)
      std::copy_n(params_[static_cast<size_t>(v.index)].c[k], n,
                  out.variables[static_cast<size_t>(v.first + k)].data() + begin);
}

void Batch::setRemote(const Batch& asking, const TmGrid* g, const ShadePoints& moved) {
  own = asking.own;
  running = asking.running;
  points = &moved;
  tm = asking.tm;
  tm.host = this;
  uint8_t* active = arena.bytes(tm.padded);
  std::copy_n(g->active, moved.count(), active);
  tm.active = active;
  const auto copy = [&](int channel) {
    const TmVec3 to = arena.vec3(tm.count);
    for (int i = 0; i < moved.count(); ++i) set(to, i, moved.get3(channel, i));
    return to;
  };
  tm.P = copy(kPx);
  tm.N = copy(kNx);
  tm.Ng = view(copy(kNgx));
}

void Batch::setLit(const LightProbe& probe, const BoundShader& shader) {
  const int n = static_cast<int>(probe.P.size());
  setCommon(n, shader);
  setVariables();
  const TmConstVec3 zero = constant(vec3(0.0f));
  const auto copy = [&](const std::vector<vec3>& from) {
    const TmVec3 to = arena.vec3(n);
    for (int i = 0; i < n; ++i) set(to, i, from[static_cast<size_t>(i)]);
    return to;
  };
  tm.P = copy(probe.P);
  tm.N = copy(probe.N);
  tm.Ng = view(tm.N);
  tm.I = tm.dPdu = tm.dPdv = tm.dPdtime = zero;
  tm.u = tm.v = tm.s = tm.t = tm.du = tm.dv = zero.x;
  if (!probe.Pl.empty()) {
    tm.Pl = view(copy(probe.Pl));
    tm.Nl = view(copy(probe.Nl));
  }
  tm.L = arena.vec3(n);
  tm.Cl = arena.vec3(n);
  tm.sample = 0;
  tm.samples = 1;
  float *xi0 = arena.floats(n), *xi1 = arena.floats(n);
  for (size_t i = 0; i < probe.P.size(); ++i) {
    xi0[i] = probe.xi.empty() ? 0.5f : probe.xi[i].x;
    xi1[i] = probe.xi.empty() ? 0.5f : probe.xi[i].y;
  }
  tm.xi0 = xi0;
  tm.xi1 = xi1;
}

void Batch::setPixels(ShadedPixels& p, const BoundShader& shader) {
  const int n = p.count;
  setCommon(n, shader);
  setVariables();
  const TmConstVec3 zero = constant(vec3(0.0f));
  tm.P = arena.vec3(n);
  tm.N = arena.vec3(n);
  for (int i = 0; i < n; ++i) set(tm.P, i, {p.x + static_cast<float>(i), p.y, 0});
  tm.Ng = tm.I = tm.dPdu = tm.dPdv = tm.dPdtime = zero;
  tm.du = tm.dv = zero.x;
  // In an imager u and v run over the picture, from its top left corner.
  float *u = arena.floats(n), *v = arena.floats(n);
  for (int i = 0; i < n; ++i) {
    u[i] = tm.P.x[i] / static_cast<float>(scene.scene.options.xResolution);
    v[i] = tm.P.y[i] / static_cast<float>(scene.scene.options.yResolution);
  }
  tm.u = tm.s = u;
  tm.v = tm.t = v;
  tm.Ci = {p.colors.Ci[0].data(), p.colors.Ci[1].data(), p.colors.Ci[2].data()};
  tm.Oi = {p.colors.Oi[0].data(), p.colors.Oi[1].data(), p.colors.Oi[2].data()};
  tm.alpha = p.alpha.data();
}

void Batch::answer(const std::vector<float>& numbers, const std::string& text, TmType type, int32_t& typeOut,
                   TmValue& out) {
  const int width = type == TM_FLOAT || type == TM_STRING ? 1 : type == TM_MATRIX ? 16 : 3;
  float* values = arena.floats(std::max(static_cast<int>(numbers.size()), width));
  std::copy(numbers.begin(), numbers.end(), values);
  typeOut = type;
  out = {{values, width == 3 ? values + 1 : nullptr, width == 3 ? values + 2 : nullptr},
         0,
         type == TM_STRING ? 1 : std::max(1, static_cast<int>(numbers.size()) / width),
         type == TM_STRING ? answers_.emplace_back(text).c_str() : nullptr};
}

bool Batch::stepsOf(const TmGrid* g, bool alongV, const float* value, float* out) const {
  const int n = g->count;
  if (stencil && n == tm.count) {
    for (int i = 0; i < n; ++i) out[i] = stencil.step(alongV, value, i);
    return true;
  }
  if (!points) return false;
  const ShadePoints& p = *points;
  const auto is = [&](const float* known) { return known == value || std::equal(known, known + n, value); };
  const auto take = [&](const float* steps) {
    std::copy_n(steps, n, out);
    return true;
  };
  for (int k = 0; k < 3; ++k) {
    if (!is(p.channel(kPx + k))) continue;
    for (int i = 0; i < n; ++i) out[i] = p.channel((alongV ? kDpdvX : kDpduX) + k)[i] * (alongV ? g->dv : g->du)[i];
    return true;
  }
  if (!p.hasSteps()) {
    const bool isU = is(g->u);
    if (!isU && !is(g->v)) return false;
    if (isU != alongV) return take(alongV ? g->dv : g->du);
    std::fill_n(out, n, 0.0f);
    return true;
  }
  if (is(p.channel(kS))) return take(p.step(kStepS, alongV));
  if (is(p.channel(kT))) return take(p.step(kStepT, alongV));
  // A polygon's u and v are its x and y, so that both may change along either edge of a micropolygon.
  if (is(g->u)) return take(p.step(kStepU, alongV));
  if (is(g->v)) return take(p.step(kStepV, alongV));
  for (int k = 0; k < 3; ++k)
    if (is(p.channel(kNx + k))) return take(p.step(kStepN + k, alongV));
  for (int k = 0; k < p.primvarFloats(); ++k)
    if (is(p.primvar(k))) return take(p.step(kStepPrimvars + k, alongV));
  return false;
}

}  // namespace tomales
