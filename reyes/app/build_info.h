// The sources and compiler that the program was built from.
#pragma once
#include <string>

namespace tomales {

extern const char* const kVersion;  ///< The version in CMakeLists.txt: "1.0.0".

/// Returns the commit of the sources, as git names it, with " with changes" behind it if they had been changed since;
/// "unknown" if they were in no repository.
const char* sourceCommit();

/// Returns the text of --version: version, commit, compiler, and a line for each library with its version and licence.
std::string describeBuild();

}  // namespace tomales
