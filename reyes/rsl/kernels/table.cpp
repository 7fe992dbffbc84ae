#include "reyes/rsl/kernels/points.h"

namespace tomales::compiler {

namespace {

constexpr bool isKernel(std::string_view traits) { return traits.find('K') != std::string_view::npos; }

}  // namespace

Kernel kernelOf(Op op) {
  switch (op) {
    // The generic functions of `if constexpr` need not be defined for operations that they do not take.
#define RSL_OP(name, signature, traits) \
  case Op::name:                        \
    return [](auto wanted) -> Kernel {  \
      if constexpr (wanted)             \
        return &kernels::name;          \
      else                              \
        return nullptr;                 \
    }(std::bool_constant<isKernel(traits)>());
    RSL_OPS(RSL_OP)
#undef RSL_OP
  }
  return nullptr;
}

}  // namespace tomales::compiler
