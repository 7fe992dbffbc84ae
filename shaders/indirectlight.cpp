#include "shaders/indirect.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "tint", TM_ROLE_TINT);
rsl::FloatParam samples("samples", 600, "rays for each irradiance sample", TM_ROLE_SAMPLES);
rsl::FloatParam maxerror("maxerror", 1, "scale of the error that interpolation may have; 0 computes every point",
                         TM_ROLE_MAX_ERROR);
rsl::StringParam errorfunction("errorfunction", "screen",
                               "screen, ward, hessian; split and plain: ward and screen as published, to compare with",
                               TM_ROLE_ERROR_FUNCTION);
rsl::StringParam radiance("radiance", "shader",
                          "what a gather ray sees: shader, radiosity, atlas, points or progressive",
                          TM_ROLE_HIT_RADIANCE);
rsl::StringParam atlas("atlas", "", "directory of brick maps; of radiance \"points\" one of point clouds",
                       TM_ROLE_ATLAS);
rsl::FloatParam bounces("bounces", 1, "diffuse bounces accounted for", TM_ROLE_BOUNCES);
rsl::FloatParam maxdist("maxdist", 1e30f, "length of gather rays", TM_ROLE_MAX_DISTANCE);
rsl::StringParam subset("subset", "", "objects that gather rays see", TM_ROLE_SUBSET);

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const Indirect indirect(b);
  for (int i : b) indirect.emit(b, i, intensity(g, i) * lightcolor(g, i) * indirect.E[i]);
}
}  // namespace

extern const rsl::Shader indirectlightShader;
const rsl::Shader indirectlightShader(TM_LIGHT, "indirectlight", "diffuse light from other surfaces (docs/gi.md)",
                                      TM_LIGHT_INDIRECT, shade,
                                      {&intensity, &lightcolor, &samples, &maxerror, &errorfunction, &radiance, &atlas,
                                       &bounces, &maxdist, &subset});
