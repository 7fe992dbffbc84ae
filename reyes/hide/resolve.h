// Private to the hider: turns samples into a DeepTile.
#pragma once
#include <span>

#include "reyes/hide/samples.h"

namespace tomales {

/// unseen: cells that become points to shade even if no sample sees them. diagnostics: gets counts in
/// HideDiagnostics::turns; may be null.
DeepTile resolveTile(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples,
                     std::span<const uint32_t> unseen, HideDiagnostics* diagnostics = nullptr);

/// A sample: raster position, time of the shutter (0..1), point of the lens (as in SampleBuffer).
struct SamplePoint {
  vec2 at;
  float time;
  vec2 lens;
};
inline SamplePoint samplePoint(const SampleBuffer& s, size_t lane) {
  if (s.time.empty()) return {{s.x[lane], s.y[lane]}, 0, vec2(0)};
  return {{s.x[lane], s.y[lane]}, s.time[lane], {s.lensX[lane], s.lensY[lane]}};
}
/// Corners a b c d of a cell at the time and lens point of a sample: raster x and y, depth key.
struct SeenCell {
  vec3 a, b, c, d;
};
SeenCell seenCell(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample);
/// Returns the depth key of a cell where a sample meets it.
float depthOnCell(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample);
/// Returns where a sample meets a cell, in the cell's own (u,v) from 0 to 1. If the sample is outside of the cell, it
/// returns where it meets the plane of one of the triangles, beyond that range.
vec2 positionOnCell(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample);

}  // namespace tomales
