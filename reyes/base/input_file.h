// Files that are read by a name that a scene or a command gives. What is no regular file is refused before it is
// opened: a pipe without a writer would hold up its reader for ever, and most readers come back to what they have read.
// What is meant to be a stream (the RIB of a command line) does not come here.
// Threads: any.
#pragma once
#include <filesystem>
#include <string>

namespace tomales {

/// Why `path` is no file that can be read, to follow "cannot be read: "; empty: it is one.
std::string inputProblem(const std::filesystem::path& path);

/// A file descriptor, the caller's to close. -1: `error` says why, as inputProblem() does.
int openInput(const std::filesystem::path& path, std::string& error);

}  // namespace tomales
