// Files that are read by a name that a scene or a command gives. Anything but a regular file is refused before it is
// opened: a pipe without a writer would hold up its reader for ever, and most readers go back in a file. Input that is
// meant to be a stream (the RIB of a command line) is not opened here.
// Threads: any.
#pragma once
#include <filesystem>
#include <string>

namespace tomales {

/// Returns why `path` cannot be read, as words to follow "cannot be read: "; empty if it can.
std::string inputProblem(const std::filesystem::path& path);

/// Opens a file descriptor, which the caller closes. On failure it is -1, and `error` says why as inputProblem() does.
int openInput(const std::filesystem::path& path, std::string& error);

}  // namespace tomales
