// Runs compiled shaders on batches of points.
// Control: a mask says which points are active. If and loops with a condition that varies narrow it, and their blocks
// are skipped where it is empty; Leave takes points out until its Scope or Loop ends. Pure instructions run over all
// points, whatever the mask; Copy, SetElement and services obey it.
// Variables that nothing has written yet are 0, and so is what a service leaves of a temporary where points are not
// active. Threads: a Program is constant, and run() may be called by many at once; memory is the thread's, and kept by
// it.
#pragma once
#include "reyes/rsl/machine/program.h"
#include "reyes/rsl_host.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {

/// Limits the turns of all loops of one run, over its whole batch. More turns are reported as an endless loop, and the
/// batch gets the values that the shader has computed until then. 0 means no limit. The default ends after seconds, not
/// hours.
void setLoopLimit(int64_t iterations);

/// `grid.params` are those of code.parameters, in their order, and grid.count must be greater than 0. Problems are
/// reported by TmServices::report. Loops end when the process is to stop (reyes/base/stop.h). For active points the
/// grid gets wanted outputs, and of
///   a surface           Ci and Oi
///   a volume or imager  those of Ci, Oi and alpha that it assigns
///   a displacement      those of P and N that it assigns
///   a light             those of L and Cl that it assigns
void run(const Program& program, const TmGrid& grid);

/// Runs the code of a default (defaultOf() in passes/passes.h) of parameter number `parameter`. The grid gets nothing.
RslValue valueOf(const Program& program, const TmGrid& grid, int32_t parameter);

}  // namespace tomales::compiler
