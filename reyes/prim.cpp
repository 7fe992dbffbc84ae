#include "reyes/prim.h"

#include <numeric>

namespace tomales {

int offsetOf(const std::vector<Primvar>& primvars, std::string_view name) {
  int offset = 0;
  for (const Primvar& p : primvars) {
    if (p.name == name) return offset;
    offset += p.width;
  }
  return -1;
}

int floatsOfPoint(const std::vector<Primvar>& primvars) {
  return std::accumulate(primvars.begin(), primvars.end(), 0, [](int sum, const Primvar& p) { return sum + p.width; });
}

size_t Prim::bytes() const {
  size_t bytes = sizeof(*this) + shapeBytes();
  for (const Primvar& p : primvars_) bytes += sizeof(p) + p.values.capacity() * sizeof(float);
  return bytes;
}

void Prim::surfaceParameters(uint32_t, int n, const float* u, const float* v, float* su, float* sv) const {
  std::copy_n(u, n, su);
  std::copy_n(v, n, sv);
}

}  // namespace tomales
