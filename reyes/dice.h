// Verb: rectangles of patches -> Grid. Evaluates one primitive on regular lattices of equal counts, at every motion
// key.
//   in     object, patches, rectangles and counts that split.h (or a ray tessellator) chose
//   out    vertices: P in camera space per key, N, (u,v) and every primitive variable
//   never  projects, culls, displaces or shades
// Crack rule: a vertex on an edge depends only on the edge's parameters and its count along it, so neighbours with
// equal counts agree bit for bit; unequal counts are closed by the hider (docs/decisions/0003). Threads: concurrent
// calls are safe.
#pragma once
#include <span>

#include "reyes/grid.h"
#include "reyes/points.h"

namespace tomales {

/// When and where vertices are evaluated: a motion key for each time.
struct DiceKeys {
  const std::vector<float>& times;
  const Motion& currentFromObject;
};

/// pool: where the vertices are kept. Every piece has the vertices that it has alone.
Grid dice(const Scene& scene, int object, std::span<const PatchPiece> pieces, int nu, int nv, const DiceKeys& at,
          Pool* pool = nullptr);
Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, const DiceKeys& at);
/// keys: how many of the object's keyTimes to evaluate, as the camera sees them (all, or 1 for shutter open).
Grid dice(const Scene& scene, int object, uint32_t patch, const UvRect& rect, int nu, int nv, int keys);

/// A point of the true surface at shutter open, in current space; derivatives by the patch's own u and v.
struct TrueSurface {
  vec3 P, dPdu, dPdv;
  vec3 normal;  ///< RISpec side, not normalised; 0 where it is not defined.
};
TrueSurface surfaceAt(const Scene& scene, int object, uint32_t patch, float u, float v);

/// Fills one shading point at patch position (u, v): a ray hit. P and normals are evaluated on the true surface;
/// the caller may overwrite them. `primvarFloats` of the batch must be the object's.
void evaluatePoint(const Scene& scene, int object, uint32_t patch, float u, float v, ShadePoints& batch, int index);
/// Right after evaluatePoint, for a batch with steps: how values change over a footprint of that radius, of which du
/// and dv become the size.
void evaluateSteps(const Scene& scene, int object, uint32_t patch, float u, float v, float radius, ShadePoints& batch,
                   int index);

}  // namespace tomales
