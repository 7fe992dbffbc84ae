// Forks child processes from a copy of this program that was made at its start, so that the dynamic loader's work is
// done once for all of them. Threads: one caller.
#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace tomales {

/// The exit code of a child that could not begin.
constexpr int kNotBegun = 127;

/// Forks the process that the children are forked from. Call it before this process has other threads. A child calls
/// `body` and ends with the exit code that it returns. From then on orphans among the descendants of this process
/// become its children.
void openNursery(int (*body)(const std::vector<std::string>& arguments));

/// Starts a child in a folder, as leader of a process group of its own. Its standard output and error are appended to
/// the file `log`. It is a child of this process, and gets SIGKILL when this one ends in any way. Returns -1 if there
/// is no nursery (any more), or if no process can be started.
pid_t startInNursery(const std::string& folder, const std::string& log, const std::vector<std::string>& arguments);

}  // namespace tomales
