#include "reyes/dice/evaluated.h"

namespace tomales {

mat3 normalMatrix(const Object& o, const mat4& m) {
  const mat3 a(m);
  const mat3 cofactor(cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1]));
  return o.flipsNormal ? -cofactor : cofactor;
}

namespace {

/// Multiplies primitive variables that are matrices by `m` from the left.
void transformMatrices(const Primvar& p, const mat4& m, int n, float* values, int stride) {
  for (int first = 0; first + 15 < p.width; first += 16)
    for (int i = 0; i < n; ++i) {
      float* const x = values + first * stride + i;
      mat4 own;
      for (int k = 0; k < 16; ++k) own[k / 4][k % 4] = x[k * stride];
      own = m * own;
      for (int k = 0; k < 16; ++k) x[k * stride] = own[k / 4][k % 4];
    }
}

}  // namespace

void transformPrimvar(const Primvar& p, const mat4& m, const mat3& normals, int n, float* values, int stride) {
  if (p.type == ValueType::Matrix) return transformMatrices(p, m, n, values, stride);
  const bool point = p.type == ValueType::Point, vector = p.type == ValueType::Vector,
             normal = p.type == ValueType::Normal;
  if (!point && !vector && !normal) return;
  // Orientation turns the normals of the surface, and says nothing of other variables.
  const mat3 ofNormals = normal && p.name != "N" ? glm::transpose(glm::inverse(mat3(m))) : normals;
  for (int first = 0; first + 2 < p.width; first += 3)
    for (int i = 0; i < n; ++i) {
      float* x = values + first * stride + i;
      const vec3 in(x[0], x[stride], x[2 * stride]);
      const vec3 out = point ? transformPoint(m, in) : vector ? transformVector(m, in) : ofNormals * in;
      x[0] = out.x;
      x[stride] = out.y;
      x[2 * stride] = out.z;
    }
}

}  // namespace tomales
