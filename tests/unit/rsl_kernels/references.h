// What every kernel should give at one point.
#pragma once
#include <functional>
#include <map>

#include "kernel_run.h"

namespace tomales::compiler {

struct Reference {
  std::function<void(const float* in, float* out)> of;  ///< The floats of all arguments after each other.
  int ulps = 0;                                         ///< 0: the same bits.
};
const std::map<Op, Reference>& references();

}  // namespace tomales::compiler
