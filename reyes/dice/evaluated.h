// The parts that lattices and single points share: evaluation of primitives at a time, and transformation to current
// space.
#pragma once
#include "reyes/dice.h"

namespace tomales {

template <class T>
struct Triple {
  T *x, *y, *z;
};

/// Object-space results of Prim::evaluate for n points. Each thread reuses their memory.
class Evaluated {
 public:
  /// The first of the three arrays of each result, in the order of SurfacePoints.
  static constexpr size_t kP = 0, kDpdu = 3, kDpdv = 6, kN = 9, kArrays = 12;

  explicit Evaluated(int n) : stride_(n == 1 ? 1 : static_cast<size_t>(padded(n))) {
    if (n > 1) {
      many_.swap(spare());
      many_.resize(std::max(many_.size(), stride_ * kArrays));
    }
    data_ = n > 1 ? many_.data() : one_;
  }
  ~Evaluated() {
    if (many_.size() > spare().size()) many_.swap(spare());
  }
  Evaluated(const Evaluated&) = delete;
  /// Returns the results from point `first` on.
  SurfacePoints view(int first = 0) {
    const auto a = [this, first](size_t i) { return data_ + i * stride_ + first; };
    return {a(0), a(1), a(2), a(3), a(4), a(5), a(6), a(7), a(8), a(9), a(10), a(11)};
  }
  /// Returns a result, kP to kN, at point i.
  vec3 get(size_t result, int i) const {
    const float* x = data_ + result * stride_ + i;
    return {x[0], x[stride_], x[2 * stride_]};
  }
  /// Returns the arrays of a result.
  Triple<const float> triple(size_t result) const {
    const float* x = data_ + result * stride_;
    return {x, x + stride_, x + 2 * stride_};
  }
  /// Moves all results by the share t towards those of `next`.
  void blend(const Evaluated& next, float t) {
    for (size_t i = 0; i < stride_ * kArrays; ++i) data_[i] = lerp(data_[i], next.data_[i], t);
  }

 private:
  /// Returns the memory that a thread keeps from grid to grid.
  static AlignedVector<float>& spare() {
    static thread_local AlignedVector<float> memory;
    return memory;
  }

  size_t stride_;
  float one_[kArrays] = {};
  AlignedVector<float> many_;
  float* data_;
};

/// Evaluates a deforming object at `time`. evaluate(prim, out) fills n points of `out`.
template <class Evaluate>
void evaluateAt(const Object& o, float time, int n, Evaluated& out, const Evaluate& evaluate) {
  const ShapesAround shapes = o.shapesAround(time);
  evaluate(*shapes.before, out);
  if (!shapes.after) return;
  Evaluated next(n);
  evaluate(*shapes.after, next);
  out.blend(next, shapes.t);
}

/// Returns the matrix that transforms normals: the cofactors of m, negated if the object flips its normals. Cofactors
/// are right at any scale. Under a mirror they change sides, as the cross product of transformed derivatives does.
mat3 normalMatrix(const Object& o, const mat4& m);
/// Transforms a primitive variable from object space to current space. `normals` is for N alone; others of type normal
/// are transformed as parameters of shaders are.
void transformPrimvar(const Primvar& p, const mat4& m, const mat3& normals, int n, float* values, int stride);

}  // namespace tomales
