// Shaders that run over colours: atmosphere over points, imager over pixels. One that throws changes nothing.
#include "reyes/shade/batch.h"
#include "reyes/shade/system.h"

namespace tomales {

void ShadingSystem::atmosphere(const ShadePoints& points, ShadedPoints& out, const ShadeContext& seen) const {
  const BoundGroup& group = impl_->groups[static_cast<size_t>(points.group())];
  if (!group.atmosphere) return;
  const ShaderTimer timer(impl_->stats, *group.atmosphere, points.count());
  ShadeContext context;
  context.lights = seen.lights;
  const ShadedPoints before = out;
  ShadePoints through = points;
  // The air is crossed from the eye to the point, also where rays are parallel and kI has no length of its own.
  for (int i = 0; i < through.count() && !impl_->camera.perspective(); ++i)
    through.set3(kIx, i, vec3(0, 0, through.channel(kPz)[i]));
  const auto run = [&](ShadedPoints& colors) {
    ArenaLease arena;
    Batch batch(*impl_, group, context, *arena);
    batch.setPoints(through, *group.atmosphere, {}, colors, 0);
    if (!batch.run(*group.atmosphere, batch.tm)) return false;
    batch.blackOutNonFinite(*group.atmosphere);
    return true;
  };
  if (!run(out)) {
    out = before;
    return;
  }
  const auto transparent = [](const AlignedVector<float>& o, int n) {
    return std::any_of(o.begin(), o.begin() + n, [](float x) { return x < 1; });
  };
  if (std::none_of(std::begin(before.Oi), std::end(before.Oi),
                   [&](const auto& o) { return transparent(o, points.count()); }))
    return;
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
