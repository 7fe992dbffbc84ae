#include "reyes/rsl/ops.h"

#include <array>

namespace tomales::compiler {
namespace {

constexpr std::array<OpInfo, kOps> kTable = {{
#define RSL_OP(name, signature, traits) {Op::name, #name, signature, traits},
    RSL_OPS(RSL_OP)
#undef RSL_OP
}};

}  // namespace

const OpInfo& info(Op op) { return kTable[static_cast<size_t>(op)]; }

}  // namespace tomales::compiler
