#include "reyes/shader.h"

namespace {
void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) b.output(i, b.Cs(i), b.Os(i));
}
}  // namespace

extern const rsl::Shader constantShader;
const rsl::Shader constantShader(TM_SURFACE, "constant", "Os Cs, no light", TM_KEEPS_OPACITY | TM_EMITS, shade, {});
