// The headers that come with the renderer (shaders/include), for shaders whose own headers are missing. They are built
// into the program.
#pragma once
#include <string_view>
#include <vector>

namespace tomales::compiler {

/// Returns the header's text; empty if there is none of this name.
std::string_view standardHeader(std::string_view name);
std::vector<std::string_view> standardHeaderNames();

}  // namespace tomales::compiler
