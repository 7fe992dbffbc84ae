#include "reyes/shade/volumes.h"

#include "reyes/shade/primary.h"
#include "reyes/shade/services.h"
#include "reyes/shade/system.h"

namespace tomales {
namespace {

/// Runs a volume shader over the colours and opacities at the ends of rays. Returns false if it has thrown.
bool run(const BoundScene& scene, const BoundGroup& group, const BoundShader& volume, const ShadeContext& context,
         ShadePoints& ends, ShadedPoints& out) {
  const ShaderTimer timer(scene.stats, volume, ends.count());
  ArenaLease arena;
  Batch batch(scene, group, context, *arena);
  batch.setPoints(ends, volume, out, 0);
  if (!batch.run(volume, batch.tm)) return false;
  batch.blackOutNonFinite(volume);
  return true;
}

/// Lets the rays of `which` cross a volume.
void cross(Batch& asking, const BoundShader& volume, const std::vector<int>& which, TmConstVec3 origin,
           TmConstVec3 direction, const float* distance, TmVec3 color, TmVec3 opacity) {
  const ShadePoints& from = *asking.points;
  ShadePoints ends(from.group(), from.primvarFloats(), from.hasSteps());
  for (int i : which) ends.add(from.name(i));
  ShadedPoints out;
  out.resize(ends.count());
  for (int k = 0; k < ends.count(); ++k) {
    const int i = which[static_cast<size_t>(k)];
    for (int c = 0; c < from.channelCount(); ++c) ends.channel(c)[k] = from.channel(c)[i];
    const vec3 I = distance[i] * get(direction, i);
    ends.set3(kPx, k, get(origin, i) + I);
    ends.set3(kIx, k, I);
    out.set(k, get(color, i), opacity.x ? get(opacity, i) : vec3(1));
  }
  ShadeContext context = asking.context;
  context.answers = nullptr;  // answers belong to the points that the rays leave
  if (!run(asking.scene, asking.group, volume, context, ends, out)) return;
  for (int k = 0; k < ends.count(); ++k) {
    set(color, which[static_cast<size_t>(k)], out.color(k));
    if (opacity.x) set(opacity, which[static_cast<size_t>(k)], out.opacity(k));
  }
}

}  // namespace

void crossVolumes(Batch& batch, const TmGrid* g, TmConstVec3 origin, TmConstVec3 direction, const float* distance,
                  TmVec3 color, TmVec3 opacity) {
  for (const bool inside : {false, true}) {
    const BoundShader* volume = batch.group.volume(inside);
    if (!volume) continue;
    std::vector<int> which;
    forActive(g, [&](int i) {
      if (distance[i] < kRiInfinity && (dot(get(direction, i), get(g->Ng, i)) < 0) == inside) which.push_back(i);
    });
    if (!which.empty()) cross(batch, *volume, which, origin, direction, distance, color, opacity);
  }
}

namespace {

void crossed(void* host, const TmGrid* g, int32_t byAmount, float* distance, float* amount, float* density) {
  const Batch& batch = batchOf(host);
  const std::span<const DensityAlongRay> ways = batch.context.densities;
  forActive(g, [&](int i) {
    if (ways.empty() || !batch.points) {
      (byAmount ? distance : amount)[i] = (byAmount ? amount : distance)[i];
      density[i] = 1;
      return;
    }
    const DensityAlongRay& way = ways[static_cast<size_t>(i % batch.points->count())];  // neighbours follow the points
    const DensityAlongRay::Place place = byAmount ? way.atColumnDensity(amount[i]) : way.atDistance(distance[i]);
    distance[i] = place.distance;
    amount[i] = place.columnDensity;
    density[i] = place.density;
  });
}

}  // namespace

void addVolumeServices(TmServices& services) { services.crossed = crossed; }

bool ShadingSystem::crossVolume(ShadePoints& ends, bool inside, const ShadeContext& context, ShadedPoints& out) const {
  const BoundGroup& group = impl_->groups[static_cast<size_t>(ends.group())];
  const BoundShader* volume = group.volume(inside);
  return volume && run(*impl_, group, *volume, context, ends, out);
}

}  // namespace tomales
