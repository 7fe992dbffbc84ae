/* A light of ABI 1 in plain C: parallel light, as bright as its parameter says. */
#include <reyes/shader_api.h>

static const float kOne[3] = {1, 1, 1}, kAxis[3] = {0, 0, 1};

static void shade(const TmGrid* g) {
  const TmValue *power = &g->params[0], *color = &g->params[1], *axis = &g->params[2];
  int i;
  if (g->structBytes < sizeof(TmGrid) || g->call->abi != TM_SHADER_ABI) {
    g->call->report(g->host, g, TM_MISSING, "is run by a renderer that knows less than ABI 1");
    return;
  }
  for (i = 0; i < g->count; ++i) {
    if (!g->active[i]) continue;
    g->L.x[i] = -axis->c[0][i * axis->step];
    g->L.y[i] = -axis->c[1][i * axis->step];
    g->L.z[i] = -axis->c[2][i * axis->step];
    g->Cl.x[i] = power->c[0][i * power->step] * color->c[0][i * color->step];
    g->Cl.y[i] = power->c[0][i * power->step] * color->c[1][i * color->step];
    g->Cl.z[i] = power->c[0][i * power->step] * color->c[2][i * color->step];
  }
}

__attribute__((visibility("default"))) const TmShaderLibrary* tomales_shaders(void);

const TmShaderLibrary* tomales_shaders(void) {
  static const TmParamDecl params[] = {
      {.name = "power", .type = TM_FLOAT, .arrayLength = 1, .floats = kOne, .doc = "scale"},
      {.name = "tint", .type = TM_COLOR, .arrayLength = 1, .floats = kOne, .doc = "colour"},
      {.name = "axis", .type = TM_VECTOR, .arrayLength = 1, .floats = kAxis, .doc = "where it shines"}};
  static const TmShader light = {.abi = TM_SHADER_ABI,
                                 .structBytes = sizeof(TmShader),
                                 .kind = TM_LIGHT,
                                 .capabilities = TM_LIGHT_SOLAR,
                                 .paramCount = 3,
                                 .paramBytes = sizeof(TmParamDecl),
                                 .params = params,
                                 .shade = shade,
                                 .name = "frozen_light",
                                 .doc = "of ABI 1"};
  static const TmShader* const shaders[] = {&light};
  static const TmShaderLibrary library = {
      .abi = TM_SHADER_ABI, .structBytes = sizeof(TmShaderLibrary), .shaders = shaders, .count = 1};
  return &library;
}
