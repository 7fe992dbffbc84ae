// The directional derivatives of noise.
#include "reyes/rsl/kernels/points.h"
#include "reyes/shader/noise.h"

namespace tomales::compiler::kernels {

using rsl::Vec3;

namespace {

/// A number and its derivative.
struct Changing {
  float value, slope;
};
RSL_INLINE Changing mix(Changing a, Changing b, Changing t) {
  return {rsl::mix(a.value, b.value, t.value), rsl::mix(a.slope, b.slope, t.value) + (b.value - a.value) * t.slope};
}
RSL_INLINE Changing fade(float t, float slope) { return {rsl::fade(t), 30 * (t * t) * ((1 - t) * (1 - t)) * slope}; }

/// Returns the slope of rsl::noise() along d, term by term; 0 where noise() clamps to [0, 1].
RSL_INLINE float slopeOf(const rsl::LatticePlace& p, Vec3 d) {
  const auto corner = [&](int i, int j, int k) RSL_INLINED {
    const Vec3 offset{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
    const uint32_t hash = rsl::latticeHash(p.x + i, p.y + j, p.z + k);
    return Changing{rsl::gradient(hash, p.f - offset), rsl::gradient(hash, d)};
  };
  const Changing u = fade(p.f.x, d.x), v = fade(p.f.y, d.y), w = fade(p.f.z, d.z);
  const auto face = [&](int k) RSL_INLINED {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  const Changing noise = mix(face(0), face(1), w);
  return std::abs(noise.value) > 1 ? 0 : 0.5f * noise.slope;
}

RSL_INLINE void slopesAt(int blocks, const Lanes& out, const Lanes* in, Vec3 far) {
  eachByReach(
      blocks, out, in, [far](Vec3 p, Vec3) RSL_INLINED { return rsl::isNearLattice(p + far); },
      [far](Vec3 p, Vec3 d) RSL_INLINED { return slopeOf(rsl::nearLatticePlace(p + far), d); },
      [far](Vec3 p, Vec3 d) RSL_INLINED { return slopeOf(rsl::latticePlace(p + far), d); });
}

}  // namespace

RSL_KERNEL(Slope3F) { slopesAt(blocks, out, in, Vec3{}); }
RSL_KERNEL(Slope3T) {
  for (int c = 0; c < 3; ++c) slopesAt(blocks, componentOf(out, c), in, rsl::kTriplePlaces[c]);
}

}  // namespace tomales::compiler::kernels
