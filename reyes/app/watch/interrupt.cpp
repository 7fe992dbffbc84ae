#include "reyes/app/watch/interrupt.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <thread>

#include "reyes/base/abrupt_end.h"
#include "reyes/base/crash_note.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

std::atomic<bool> endsOrderly{false};
std::atomic<int> signalNumber{0};

bool isIgnored(int number) {
  struct sigaction action {};
  return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

constexpr timespec kShaderPatience{10, 0};  ///< Longest time for one call of a shader to return after the first signal.

/// Signals are handled by a thread, because the steps of an abrupt end are not allowed in a handler.
[[noreturn]] void waitForSignals(sigset_t set) {
  int number = 0;
  while (::sigwait(&set, &number) != 0) continue;
  if (stopRequested() || !endsOrderly) endAbruptly(128 + number);
  signalNumber = number;
  requestStop();
  for (bool marked = false;; marked = true) {
    if (marked && tellLastingNote()) endAbruptly(128 + signalNumber);
    markNotes();
    if (const int second = ::sigtimedwait(&set, nullptr, &kShaderPatience); second > 0) endAbruptly(128 + second);
  }
}

}  // namespace

void openStandardFiles() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(number, F_GETFD) < 0)
      ::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // takes the lowest number
}

void watchSignals() {
  for (const int number : {SIGPIPE, SIGXFSZ}) ::signal(number, SIG_IGN);
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM}) sigaddset(&set, number);
  if (!isIgnored(SIGHUP)) sigaddset(&set, SIGHUP);
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::thread(waitForSignals, set).detach();
}

OrderlyEnd::OrderlyEnd() { endsOrderly = true; }
OrderlyEnd::~OrderlyEnd() { endsOrderly = false; }

int interruptExitCode() { return stopRequested() ? 128 + signalNumber : 0; }

}  // namespace tomales
