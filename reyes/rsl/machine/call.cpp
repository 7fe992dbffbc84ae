#include "reyes/rsl/machine/call.h"

#include <cstring>

namespace tomales::compiler {

void Call::finish() {
  for (const Pending& p : pending_) {
    const Lanes& l = run.lane(p.r);
    for (ptrdiff_t c = 0; c < floatsOf(run.reg(p.r)); ++c)
      std::fill_n(l.data + c * l.component, kBlock, p.from[c * p.component + run.firstActive()]);
  }
}

TmConstVec3 Call::tripleOf(int32_t r) {
  const Lanes& l = run.lane(r);
  if (l.block != 0) return {l.data, l.data + l.component, l.data + 2 * static_cast<ptrdiff_t>(l.component)};
  const auto n = static_cast<size_t>(run.padded);
  float* const to = run.memory.floats(3 * n);
  for (size_t c = 0; c < 3; ++c) std::fill_n(to + c * n, n, l.data[static_cast<ptrdiff_t>(c) * l.component]);
  return {to, to + n, to + 2 * n};
}

TmConstVec3 Call::copied(size_t k) {
  const auto n = static_cast<size_t>(run.padded);
  const TmConstVec3 from = triple(k);
  float* const to = run.memory.floats(3 * n);
  std::copy_n(from.x, n, to);
  std::copy_n(from.y, n, to + n);
  std::copy_n(from.z, n, to + 2 * n);
  return {to, to + n, to + 2 * n};
}

const float* Call::numberOf(int32_t r) {
  const Lanes& l = run.lane(r);
  if (l.block != 0) return l.data;
  float* const to = run.memory.floats(static_cast<size_t>(run.padded));
  std::fill_n(to, run.padded, *l.data);
  return to;
}

int32_t Call::whole(size_t k, const char* what) {
  const float x = one(k, what);
  return x > -kMostWhole && x < kMostWhole ? static_cast<int32_t>(x) : 0;
}

float Call::one(size_t k, const char* what) {
  const Lanes& l = run.lane(of.in[k]);
  if (l.block == 0) return *l.data;
  const int32_t first = run.firstActive();
  for (int32_t i = first; i < run.count; ++i)
    if (run.mask->on[i] && l.data[i] != l.data[first]) {
      run.warn(std::string("asks for ") + what + " that differ from point to point, where one value counts for all");
      break;
    }
  return l.data[first];
}

TmVec3 Call::giveTripleTo(int32_t r) {
  const int32_t apart = run.varies(r) ? run.lane(r).component : run.padded;
  float* const to = give(r, 3, apart);
  return {to, to + apart, to + 2 * static_cast<ptrdiff_t>(apart)};
}

float* Call::giveNumberTo(int32_t r) { return give(r, 1, run.padded); }

float* Call::give(int32_t r, int32_t width, int32_t apart) {
  const Lanes& l = run.lane(r);
  const bool varies = l.block != 0;
  float* const to = varies ? l.data : run.memory.floats(static_cast<size_t>(width) * static_cast<size_t>(apart));
  if (!varies) pending_.push_back({r, to, apart});
  for (ptrdiff_t c = 0; c < width; ++c)
    if (!varies)
      std::fill_n(to + c * apart, apart, l.data[c * l.component]);
    else if (run.reg(r).origin == Origin::Temporary)
      std::fill_n(to + c * apart, run.padded, 0.0f);
  return to;
}

void Call::set(float value, size_t k) {
  const int32_t r = of.out[k];
  float* const to = run.lane(r).data;
  if (!run.varies(r))
    std::fill_n(to, kBlock, value);
  else if (run.reg(r).origin == Origin::Temporary)
    std::fill_n(to, run.padded, value);
  else
    fillWhere(run.padded, run.mask->on, value, to);
}

namespace {

/// Returns component c of element e of a value, at point i.
float valueAt(const TmValue& v, int32_t width, int32_t e, int32_t c, int32_t i) {
  return width == 3 ? v.c[c][e * 3 + i * v.step] : v.c[0][e * width + c + i * v.step];
}

bool fits(Shape shape, int32_t type) {
  switch (shape) {
    case Shape::Number:
      return type == TM_FLOAT;
    case Shape::Triple:
      return type >= TM_COLOR && type <= TM_NORMAL;
    case Shape::Matrix:
      return type == TM_MATRIX;
    case Shape::Text:
      return type == TM_STRING;
  }
  return false;
}

}  // namespace

bool fill(Run& run, int32_t to, int32_t type, const TmValue& v) {
  const Register& reg = run.reg(to);
  if (!fits(reg.shape, type)) return false;
  const int32_t elements = std::min(elementsOf(reg), std::max(1, v.length)), width = floatsOf(reg);
  if (reg.shape == Shape::Text) {
    const char* text = v.string ? v.string : "";
    for (int32_t e = 0; e < elements; ++e, text += std::strlen(text) + 1) run.variableText(to, e) = text;
    return true;
  }
  const Lanes& l = run.lane(to);
  const ptrdiff_t stride = run.stride(to);
  for (int32_t e = 0; e < elements; ++e)
    for (int32_t c = 0; c < width; ++c) {
      float* const out = l.data + (e * width + c) * stride;
      if (l.block == 0)
        std::fill_n(out, kBlock, valueAt(v, width, e, c, run.firstActive()));
      else
        for (int32_t i = 0; i < run.count; ++i)
          if (run.mask->on[i]) out[i] = valueAt(v, width, e, c, i);
    }
  return true;
}

}  // namespace tomales::compiler
