// Arithmetic, comparisons and the functions of RISpec 15.1 that consist of them alone.
#include "reyes/rsl/kernels/points.h"
#include "reyes/shader/shadeops.h"

namespace tomales::compiler::kernels {

#define RSL_KERNEL_1(name, expression)                                              \
  RSL_KERNEL(name) {                                                                \
    each(blocks, out, in, [](float a) RSL_INLINED -> float { return expression; }); \
  }
#define RSL_KERNEL_2(name, expression)                                                       \
  RSL_KERNEL(name) {                                                                         \
    each(blocks, out, in, [](float a, float b) RSL_INLINED -> float { return expression; }); \
  }
#define RSL_KERNEL_3(name, expression)                                                                \
  RSL_KERNEL(name) {                                                                                  \
    each(blocks, out, in, [](float a, float b, float c) RSL_INLINED -> float { return expression; }); \
  }

RSL_KERNEL_2(Add, a + b)
RSL_KERNEL_2(Sub, a - b)
RSL_KERNEL_2(Mul, a* b)
RSL_KERNEL_2(Div, a / b)
RSL_KERNEL_1(Neg, -a)

RSL_KERNEL_2(Less, a < b ? 1.0f : 0.0f)
RSL_KERNEL_2(LessEqual, a <= b ? 1.0f : 0.0f)
RSL_KERNEL_2(Equal, a == b ? 1.0f : 0.0f)
RSL_KERNEL_2(NotEqual, a != b ? 1.0f : 0.0f)
RSL_KERNEL_2(And, (a != 0 ? 1.0f : 0.0f) * (b != 0 ? 1.0f : 0.0f))
RSL_KERNEL_2(Or, std::max(a != 0 ? 1.0f : 0.0f, b != 0 ? 1.0f : 0.0f))
RSL_KERNEL_1(Not, a == 0 ? 1.0f : 0.0f)
RSL_KERNEL_3(Select, a != 0 ? b : c)

RSL_KERNEL_2(Min, rsl::min(a, b))
RSL_KERNEL_2(Max, rsl::max(a, b))
RSL_KERNEL_3(Clamp, rsl::clamp(a, b, c))
RSL_KERNEL_3(Mix, rsl::mix(a, b, c))
RSL_KERNEL_2(Step, rsl::step(a, b))
RSL_KERNEL_3(Smoothstep, rsl::smoothstep(a, b, c))
RSL_KERNEL_3(Filterstep, rsl::filterstep(a, b, c))
RSL_KERNEL_1(Abs, std::abs(a))
RSL_KERNEL_1(Sign, rsl::sign(a))
RSL_KERNEL_1(Floor, rsl::wholeBelow(a))
RSL_KERNEL_1(Ceil, -rsl::wholeBelow(-a))
RSL_KERNEL_1(Round, rsl::wholePart(a) + std::copysign(std::abs(a - rsl::wholePart(a)) < 0.5f ? 0.0f : 1.0f, a))
// This is rsl::mod() without its branch, which GCC does not vectorise.
RSL_KERNEL_2(Mod, rsl::chosen(b == 0, 0, a - b * rsl::wholeBelow(a / b)))
RSL_KERNEL_1(Sqrt, rsl::sqrt(a))
RSL_KERNEL_1(InverseSqrt, rsl::inversesqrt(a))

}  // namespace tomales::compiler::kernels
