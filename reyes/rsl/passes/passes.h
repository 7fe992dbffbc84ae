// The passes over code between lowering and running, in this order. No pass changes the meaning of the code. `tomales
// compile --dump code` shows their result, and --dump lowered their input.
#pragma once
#include "reyes/rsl/code.h"
#include "reyes/rsl/source.h"

namespace tomales::compiler {

/// Tells whether a surface assigns P.
bool movesPoints(const Code& lowered);
/// Returns the part of such a surface that moves the points, as a displacement with the same parameters.
Code displacementOf(const Code& lowered);
/// Makes it the surface for points that displacementOf() has moved: its own assignments to P have no effect.
void leavePoints(Code& lowered);

/// Returns the part of a shader that computes the value of one parameter, from its default or the given value.
Code defaultOf(const Code& lowered, size_t parameter);

/// Returns the part of a light that computes Code::cone, as the value of one more parameter, which is given as 0. With
/// `ofAllBranches`, both sides of each condition count. Pre: there is such a register.
Code coneOf(const Code& lowered, bool ofAllBranches);

/// Finds for each register whether it varies over the batch, and for each instruction whether all points are active
/// there. `varying[k]` is true if a primitive variable gives parameter k.
void inferDetail(Code& code, const std::vector<bool>& varying);

/// Warns of doubtful code, as lowered, before parts of it are folded away: a variable that is declared `uniform` but
/// has to vary, or a text that depends on a varying condition.
void warnOfDetail(const Code& lowered, const std::vector<bool>& varying, Messages& messages);

/// Replaces pure instructions on constants by constants. The same kernels compute them, so the bits are the same. x *
/// 1, x + 0 and the like become x. Returns the register that now holds the value of `of`.
int32_t foldConstants(Code& code, int32_t of = -1);

/// Removes a pure instruction that repeats an earlier one on the same values.
void shareExpressions(Code& code);

/// Turns steps of computed values into code (forward differentiation): the change of a product is computed from the
/// changes of its factors. Steps of globals and parameters remain, because the host knows these. Displacements keep
/// their steps, because the host takes differences on their grid. Call it after inferDetail().
void deriveSteps(Code& code);

/// Removes instructions whose results are not read, and stores that are overwritten. A value that is computed only to
/// be stored in a variable is computed there.
void removeUnused(Code& code);

/// Finds the capabilities (TmCapability) of the shader from its code.
void findCapabilities(Code& code);

/// Gives registers their slots. Registers with disjoint lifetimes may share one.
void allocateSlots(Code& code);

/// Runs all passes.
void optimise(Code& code, const std::vector<bool>& varying, Messages& messages);

}  // namespace tomales::compiler
