// Object File Format (.off) as Assimp 5.2 reads it. Threads: plain function.
#pragma once
#include <string>

namespace tomales::model {

/// Returns the text with colours of vertices as four floats from 0 to 1: Assimp takes integers up to 255 for floats,
/// and does not read colours of fewer than four numbers. A text without such colours is returned as it is.
std::string plainOff(std::string text);

}  // namespace tomales::model
