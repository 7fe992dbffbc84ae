// Shaders that run over colours: atmosphere over points, imager over pixels. One that throws changes nothing.
#include "reyes/shade/batch.h"
#include "reyes/shade/system.h"

namespace tomales {

void ShadingSystem::atmosphere(const ShadePoints& points, ShadedPoints& out) const {
  const BoundGroup& group = impl_->groups[static_cast<size_t>(points.group())];
  if (!group.atmosphere) return;
  const ShaderTimer timer(impl_->stats, *group.atmosphere, points.count());
  const ShadeContext context;
  const ShadedPoints before = out;
  ShadePoints seen = points;
  // Air is crossed from the eye to the point, also where rays are parallel and kI has no length of its own.
  for (int i = 0; i < seen.count() && !impl_->camera.perspective(); ++i)
    seen.set3(kIx, i, vec3(0, 0, seen.channel(kPz)[i]));
  ArenaLease arena;
  Batch batch(*impl_, group, context, *arena);
  batch.setPoints(seen, *group.atmosphere, {}, out, 0);
  if (batch.run(*group.atmosphere, batch.tm))
    batch.blackOutNonFinite(*group.atmosphere);
  else
    out = before;
}

bool ShadingSystem::hasImager() const { return impl_->imager != nullptr; }

void ShadingSystem::image(ShadedPixels& pixels) const {
  if (!hasImager()) return;
  const ShaderTimer timer(impl_->stats, *impl_->imager, static_cast<int>(pixels.alpha.size()));
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
