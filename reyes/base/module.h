// Parts of the program that are loaded when something is first asked of them.
#pragma once
#include <string>

namespace tomales {

/// Loads the module of this file name, which is never closed, and returns its function. Returns null on failure, and
/// `error` says why.
void* moduleFunction(const char* file, const char* function, std::string& error);

}  // namespace tomales
