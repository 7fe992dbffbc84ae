#include "reyes/base/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace tomales {
namespace {

/// dup2() of a file to itself would leave it close-on-exec, so that case clears the flag.
bool give(int ours, int its) { return ours == its ? ::fcntl(its, F_SETFD, 0) == 0 : ::dup2(ours, its) >= 0; }

/// Restores the defaults, because a program inherits ignored and blocked signals from the process that executes it.
void restoreSignals() {
  for (const int number : {SIGPIPE, SIGXFSZ}) ::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace

// vfork() and not fork(), which would copy the page tables of a large scene; and not posix_spawn(), which
// cannot ask for PR_SET_PDEATHSIG. Between vfork() and execv() the child runs in our memory, and makes only system
// calls.
pid_t startChild(const ChildProgram& program, int& problem) {
  std::vector<char*> argv;
  for (const std::string& a : program.arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  volatile int failure = 0;
  const pid_t parent = ::getpid(), child = ::vfork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setpgid(0, 0);
    bool ready = ::getppid() == parent;
    for (const auto& [ours, its] : program.files) ready = ready && give(ours, its);
    restoreSignals();
    if (ready) ::execv(program.path.c_str(), argv.data());
    failure = errno;
    ::_exit(127);
  }
  problem = child < 0 ? errno : failure;
  if (child > 0 && problem != 0) ::waitpid(child, nullptr, 0);
  return problem == 0 ? child : -1;
}

ChildGuard::ChildGuard(pid_t child) : AtAbruptEnd([child] { ::kill(-child, SIGKILL); }) {}

}  // namespace tomales
