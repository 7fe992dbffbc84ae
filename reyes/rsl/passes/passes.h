// What is done to code between lowering and running, in this order. Each pass keeps what the code means; `tomales
// compile --dump code` shows their result, --dump lowered what they start from.
#pragma once
#include "reyes/rsl/code.h"
#include "reyes/rsl/source.h"

namespace tomales::compiler {

/// Does a surface assign P?
bool movesPoints(const Code& lowered);
/// What of such a surface moves the points, as a displacement with the same parameters.
Code displacementOf(const Code& lowered);
/// The surface for points that displacementOf() has moved: what it assigns to P is not seen.
void leavePoints(Code& lowered);

/// Says for each register whether it varies over the batch, and for each instruction whether all points are active
/// there. `varying[k]`: parameter k is given by a primitive variable.
void inferDetail(Code& code, const std::vector<bool>& varying);

/// What is doubtful of lowered code, before anything is folded away: a variable that is declared `uniform` and has to
/// vary, a text that is chosen by what varies.
void warnOfDetail(const Code& lowered, const std::vector<bool>& varying, Messages& messages);

/// Pure instructions on constants become constants, by the kernels that would run them: the same bits. x * 1, x + 0
/// and the like become x. Returns the register that holds what `of` held (for a value that is looked at from outside).
int32_t foldConstants(Code& code, int32_t of = -1);

/// A pure instruction that has been done for the same values before is not done again.
void shareExpressions(Code& code);

/// Steps of computed values become code (forward differentiation): the change of a product is computed from the changes
/// of its factors. Steps are left on what the host knows: globals and parameters. Displacements keep theirs: the host
/// differences their grid. After inferDetail.
void deriveSteps(Code& code);

/// Instructions whose results nobody reads, and stores that are stored over, are left out; a value that is computed to
/// be stored in a variable is computed there.
void removeUnused(Code& code);

/// What the host wants to know of the shader (TmCapability), found in its code.
void findCapabilities(Code& code);

/// Gives registers their slots: those whose lives do not overlap may share one.
void allocateSlots(Code& code);

/// All of them.
void optimise(Code& code, const std::vector<bool>& varying, Messages& messages);

}  // namespace tomales::compiler
