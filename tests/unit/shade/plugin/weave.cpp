// A plugin for tests: two shaders, and functions for shaders of RSL, one of which has no prototype that can be called.
#include "reyes/shader.h"
#include "reyes/shader/functions.h"

namespace {

void shade(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    rsl::set(g->Ci, i, {0.25f, 0.5f, 0.75f});
    rsl::set(g->Oi, i, {1, 1, 1});
  }
}
void nothing(const TmGrid*) {}
const rsl::Shader weave(TM_SURFACE, "weave", "", 0, shade, {});
const rsl::Shader bend(TM_DISPLACEMENT, "bend", "", 0, nothing, {});

void twice(const TmFunctionCall* call) {
  const TmValue &out = call->args[0], &in = call->args[1];
  for (int32_t i = 0; i < call->count; ++i)
    if (call->active[i]) const_cast<float*>(out.c[0])[i] = 2 * in.c[0][i * in.step];
}

const TmFunction functions[] = {
    {"float twice(float)", "", twice}, {"matrix broken(float)", "", twice}, {"color twice(color)", "", twice}};
const TmFunctionLibrary library = {TM_SHADER_ABI, sizeof library, functions, 3, sizeof(TmFunction)};

}  // namespace

TM_SHADER_LIBRARY(weave, bend)

extern "C" __attribute__((visibility("default"))) const TmFunctionLibrary* tomales_functions(void) { return &library; }
