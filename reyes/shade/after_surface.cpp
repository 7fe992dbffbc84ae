// Shaders that run over colours: atmosphere over points, imager over pixels. One that throws changes nothing.
#include "reyes/shade/batch.h"
#include "reyes/shade/system.h"

namespace tomales {

namespace {

/// Composites the light and opacity of Volumes over colours.
void layOver(const ShadedPoints& volumes, ShadedPoints& colors) {
  for (int k = 0; k < 3; ++k)
    for (size_t i = 0; i < colors.Ci[k].size(); ++i) {
      const float passes = 1 - volumes.Oi[k][i];
      colors.Ci[k][i] = volumes.Ci[k][i] + passes * colors.Ci[k][i];
      colors.Oi[k][i] = 1 - passes * (1 - colors.Oi[k][i]);
    }
}

bool transparent(const ShadedPoints& colors, int count) {
  return std::any_of(std::begin(colors.Oi), std::end(colors.Oi), [&](const AlignedVector<float>& o) {
    return std::any_of(o.begin(), o.begin() + count, [](float x) { return x < 1; });
  });
}

}  // namespace

// Volumes lie behind the atmosphere.
void ShadingSystem::atmosphere(const ShadePoints& points, ShadedPoints& out, const ShadeContext& seen) const {
  const BoundGroup& group = impl_->groups[static_cast<size_t>(points.group())];
  if (!group.atmosphere && !impl_->hasVolumes) return;
  const ShadedPoints before = out;
  ShadePoints through = points;
  // The air is crossed from the eye to the point, also if rays are parallel, where kI does not have this length.
  for (int i = 0; i < through.count() && !impl_->camera.perspective(); ++i)
    through.set3(kIx, i, vec3(0, 0, through.channel(kPz)[i]));
  ShadedPoints volumes;
  const bool crossesVolumes =
      impl_->hasVolumes && impl_->services && impl_->services->volumesBefore(through, seen, volumes);
  if (!group.atmosphere && !crossesVolumes) return;
  const auto run = [&](ShadedPoints& colors) {
    if (crossesVolumes) layOver(volumes, colors);
    if (!group.atmosphere) return true;
    const ShaderTimer timer(impl_->stats, *group.atmosphere, points.count());
    ShadeContext context;
    context.onlyLightGroup = seen.onlyLightGroup;
    ArenaLease arena;
    Batch batch(*impl_, group, context, *arena);
    batch.setPoints(through, *group.atmosphere, colors, 0);
    batch.ofSurface = &before;
    if (!batch.run(*group.atmosphere, batch.tm)) return false;
    batch.blackOutNonFinite(*group.atmosphere);
    return true;
  };
  if (!run(out)) {
    out = before;
    return;
  }
  if (!transparent(before, points.count())) return;
  ShadedPoints air;
  air.resize(points.count());
  if (!run(air)) return;
  for (int k = 0; k < 3; ++k) {
    out.airCi[k] = std::move(air.Ci[k]);
    out.airOi[k] = std::move(air.Oi[k]);
    for (size_t i = 0; i < out.airCi[k].size(); ++i) {
      out.airCi[k][i] *= 1 - before.Oi[k][i];
      out.airOi[k][i] *= 1 - before.Oi[k][i];
    }
  }
}

bool ShadingSystem::hasImager() const { return impl_->imager != nullptr; }

void ShadingSystem::image(ShadedPixels& pixels) const {
  if (!hasImager()) return;
  const ShaderTimer timer(impl_->stats, *impl_->imager, pixels.count);
  const ShadeContext context;
  const ShadedPixels before = pixels;
  ArenaLease arena;
  Batch batch(*impl_, impl_->pixels, context, *arena);
  batch.setPixels(pixels, *impl_->imager);
  if (batch.run(*impl_->imager, batch.tm))
    batch.blackOutNonFinite(*impl_->imager);
  else
    pixels = before;
}

}  // namespace tomales
