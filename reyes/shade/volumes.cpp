#include "reyes/shade/volumes.h"

#include "reyes/shade/primary.h"
#include "reyes/shade/system.h"

namespace tomales {
namespace {

constexpr float kFar = 1e30f;

/// One volume shader over the rays of `which`.
void cross(Batch& asking, const BoundShader& volume, const std::vector<int>& which, TmConstVec3 origin, TmConstVec3 direction,
           const float* distance, TmVec3 color, TmVec3 opacity) {
  const ShadePoints& from = *asking.points;
  ShadePoints ends(from.group(), from.primvarFloats(), from.hasSteps());
  for (int i : which) ends.add(from.name(i));
  ShadedPoints out;
  out.resize(ends.count());
  for (int k = 0; k < ends.count(); ++k) {
    const int i = which[static_cast<size_t>(k)];
    for (int c = 0; c < from.channelCount(); ++c) ends.channel(c)[k] = from.channel(c)[i];
    const vec3 I = distance[i] * get(direction, i);
    ends.set3(kPx, k, get(origin, i) + I), ends.set3(kIx, k, I);
    for (int axis = 0; axis < 3; ++axis) {
      out.Ci[axis][static_cast<size_t>(k)] = get(color, i)[axis];
      out.Oi[axis][static_cast<size_t>(k)] = opacity.x ? get(opacity, i)[axis] : 1.0f;
    }
  }
  const ShaderTimer timer(asking.scene.stats, volume, ends.count());
  ArenaLease arena;
  Batch batch(asking.scene, asking.group, asking.context, *arena);
  batch.setPoints(ends, volume, {}, out, 0);
  if (!batch.run(volume, batch.tm)) return;
  batch.blackOutNonFinite(volume);
  for (int k = 0; k < ends.count(); ++k) set(color, which[static_cast<size_t>(k)], out.color(k));
}

}  // namespace

void crossVolumes(Batch& batch, const TmGrid* g, TmConstVec3 origin, TmConstVec3 direction, const float* distance, TmVec3 color, TmVec3 opacity) {
  const BoundShader* volumes[2] = {batch.group.exterior.get(), batch.group.interior.get()};
  for (const bool inwards : {false, true}) {
    if (!volumes[inwards]) continue;
    std::vector<int> which;
    forActive(g, [&](int i) {
      if (distance[i] < kFar && (dot(get(direction, i), get(g->Ng, i)) < 0) == inwards) which.push_back(i);
    });
    if (!which.empty()) cross(batch, *volumes[inwards], which, origin, direction, distance, color, opacity);
  }
}

}  // namespace tomales
