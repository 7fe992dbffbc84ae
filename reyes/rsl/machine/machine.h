// Runs compiled shaders on batches of points.
// Control: a mask says which points are active. If and loops with a condition that varies narrow it, and their blocks
// are skipped where it is empty; Leave takes points out until its Scope or Loop ends. Pure instructions run over all
// points, whatever the mask; Copy, SetElement and services obey it.
// Variables that nothing has written yet are 0, and so is what a service leaves of a temporary where points are not
// active. Threads: a Program is constant, and run() may be called by many at once; memory is the thread's, and kept by
// it.
#pragma once
#include "reyes/rsl/machine/program.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {

/// The default of a parameter with Parameter::computed: that value, which RIB cannot give, says "nothing was given". It
/// is not a number, so x != x tells it, also after a transformation to current space.
float notGiven();
bool isNotGiven(float value);

/// Iterations of all loops of one run, over its whole batch; more is an endless loop, which is reported, and the batch
/// gets what the shader had so far. 0: no limit. The default ends after seconds, not hours.
void setLoopLimit(int64_t iterations);

/// `grid.params` are those of code.parameters, in their order. Stored in the grid for active points: Ci and Oi of a
/// surface; what the shader assigns of Ci, Oi and alpha of a volume or imager, of P and N of a displacement, of L and
/// Cl of a light; outputs where they are wanted. What goes wrong is told by TmServices::report. When the process is to
/// stop (reyes/base/stop.h), loops end.
/// Pre: grid.count > 0.
void run(const Program& program, const TmGrid& grid);

}  // namespace tomales::compiler
