// The values that the host gives to a shader and takes from it: globals, parameters, outputs (RISpec 3.2, tables 12.1
// to 12.5; reyes/shader_api.h and docs/shader_writing.md tell where our conventions differ from RSL's).
#include <cstring>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/machine/masks.h"
#include "reyes/rsl/machine/run.h"

namespace tomales::compiler {
namespace {

/// Arrays of the grid, or one value for all points. A null c[0] stands for zero.
struct Source {
  const float* c[3] = {nullptr, nullptr, nullptr};
  bool same = false;
  bool reversed = false;  ///< True if its negative is meant.
};
Source arrays(TmConstVec3 v) { return {{v.x, v.y, v.z}}; }
Source arrays(TmVec3 v) { return {{v.x, v.y, v.z}}; }
Source array(const float* x) { return {{x, nullptr, nullptr}}; }
Source same(const float* one, int32_t components) {
  return {{one, components > 1 ? one + 1 : nullptr, components > 1 ? one + 2 : nullptr}, true};
}

/// Tells whether the shader is that of an area light: P and N are then those of the point on the light, and Ps and Ns
/// those of the lit point.
bool isArea(const TmGrid& g) { return g.Pl.x != nullptr; }

Source sourceOf(Global global, ShaderKind kind, const TmGrid& g) {
  static constexpr float kOne[3] = {1, 1, 1}, kComponents = 3;
  const bool light = kind == ShaderKind::Light, surface = kind == ShaderKind::Surface;
  switch (global) {
    case Global::P:
      return light && isArea(g) ? arrays(g.Pl) : arrays(g.P);
    case Global::N:
      return light && isArea(g) ? arrays(g.Nl) : arrays(g.N);
    case Global::Ng:
      return arrays(g.Ng);
    case Global::I:
      return arrays(g.I);
    case Global::E:
      return same(g.E, 3);
    case Global::Cs:
      return arrays(g.Cs);
    case Global::Os:
      return arrays(g.Os);
    case Global::dPdu:
      return arrays(g.dPdu);
    case Global::dPdv:
      return arrays(g.dPdv);
    case Global::u:
      return array(g.u);
    case Global::v:
      return array(g.v);
    case Global::s:
      return array(g.s);
    case Global::t:
      return array(g.t);
    case Global::du:
      return array(g.du);
    case Global::dv:
      return array(g.dv);
    case Global::dPdtime:
      return arrays(g.dPdtime);
    case Global::time:
      return same(&g.time, 1);
    case Global::dtime:
      return same(&g.dtime, 1);
    case Global::ncomps:
      return same(&kComponents, 1);
    case Global::Ci:
      return surface ? arrays(g.Cs) : arrays(g.Ci);
    case Global::Oi:
      return surface ? arrays(g.Os) : arrays(g.Oi);
    case Global::L: {
      Source L = light ? arrays(g.L) : Source{};
      L.reversed = true;
      return L;
    }
    case Global::Cl:
      return {};  // black until it is assigned, or illuminance() sets it
    case Global::Ol:
      return same(kOne, 3);
    case Global::Ps:
      return arrays(g.P);
    case Global::Ns:
      return arrays(g.N);
    case Global::alpha:
      return array(g.alpha);
    case Global::__near:
      return same(&g.clip[0], 1);
    case Global::__far:
      return same(&g.clip[1], 1);
  }
  return {};
}

/// Gives the register the values of the source, without a copy if possible.
void take(Run& run, int32_t r, const Source& s) {
  Lanes& l = run.lanes[r];
  const Located& located = run.program.located(r);
  const int32_t width = floatsOf(run.reg(r));
  const bool usable = located.where == Where::Given && s.c[0] && !s.same && !s.reversed;
  if (usable && useArrays(l, width, s.c[0], s.c[1], s.c[2])) return;  // never assigned
  if (!located.opens) return;
  for (int32_t c = 0; c < width; ++c) {
    float* const to = l.data + c * static_cast<ptrdiff_t>(l.component);
    const int32_t n = l.block == 0 ? kBlock : run.padded;
    if (!s.c[0])
      std::fill_n(to, n, 0.0f);
    else if (s.same || l.block == 0)
      std::fill_n(to, n, *s.c[c]);
    else
      std::copy_n(s.c[c], n, to);
    if (s.reversed) negate(n, to, to);
  }
}

/// Takes an array or a matrix that varies (kArrayVaries).
void takeArray(Run& run, int32_t r, const TmValue& v) {
  const Register& reg = run.reg(r);
  const int32_t width = floatsOf(reg);
  for (int32_t e = 0; e < std::min(elementsOf(reg), v.length); ++e)
    for (int32_t c = 0; c < width; ++c)
      std::copy_n((width == 3 ? v.c[c] : v.c[0] + static_cast<ptrdiff_t>(c) * run.padded) +
                      static_cast<ptrdiff_t>(e * width) * run.padded,
                  run.padded, run.lane(r).data + (e * width + c) * static_cast<ptrdiff_t>(run.stride(r)));
}

/// Takes arrays and matrices: element e of component k is c[k][e * components].
void takeSame(Run& run, int32_t r, const TmValue& v) {
  const Register& reg = run.reg(r);
  const Lanes& l = run.lane(r);
  const int32_t width = floatsOf(reg), n = l.block == 0 ? kBlock : run.padded;
  for (int32_t e = 0; e < std::min(elementsOf(reg), std::max(1, v.length)); ++e)
    for (int32_t c = 0; c < width; ++c)
      std::fill_n(l.data + (e * width + c) * static_cast<ptrdiff_t>(run.stride(r)), n,
                  width == 3 ? v.c[c][e * 3] : v.c[0][e * width + c]);
}

void takeTexts(Run& run, int32_t r, const Parameter& p, const TmValue& v) {
  const char* text = v.string;
  for (int32_t e = 0; e < elementsOf(run.reg(r)); ++e) {
    const auto k = static_cast<size_t>(e);
    run.variableText(r, e) = text ? text : k < p.texts.size() ? p.texts[k] : "";
    if (text && e + 1 < std::max(1, v.length)) text += std::strlen(text) + 1;
  }
}

/// Sets an output to its default, or to 0 if it has none.
void takeDefault(Run& run, int32_t r, const Parameter& p) {
  const Lanes& l = run.lane(r);
  for (int32_t k = 0; k < floatsOf(run.reg(r)); ++k)
    std::fill_n(l.data + k * static_cast<ptrdiff_t>(run.stride(r)), l.block == 0 ? kBlock : run.padded,
                static_cast<size_t>(k) < p.floats.size() ? p.floats[static_cast<size_t>(k)] : 0.0f);
}

void takeParameter(Run& run, int32_t r) {
  const Register& reg = run.reg(r);
  const Parameter& p = run.program.code().parameters[static_cast<size_t>(reg.index)];
  const TmValue& v = run.given.params[reg.index];
  if (reg.shape == Shape::Text) return takeTexts(run, r, p, v);
  if (p.output) return run.program.located(r).opens ? takeDefault(run, r, p) : void();
  if ((reg.length > 0 || reg.shape == Shape::Matrix) && v.step != 0) return takeArray(run, r, v);
  if (reg.length > 0 || reg.shape == Shape::Matrix) return takeSame(run, r, v);
  take(run, r, {{v.c[0], v.c[1], v.c[2]}, v.step == 0});
}

void storeComponent(const Run& run, const float* from, bool varies, float* to) {
  if (varies && run.everywhere)
    std::copy_n(from, run.padded, to);
  else if (varies)
    copyWhere(run.padded, run.whole.on, from, to);
  else
    fillWhere(run.padded, run.whole.on, *from, to);
}

void storeTriple(Run& run, int32_t r, TmVec3 to) {
  const Lanes& l = run.lane(r);
  float* const c[3] = {to.x, to.y, to.z};
  for (ptrdiff_t k = 0; k < 3 && to.x; ++k) storeComponent(run, l.data + k * l.component, l.block != 0, c[k]);
}

void storeGlobal(Run& run, Global global, int32_t r) {
  const TmGrid& g = run.given;
  const ShaderKind kind = run.program.code().kind;
  if (!info(global).writableIn(kind)) return;
  if (global == Global::P) storeTriple(run, r, g.P);
  if (global == Global::N && kind != ShaderKind::Surface) storeTriple(run, r, g.N);  // a surface's N is its own
  if (global == Global::Ci) storeTriple(run, r, g.Ci);
  if (global == Global::Oi) storeTriple(run, r, g.Oi);
  if (global == Global::Cl) storeTriple(run, r, g.Cl);
  if (global == Global::alpha && g.alpha) storeComponent(run, run.lane(r).data, run.varies(r), g.alpha);
  if (global == Global::L && g.L.x && !isArea(g)) {  // otherwise the host sets L
    const Lanes& l = run.lane(r);
    float* const to[3] = {g.L.x, g.L.y, g.L.z};
    for (ptrdiff_t c = 0; c < 3; ++c) {
      float* const from = l.data + c * l.component;
      const bool straight = run.everywhere && l.block != 0;
      negate(l.block == 0 ? kBlock : run.padded, from, straight ? to[c] : from);
      if (!straight) storeComponent(run, from, l.block != 0, to[c]);
    }
  }
}

void storeOutput(Run& run, int32_t r) {
  const TmValue& v = run.given.params[run.reg(r).index];
  if (v.step != 1) return;
  const Lanes& l = run.lane(r);
  for (ptrdiff_t k = 0; k < floatsOf(run.reg(r)); ++k)
    storeComponent(run, l.data + k * l.component, l.block != 0, const_cast<float*>(v.c[k]));
}

/// Sets Ci and Oi to Cs and Os where the shader has not assigned them (RISpec 3.2, table 12.1).
void storeOwnColors(Run& run, bool Ci, bool Oi) {
  const TmGrid& g = run.given;
  const auto copy = [&](TmConstVec3 from, TmVec3 to) {
    storeComponent(run, from.x, true, to.x);
    storeComponent(run, from.y, true, to.y);
    storeComponent(run, from.z, true, to.z);
  };
  if (!Ci) copy(g.Cs, g.Ci);
  if (!Oi) copy(g.Os, g.Oi);
}

bool isOutput(const Run& run, const Register& r) {
  return r.origin == Origin::Parameter && run.program.code().parameters[static_cast<size_t>(r.index)].output;
}

}  // namespace

bool useArrays(Lanes& l, int32_t width, const float* x, const float* y, const float* z) {
  const ptrdiff_t apart = width == 1 ? 0 : y - x;
  if (apart != static_cast<int32_t>(apart) || (width != 1 && (apart == 0 || z - y != apart))) return false;
  l = {const_cast<float*>(x), kBlock, static_cast<int32_t>(apart)};
  return true;
}

void open(Run& run) {
  for (const int32_t r : run.program.ofHost()) {
    if (run.reg(r).origin == Origin::Parameter) takeParameter(run, r);
    const int32_t global = run.program.located(r).global;
    if (global >= 0) take(run, r, sourceOf(static_cast<Global>(global), run.program.code().kind, run.given));
  }
}

void store(Run& run) {
  bool Ci = false, Oi = false;
  // Control structures may have made points inactive, but their results still count.
  if (!run.everywhere) begin(run.padded, run.count, run.given.active, run.whole.on);
  for (const int32_t r : run.program.ofHost()) {
    if (isOutput(run, run.reg(r))) storeOutput(run, r);
    const Located& l = run.program.located(r);
    if (l.global < 0 || !l.assigned) continue;
    const auto global = static_cast<Global>(l.global);
    storeGlobal(run, global, r);
    Ci |= global == Global::Ci;
    Oi |= global == Global::Oi;
  }
  if (run.program.code().kind == ShaderKind::Surface) storeOwnColors(run, Ci, Oi);
}

}  // namespace tomales::compiler
