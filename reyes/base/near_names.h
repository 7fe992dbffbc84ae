// Names that a misspelt name may have meant.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tomales {

/// Returns the names of `known` that `wanted` may be a misspelling of, the nearest first, at most `most`. Names that
/// differ in capitals alone are the nearest.
std::vector<std::string> nearNames(std::string_view wanted, const std::vector<std::string>& known, size_t most = 1);

/// Returns the end of a message about an unknown name: "; did you mean \"plastic\"?", or nothing.
std::string didYouMean(std::string_view wanted, const std::vector<std::string>& known);

}  // namespace tomales
