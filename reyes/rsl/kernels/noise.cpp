// Noise (RISpec 15.1): reyes/shader/noise.h for all points of a block at once.
#include "reyes/shader/noise.h"

#include "reyes/rsl/kernels/points.h"
#include "reyes/shader/wavelet.h"

namespace tomales::compiler::kernels {

using rsl::kNoiseCut;
using rsl::Vec3;

/// Of a number and of a triple: what `parameters` mean is a place, at which `value` asks for a number as of q; the
/// components of a triple ask at places far from each other.
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
        const Vec3 q = place + far;                                        \
        return value;                                                      \
      });                                                                  \
    }                                                                      \
  }

RSL_NOISE(Noise1, (float x), (Vec3{x, kNoiseCut, kNoiseCut}), rsl::noise(q))
RSL_NOISE(Noise2, (float x, float y), (Vec3{x, y, kNoiseCut}), rsl::noise(q))
RSL_NOISE(Noise3, (Vec3 p), p, rsl::noise(q))
RSL_NOISE(Noise4, (Vec3 p, float t), p, rsl::noise(q, t))

RSL_NOISE(Cell1, (float x), (Vec3{x, 0, 0}), rsl::cellnoise(q))
RSL_NOISE(Cell2, (float x, float y), (Vec3{x, y, 0}), rsl::cellnoise(q))
RSL_NOISE(Cell3, (Vec3 p), p, rsl::cellnoise(q))
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
