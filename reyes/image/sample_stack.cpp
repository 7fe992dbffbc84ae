#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/image/sample_stack.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include "reyes/image/sample_stack.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// A vector of samples.
void layAt(const Lay& l, uint64_t samples, SampleStack& stack, size_t first) {
  float *cx = stack.clear[0].data() + first, *cy = stack.clear[1].data() + first, *cz = stack.clear[2].data() + first;
  float *nearest = stack.nearest.data() + first, *values = stack.values.data() + first;
  const Floats x = hn::Load(kF, cx), y = hn::Load(kF, cy), z = hn::Load(kF, cz), before = hn::Load(kF, nearest);
  const Mask hidden = hn::And(hn::And(hn::Le(x, all(l.hidden.x)), hn::Le(y, all(l.hidden.y))), hn::Le(z, all(l.hidden.z)));
  const Mask on = hn::AndNot(hidden, hn::LoadMaskBits(kF, reinterpret_cast<const uint8_t*>(&samples)));
  // Whole vectors: the next layer reads them back, and could not from a masked store that is still on its way.
  const auto put = [](Floats v, Mask where, Floats old, float* to) { hn::Store(hn::IfThenElse(where, v, old), kF, to); };
  const auto add = [&](size_t k, Floats v) {
    float* to = values + k * stack.lanes;
    const Floats sum = hn::Load(kF, to);
    put(hn::Add(sum, v), on, sum, to);
  };
  for (size_t e = 0; e < l.extras.size(); ++e) {
    const Floats v = all(l.extraValues[e]);
    const int axis = l.extras[e].component % 3;
    if (l.extras[e].composited) {
      add(4 + e, hn::Mul(axis == 0 ? x : axis == 1 ? y : z, v));
    } else {
      float* to = values + (4 + e) * stack.lanes;
      put(v, hn::And(on, hn::Eq(before, all(kInfinity))), hn::Load(kF, to), to);
    }
  }
  add(0, hn::Mul(x, all(l.color.x)));
  add(1, hn::Mul(y, all(l.color.y)));
  add(2, hn::Mul(z, all(l.color.z)));
  const auto mean = [&](const vec3& v) {
    return hn::Div(hn::Add(hn::Add(hn::Mul(x, all(v.x)), hn::Mul(y, all(v.y))), hn::Mul(z, all(v.z))), all(3.0f));
  };
  add(3, mean(l.coverage));
  if (l.air) {
    const Floats seen[4] = {hn::Mul(x, all(l.air->color.x)), hn::Mul(y, all(l.air->color.y)), hn::Mul(z, all(l.air->color.z)), mean(l.air->opacity)};
    for (size_t k = 0; k < 4; ++k) {
      float* to = stack.air[k].data() + first;
      put(seen[k], on, hn::Load(kF, to), to);
    }
  }
  put(hn::Min(before, all(l.z)), on, before, nearest);
  put(hn::Mul(x, all(1.0f - l.opacity.x)), on, x, cx);
  put(hn::Mul(y, all(1.0f - l.opacity.y)), on, y, cy);
  put(hn::Mul(z, all(1.0f - l.opacity.z)), on, z, cz);
}

void lay(const Lay& l, SampleStack& stack) {
  const size_t first = size_t{l.word} * 64, lanes = hn::Lanes(kF);
  for (size_t g = 0; g < 64; g += lanes) {
    const uint64_t samples = l.samples >> g & ((uint64_t{1} << lanes) - 1);
    if (samples) layAt(l, samples, stack, first + g);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {

void SampleStack::reset(size_t samples, size_t floats, bool withAir) {
  lanes = samples;
  for (auto& c : clear) c.assign(lanes, 1.0f);
  nearest.assign(lanes, kInfinity);
  values.assign(lanes * floats, 0.0f);
  for (auto& a : air) a.assign(withAir ? lanes : 0, 0.0f);
}

void SampleStack::addAir() {
  for (size_t k = 0; k < 4; ++k)
    for (size_t i = 0; i < air[k].size(); ++i) values[k * lanes + i] += air[k][i];
}

HWY_EXPORT(lay);
void SampleStack::lay(const Lay& l) { HWY_DYNAMIC_DISPATCH(lay)(l, *this); }

}  // namespace tomales
#endif
