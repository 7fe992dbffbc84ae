// Noise (RISpec 15.1): reyes/shader/noise.h for all points of a block at once.
#include "reyes/shader/noise.h"

#include "reyes/rsl/kernels/points.h"
#include "reyes/shader/wavelet.h"

namespace tomales::compiler::kernels {

using rsl::kNoiseCut;
using rsl::latticePlace;
using rsl::nearLatticePlace;
using rsl::Vec3;

RSL_INLINE float cellOf(const rsl::LatticePlace& p) { return rsl::cellnoiseAt(p, 0); }

/// Makes kernels of noise that give a number or a triple: value(at) is the noise at a LatticePlace, `place` the
/// position that `parameters` mean. The components of a triple are taken at places far from each other.
#define RSL_LATTICE_NOISE(name, parameters, place, value)                                            \
  RSL_INLINE void name##At(int blocks, const Lanes& out, const Lanes* in, Vec3 far) {                \
    eachByReach(                                                                                     \
        blocks, out, in, [far] parameters RSL_INLINED { return rsl::isNearLattice((place) + far); }, \
        [far] parameters RSL_INLINED { return value(nearLatticePlace((place) + far)); },             \
        [far] parameters RSL_INLINED { return value(latticePlace((place) + far)); });                \
  }                                                                                                  \
  RSL_KERNEL(name##F) { name##At(blocks, out, in, Vec3{}); }                                         \
  RSL_KERNEL(name##T) {                                                                              \
    for (int c = 0; c < 3; ++c) name##At(blocks, componentOf(out, c), in, rsl::kTriplePlaces[c]);    \
  }

RSL_LATTICE_NOISE(Noise1, (float x), (Vec3{x, kNoiseCut, kNoiseCut}), rsl::noiseAt)
RSL_LATTICE_NOISE(Noise2, (float x, float y), (Vec3{x, y, kNoiseCut}), rsl::noiseAt)
RSL_LATTICE_NOISE(Noise3, (Vec3 p), p, rsl::noiseAt)
RSL_LATTICE_NOISE(Cell1, (float x), (Vec3{x, 0, 0}), cellOf)
RSL_LATTICE_NOISE(Cell2, (float x, float y), (Vec3{x, y, 0}), cellOf)
RSL_LATTICE_NOISE(Cell3, (Vec3 p), p, cellOf)

/// The same for a `value` that asks for the noise at q.
#define RSL_NOISE(name, parameters, place, value)                          \
  RSL_KERNEL(name##F) {                                                    \
    each(blocks, out, in, [] parameters RSL_INLINED {                      \
      const Vec3 q = place;                                                \
      return value;                                                        \
    });                                                                    \
  }                                                                        \
  RSL_KERNEL(name##T) {                                                    \
    for (int c = 0; c < 3; ++c) {                                          \
      const Vec3 far = rsl::kTriplePlaces[c];                              \
      each(blocks, componentOf(out, c), in, [far] parameters RSL_INLINED { \
        const Vec3 q = (place) + far;                                      \
        return value;                                                      \
      });                                                                  \
    }                                                                      \
  }

RSL_NOISE(Noise4, (Vec3 p, float t), p, rsl::noise(q, t))
RSL_NOISE(Cell4, (Vec3 p, float t), p, rsl::cellnoise(q, t))

RSL_NOISE(Pnoise1, (float x, float xPeriod), (Vec3{x, kNoiseCut, kNoiseCut}), rsl::pnoise(q, Vec3{xPeriod, 0, 0}))
RSL_NOISE(Pnoise2, (float x, float y, float xPeriod, float yPeriod), (Vec3{x, y, kNoiseCut}),
          rsl::pnoise(q, Vec3{xPeriod, yPeriod, 0}))
RSL_NOISE(Pnoise3, (Vec3 p, Vec3 period), p, rsl::pnoise(q, period))
RSL_NOISE(Pnoise4, (Vec3 p, float t, Vec3 period, float tPeriod), p, rsl::pnoise(q, t, period, tPeriod))

void Wnoise(int blocks, const Lanes& out, const Lanes* in) {
  each(blocks, out, in, [](Vec3 p, float width) { return rsl::wnoise(p, width); });
}

}  // namespace tomales::compiler::kernels
