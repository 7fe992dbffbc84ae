// Programs that this one starts. They must not outlive it.
// Threads: any.
#pragma once
#include <sys/types.h>

#include <string>
#include <utility>
#include <vector>

#include "reyes/base/abrupt_end.h"

namespace tomales {

struct ChildProgram {
  std::string path;
  std::vector<std::string> arguments;      ///< The first is argv[0], the program's name.
  std::vector<std::pair<int, int>> files;  ///< Our file and its number in the child, in this order. The child gets no
                                           ///< others that are close-on-exec.
};

/// Starts a program as leader of a process group of its own, with the default signal handlers. It gets SIGKILL when the
/// calling thread ends, and so whenever this process ends; programs that it has started itself only lose their pipes.
/// Returns -1 if it was not started, and sets `problem` to the errno.
pid_t startChild(const ChildProgram& program, int& problem);

/// Kills a child and all of its process group if this process ends abruptly. Destroy it before the child is waited for:
/// its process id may be reused afterwards.
class ChildGuard : AtAbruptEnd {
 public:
  explicit ChildGuard(pid_t child);
};

}  // namespace tomales
