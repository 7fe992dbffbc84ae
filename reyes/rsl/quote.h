// Shows words of strangers' files in messages.
#pragma once
#include <string>
#include <string_view>

namespace tomales::compiler {

/// Returns 'text', shortened and without bytes that a terminal would obey.
std::string inQuotes(std::string_view text);

}  // namespace tomales::compiler
