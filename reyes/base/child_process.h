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
  std::vector<std::string> arguments;      ///< The first is what it is called.
  std::vector<std::pair<int, int>> files;  ///< Ours and what the child has it as, in this order. Others that
                                           ///< are close-on-exec it does not get.
};

/// Leads a process group of its own, with the usual reactions to signals. It gets SIGKILL when this process
/// ends, however that ends; programs that it has started itself then only lose their pipes. -1: not started,
/// `problem` is the errno.
pid_t startChild(const ChildProgram& program, int& problem);

/// Kills a child and all of its process group if this process ends abruptly. To be destroyed before the child
/// is waited for: another may have its number then.
class ChildGuard : AtAbruptEnd {
 public:
  explicit ChildGuard(pid_t child);
};

}  // namespace tomales
