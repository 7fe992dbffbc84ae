// Runs compiled shaders on batches of points.
// Control: a mask says which points are active. If and loops with a condition that varies narrow it, and their blocks
// are skipped where it is empty; Leave takes points out until its Scope or Loop ends. Pure instructions run over all
// points, whatever the mask; Copy, SetElement and services obey it.
// Threads: run() may be called by many at once; memory is the thread's, and kept by it.
#pragma once
#include <string>

#include "reyes/rsl/code.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {

/// The default of a parameter with Parameter::computed: that value, which RIB cannot give, says "nothing was given".
float notGiven();
bool isNotGiven(float value);

/// Iterations of all loops of one run, over its whole batch; more is an endless loop, which is reported, and the batch
/// gets what the shader had so far. 0: no limit. The default ends after seconds, not hours.
void setLoopLimit(int64_t iterations);

/// `grid.params` are those of code.parameters, in their order. Globals that the shader has assigned are stored in the
/// grid for active points: Ci and Oi of a surface, volume and imager (alpha too), P and N of a displacement, L and Cl
/// of a light; outputs where they are wanted. What goes wrong is told by TmServices::report.
/// Pre: grid.count > 0; code has been through all passes.
void run(const Code& code, const TmGrid& grid);

}  // namespace tomales::compiler
