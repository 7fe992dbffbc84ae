#include "tests/bench/rsl/loops.h"
#include "tests/bench/rsl/scalar_numbers.h"

namespace tomales::bench {
namespace fused {

#include "tests/bench/rsl/loops/common.h"
#include "tests/bench/rsl/loops/control.h"
#include "tests/bench/rsl/loops/light.h"
#include "tests/bench/rsl/loops/patterns.h"
#include "tests/bench/rsl/loops/table.h"

}  // namespace fused

std::span<const Loop> fusedLoops() { return fused::kLoops; }

}  // namespace tomales::bench
