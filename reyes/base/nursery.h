// Child processes that go on from the first moment of this program instead of starting it anew: what the loader does is
// done once for all of them. Threads: one caller.
#pragma once
#include <sys/types.h>

#include <string>
#include <vector>

namespace tomales {

/// The exit code of a child that could not begin.
constexpr int kNotBegun = 127;

/// Forks the process that the children are forked from. Call it before this one has other threads. A child calls `body`
/// and ends with the exit code that it returns. From then on orphans among the descendants of this process become its
/// children.
void openNursery(int (*body)(const std::vector<std::string>& arguments));

/// Starts a child in a folder, as leader of a process group of its own. Its output and errors go to the end of a file.
/// It is a child of this process, and gets SIGKILL when this one ends in any way. Returns -1 if there is no nursery
/// (any more), or no process can be had.
pid_t startInNursery(const std::string& folder, const std::string& log, const std::vector<std::string>& arguments);

}  // namespace tomales
