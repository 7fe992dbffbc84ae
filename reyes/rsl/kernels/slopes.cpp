// How noise changes along a direction.
#include "reyes/rsl/kernels/points.h"
#include "reyes/shader/noise.h"

namespace tomales::compiler::kernels {

using rsl::Vec3;

namespace {

/// A number and how it changes.
struct Changing {
  float value, slope;
};
RSL_INLINE Changing mix(Changing a, Changing b, Changing t) {
  return {rsl::mix(a.value, b.value, t.value), rsl::mix(a.slope, b.slope, t.value) + (b.value - a.value) * t.slope};
}
RSL_INLINE Changing fade(float t, float slope) { return {rsl::fade(t), 30 * (t * t) * ((1 - t) * (1 - t)) * slope}; }

/// The slope of rsl::noise(p) along d, term by term; 0 where it is held to [0, 1].
RSL_INLINE float slopeOf(Vec3 p, Vec3 d) {
  const Vec3 cell{rsl::wholeBelow(p.x), rsl::wholeBelow(p.y), rsl::wholeBelow(p.z)}, f = p - cell;
  const int32_t x = rsl::latticeCoordinate(cell.x), y = rsl::latticeCoordinate(cell.y),
                z = rsl::latticeCoordinate(cell.z);
  const auto corner = [&](int i, int j, int k) RSL_INLINED {
    const Vec3 offset{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
    const uint32_t hash = rsl::latticeHash(x + i, y + j, z + k);
    return Changing{rsl::gradient(hash, f - offset), rsl::gradient(hash, d)};
  };
  const Changing u = fade(f.x, d.x), v = fade(f.y, d.y), w = fade(f.z, d.z);
  const auto face = [&](int k) RSL_INLINED {
    return mix(mix(corner(0, 0, k), corner(1, 0, k), u), mix(corner(0, 1, k), corner(1, 1, k), u), v);
  };
  const Changing noise = mix(face(0), face(1), w);
  return std::abs(noise.value) > 1 ? 0 : 0.5f * noise.slope;
}

}  // namespace

RSL_KERNEL(Slope3F) {
  each(blocks, out, in, [](Vec3 p, Vec3 d) RSL_INLINED { return slopeOf(p, d); });
}
RSL_KERNEL(Slope3T) {
  for (int c = 0; c < 3; ++c) {
    const Vec3 far = rsl::kTriplePlaces[c];
    each(blocks, componentOf(out, c), in, [far](Vec3 p, Vec3 d) RSL_INLINED { return slopeOf(p + far, d); });
  }
}

}  // namespace tomales::compiler::kernels
