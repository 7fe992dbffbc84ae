// Private to gi: where a hemisphere needs more than one ray for each cell.
#pragma once
#include "gi/gather/hemisphere.h"

namespace tomales {

/// Least contrast of a small bright source, in means of the hemisphere.
inline constexpr float kContrast = 4;

/// Returns the cells where light changes fast: those whose neighbours differ by more than kContrast times the mean. The
/// cell's own ray counts in the mean alone, so that the estimate is nearly unbiased. Where little of the hemisphere is
/// bright some bias is left (docs/measured/choices.md). `radiance`: one ray of each cell.
std::vector<int> contrastCells(const HemisphereCells& cells, std::span<const vec3> radiance);

}  // namespace tomales
