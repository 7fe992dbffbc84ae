#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/image/sample_stack.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include "reyes/image/sample_stack.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Writes the samples of a vector, from `first` on, that a layer covers. Returns false if there are none.
HWY_INLINE bool coveredFrom(const ShadedLayer& l, size_t first, Mask& covered) {
  if (l.word != first / 64) return false;
  const uint64_t samples = l.samples >> first % 64 & ((uint64_t{1} << hn::Lanes(kF)) - 1);
  covered = hn::LoadMaskBits(kF, reinterpret_cast<const uint8_t*>(&samples));
  return samples != 0;
}

/// The light that passes all layers so far, for a vector of samples.
struct Clear {
  Floats x, y, z;

  HWY_INLINE Mask atMost(const vec3& least) const {
    return hn::And(hn::And(hn::Le(x, all(least.x)), hn::Le(y, all(least.y))), hn::Le(z, all(least.z)));
  }
  HWY_INLINE Floats mean(const vec3& v) const {
    return hn::Div(hn::Add(hn::Add(hn::Mul(x, all(v.x)), hn::Mul(y, all(v.y))), hn::Mul(z, all(v.z))), all(3.0f));
  }
  HWY_INLINE Clear behind(const vec3& opacity) const {
    return {hn::Mul(x, all(1.0f - opacity.x)), hn::Mul(y, all(1.0f - opacity.y)), hn::Mul(z, all(1.0f - opacity.z))};
  }
};

/// Composites a layer over a vector of samples.
void compositeAt(const ShadedLayer& l, const LayerExtras& more, Mask covered, SampleStack& stack, size_t first) {
  float *cx = stack.clear[0].data() + first, *cy = stack.clear[1].data() + first, *cz = stack.clear[2].data() + first;
  float *nearest = stack.nearest.data() + first, *values = stack.values.data() + first;
  const Clear clear{hn::Load(kF, cx), hn::Load(kF, cy), hn::Load(kF, cz)};
  const Floats before = hn::Load(kF, nearest);
  const Mask on = hn::AndNot(clear.atMost(stack.hidden), covered);
  // Whole vectors are stored: the next layer reads them back, and would have to wait for a masked store.
  const auto put = [](Floats v, Mask where, Floats old, float* to) {
    hn::Store(hn::IfThenElse(where, v, old), kF, to);
  };
  const auto add = [&](size_t k, Floats v) {
    float* to = values + k * stack.lanes;
    const Floats sum = hn::Load(kF, to);
    put(hn::Add(sum, v), on, sum, to);
  };
  for (size_t e = 0; e < more.extras.size(); ++e) {
    const Floats v = all(more.extraValues[e]);
    const int axis = more.extras[e].component % 3;
    if (more.extras[e].composited) {
      add(kColorFloats + e, hn::Mul(axis == 0 ? clear.x : axis == 1 ? clear.y : clear.z, v));
    } else {
      float* to = values + (kColorFloats + e) * stack.lanes;
      put(v, hn::And(on, hn::Eq(before, all(kInfinity))), hn::Load(kF, to), to);
    }
  }
  add(0, hn::Mul(clear.x, all(l.shade->color.x)));
  add(1, hn::Mul(clear.y, all(l.shade->color.y)));
  add(2, hn::Mul(clear.z, all(l.shade->color.z)));
  add(3, clear.mean(l.shade->coverage));
  if (more.air) {
    const vec3& color = more.air->color;
    const Floats seen[kColorFloats] = {hn::Mul(clear.x, all(color.x)), hn::Mul(clear.y, all(color.y)),
                                       hn::Mul(clear.z, all(color.z)), clear.mean(more.air->opacity)};
    for (size_t k = 0; k < kColorFloats; ++k) {
      float* to = stack.air[k].data() + first;
      put(seen[k], on, hn::Load(kF, to), to);
    }
  }
  put(hn::Min(before, all(l.z)), on, before, nearest);
  const Clear behind = clear.behind(l.shade->opacity);
  put(behind.x, on, clear.x, cx);
  put(behind.y, on, clear.y, cy);
  put(behind.z, on, clear.z, cz);
}

void composite(const ShadedLayer& l, const LayerExtras& more, SampleStack& stack) {
  Mask covered;
  for (size_t first = size_t{l.word} * 64; first < std::min(size_t{l.word} * 64 + 64, stack.lanes);
       first += hn::Lanes(kF))
    if (coveredFrom(l, first, covered)) compositeAt(l, more, covered, stack, first);
}

/// Does the same arithmetic in the same order, but one vector of samples after the other, so that nothing is stored
/// before the last fragment.
void compositeAll(std::span<const ShadedLayer> shadedLayers, SampleStack& stack) {
  for (size_t first = 0; first < stack.lanes; first += hn::Lanes(kF)) {
    Clear clear{all(1.0f), all(1.0f), all(1.0f)};
    Floats nearest = all(kInfinity), r = all(0.0f), g = r, b = r, a = r;
    Mask covered;
    for (const ShadedLayer& l : shadedLayers) {
      if (!coveredFrom(l, first, covered)) continue;
      const Mask on = hn::AndNot(clear.atMost(stack.hidden), covered);
      const auto add = [on](Floats& sum, Floats v) { sum = hn::IfThenElse(on, hn::Add(sum, v), sum); };
      add(r, hn::Mul(clear.x, all(l.shade->color.x)));
      add(g, hn::Mul(clear.y, all(l.shade->color.y)));
      add(b, hn::Mul(clear.z, all(l.shade->color.z)));
      add(a, clear.mean(l.shade->coverage));
      nearest = hn::IfThenElse(on, hn::Min(nearest, all(l.z)), nearest);
      const Clear behind = clear.behind(l.shade->opacity);
      clear = {hn::IfThenElse(on, behind.x, clear.x), hn::IfThenElse(on, behind.y, clear.y),
               hn::IfThenElse(on, behind.z, clear.z)};
    }
    hn::Store(nearest, kF, stack.nearest.data() + first);
    size_t k = 0;
    for (const Floats& v : {r, g, b, a}) hn::Store(v, kF, stack.values.data() + stack.lanes * k++ + first);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {

void SampleStack::resize(size_t samples, size_t floats) {
  lanes = samples;
  nearest.resize(lanes);
  values.resize(lanes * floats);
  for (auto& a : air) a.clear();
}

void SampleStack::reset(size_t samples, size_t floats, bool withAir) {
  lanes = samples;
  for (auto& c : clear) c.assign(lanes, 1.0f);
  nearest.assign(lanes, kInfinity);
  values.assign(lanes * floats, 0.0f);
  for (auto& a : air) a.assign(withAir ? lanes : 0, 0.0f);
}

void SampleStack::addAir() {
  for (size_t k = 0; k < kColorFloats; ++k)
    for (size_t i = 0; i < air[k].size(); ++i) values[k * lanes + i] += air[k][i];
}

HWY_EXPORT(composite);
HWY_EXPORT(compositeAll);
void SampleStack::composite(const ShadedLayer& l, const LayerExtras& more) {
  HWY_DYNAMIC_DISPATCH(composite)(l, more, *this);
}
void SampleStack::compositeAll(std::span<const ShadedLayer> shadedLayers) {
  HWY_DYNAMIC_DISPATCH(compositeAll)(shadedLayers, *this);
}

}  // namespace tomales
#endif
