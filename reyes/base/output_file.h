// Files that are written under a name that a command or a cache gives.
#pragma once
#include <string>

namespace tomales {

/// Writes a text to a temporary name beside `path`, then renames; what is no regular file (a pipe, /dev/stdout) takes
/// the text itself. Returns why that failed; empty: it is done. A failure leaves what was there before.
std::string writeAtOnce(const std::string& path, const std::string& text);

}  // namespace tomales
