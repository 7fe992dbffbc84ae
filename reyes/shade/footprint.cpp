#include "reyes/shade/footprint.h"

#include "reyes/shade/primary.h"

namespace tomales {
namespace {

/// Returns the angle that a point's micropolygon subtends in what it mirrors: twice the angle from the eye. (A flat
/// mirror keeps the angle; the factor allows for curvature, since changes of the normal are not known.)
float angleSeen(const TmGrid* g, int i) {
  const float edge =
      std::max(glm::length(get(g->dPdu, i)) * std::abs(g->du[i]), glm::length(get(g->dPdv, i)) * std::abs(g->dv[i]));
  const float distance = glm::length(get(g->I, i));
  return distance > 0 ? std::min(2 * edge / distance, kPi) : 0.0f;
}

}  // namespace

float micropolygonRadius(const ShadePoints& points, const TmGrid* g, int i) {
  const vec3 u = get(g->dPdu, i) * g->du[i], v = get(g->dPdv, i) * g->dv[i];
  const float diagonal = std::sqrt(dot(u, u) + dot(v, v));
  return diagonal > 0 ? 0.5f * diagonal : std::sqrt(points.channel(kArea)[i] / kPi);
}

void turnOf(Batch& batch, const TmGrid* g, TmConstVec3 direction, float* angle) {
  const float* axes[3] = {direction.x, direction.y, direction.z};
  float* step = batch.arena.floats(g->count);
  float* sum[2] = {batch.arena.floats(g->count), batch.arena.floats(g->count)};
  for (const bool alongV : {false, true})
    for (const float* axis : axes) {
      if (!batch.stepsOf(g, alongV, axis, step)) return forActive(g, [&](int i) { angle[i] = angleSeen(g, i); });
      forActive(g, [&](int i) { sum[alongV][i] += step[i] * step[i]; });
    }
  forActive(g, [&](int i) {
    const float length = glm::length(get(direction, i));
    angle[i] = length > 0 ? std::min(std::sqrt(std::max(sum[0][i], sum[1][i])) / length, kPi) : 0.0f;
  });
}

}  // namespace tomales
