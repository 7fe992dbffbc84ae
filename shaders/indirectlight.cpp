#include "shaders/indirect.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale");
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "tint");
rsl::FloatParam samples("samples", 600, "rays for each irradiance sample");
rsl::FloatParam maxerror("maxerror", 1, "kappa of the error function; 0 computes every point");
rsl::StringParam errorfunction("errorfunction", "screen",
                               "screen, ward, hessian; split and plain: ward and screen as published, to compare with");
rsl::StringParam radiance("radiance", "shader", "what a gather ray sees: shader, radiosity, atlas or points");
rsl::StringParam atlas("atlas", "", "directory of brick maps");
rsl::FloatParam bounces("bounces", 1, "diffuse bounces accounted for");
rsl::FloatParam maxdist("maxdist", 1e30f, "length of gather rays");
rsl::StringParam subset("subset", "", "objects that gather rays see");

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
