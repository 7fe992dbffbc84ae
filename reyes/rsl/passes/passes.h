// The passes over code between lowering and running, in this order. Each keeps what the code means; `tomales compile
// --dump code` shows their result, --dump lowered their input.
#pragma once
#include "reyes/rsl/code.h"
#include "reyes/rsl/source.h"

namespace tomales::compiler {

/// Tells whether a surface assigns P.
bool movesPoints(const Code& lowered);
/// Returns the part of such a surface that moves the points, as a displacement with the same parameters.
Code displacementOf(const Code& lowered);
/// Makes it the surface for points that displacementOf() has moved: nobody sees what it assigns to P.
void leavePoints(Code& lowered);

/// Returns the part of a shader that finds the value of one parameter, by its default or what is given.
Code defaultOf(const Code& lowered, size_t parameter);

/// Finds for each register whether it varies over the batch, and for each instruction whether all points are active
/// there. `varying[k]` is true if a primitive variable gives parameter k.
void inferDetail(Code& code, const std::vector<bool>& varying);

/// Warns of doubtful things in lowered code, before anything is folded away: a variable that is declared `uniform` and
/// has to vary, or a text whose choice varies.
void warnOfDetail(const Code& lowered, const std::vector<bool>& varying, Messages& messages);

/// Turns pure instructions on constants into constants, with the same bits, since the kernels that would run them
/// compute them. x * 1, x + 0 and the like become x. Returns the register that now holds the value of `of`.
int32_t foldConstants(Code& code, int32_t of = -1);

/// Removes a pure instruction that has been done for the same values before.
void shareExpressions(Code& code);

/// Turns steps of computed values into code (forward differentiation): the change of a product is computed from the
/// changes of its factors. Steps remain for what the host knows: globals and parameters. Displacements keep theirs,
/// since the host differences their grid. Call it after inferDetail().
void deriveSteps(Code& code);

/// Removes instructions whose results nobody reads, and stores that others overwrite. A value that is computed to be
/// stored in a variable is computed there.
void removeUnused(Code& code);

/// Finds in the code the capabilities (TmCapability) of the shader.
void findCapabilities(Code& code);

/// Gives registers their slots: those whose lives do not overlap may share one.
void allocateSlots(Code& code);

/// Runs all passes.
void optimise(Code& code, const std::vector<bool>& varying, Messages& messages);

}  // namespace tomales::compiler
