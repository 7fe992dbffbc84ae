// Shadow maps for lights: parameters, and the share of light that the maps let through. Here `raytrace` and maps that
// cannot be read let all light through; the renderer traces those shadows.
#pragma once
#include "reyes/shader.h"

struct ShadowParams {
  rsl::StringParam shadowname{"shadowname", "", "shadow map, or `raytrace`", TM_ROLE_SHADOW_MAP};
  rsl::UniformFloatParam samples{"samples", 16, "lookups in the map for each point"};
  rsl::UniformFloatParam blur{"blur", 0, "softness, as a fraction of the map"};
  rsl::UniformFloatParam width{"width", 1, "scale of the region that is looked up"};
  rsl::UniformFloatParam shadowbias{
      "shadowbias", -1, "depth that an occluder must be nearer by; negative: Option \"shadow\" \"bias\", or as needed"};

  /// Dims Cl of the batch by one map.
  void dim(const rsl::Batch& b, const char* map) const {
    const TmGrid* g = b.g;
    if (*map == '\0') return;
    TmShadowOptions options = tmShadowDefaults();
    options.bias = shadowbias(g);
    options.blur = blur(g);
    options.width = width(g);
    options.samples = static_cast<int32_t>(samples(g));
    rsl::Vec3Array shadow(g);
    g->call->shadow(g->host, g, map, &options, rsl::view(g->P), shadow);
    for (int i : b) rsl::set(g->Cl, i, rsl::get(g->Cl, i) * (rsl::Color{1, 1, 1} - shadow[i]));
  }
};
