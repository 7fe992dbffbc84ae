#include "reyes/rsl/passes/passes.h"

namespace tomales::compiler {

void optimise(Code& code, const std::vector<bool>& varying, Messages& messages) {
  warnOfDetail(code, varying, messages);
  foldConstants(code);
  removeUnused(code);
  inferDetail(code, varying);
  deriveSteps(code);
  foldConstants(code);
  shareExpressions(code);
  removeUnused(code);
  findCapabilities(code);
  allocateSlots(code);
}

}  // namespace tomales::compiler
