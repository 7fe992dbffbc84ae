// Shows words of untrusted files in messages.
#pragma once
#include <string>
#include <string_view>

namespace tomales::compiler {

/// Returns 'text', shortened and without control characters for terminals.
std::string inQuotes(std::string_view text);

}  // namespace tomales::compiler
