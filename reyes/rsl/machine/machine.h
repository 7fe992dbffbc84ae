// Runs compiled shaders on batches of points.
// Control: a mask says which points are active. An If or loop whose condition varies narrows it, and a block is skipped
// if it is empty there; Leave makes points inactive until its Scope or Loop ends. Pure instructions run over all
// points, whatever the mask; Copy, SetElement and services obey it. Variables are 0 until they are written. So are a
// service's results in temporaries at inactive points. Threads: a Program is constant, and any number of threads may
// call run(); each keeps its own memory.
#pragma once
#include "reyes/rsl/machine/program.h"
#include "reyes/rsl_host.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {

/// Limits the iterations of all loops of one run, over its whole batch. More are reported as an endless loop, and the
/// batch gets the values that the shader has computed until then. 0 means no limit. With the default such a run ends
/// after seconds.
void setLoopLimit(int64_t iterations);

/// `grid.params` has the values of code.parameters, in their order, and grid.count must be greater than 0. Problems are
/// reported by TmServices::report. Loops end when the process is to stop (reyes/base/stop.h). For active points the
/// grid gets wanted outputs, and of
///   a surface           Ci and Oi
///   a volume or imager  those of Ci, Oi and alpha that it assigns
///   a displacement      those of P and N that it assigns
///   a light             those of L and Cl that it assigns
void run(const Program& program, const TmGrid& grid);

/// Runs the code of a default (defaultOf() in passes/passes.h), that of parameter number `parameter`, and returns its
/// value. The grid gets no results.
RslValue valueOf(const Program& program, const TmGrid& grid, int32_t parameter);

}  // namespace tomales::compiler
