#include "reyes/shade/substitute.h"

#include <cmath>

#include "reyes/shader/params.h"

namespace tomales {
namespace {

void shadeSubstitute(const TmGrid* g) {
  for (int i = 0; i < g->count; ++i) {
    if (!g->active[i]) continue;
    const float parity = std::fmod(std::floor(g->u[i] * 8) + std::floor(g->v[i] * 8), 2.0f);
    const float bright = parity == 0.0f ? 1.0f : 0.1f;
    g->Ci.x[i] = bright;
    g->Ci.y[i] = 0;
    g->Ci.z[i] = bright;
    g->Oi.x[i] = g->Oi.y[i] = g->Oi.z[i] = 1;
  }
}

}  // namespace

const TmShader& substituteSurface() {
  static const rsl::Shader shader(TM_SURFACE, "(missing shader)", "stands in for a missing surface shader", 0,
                                  shadeSubstitute, {});
  return *shader;
}

}  // namespace tomales
