#include "reyes/app/watch/interrupt.h"

#include <csignal>

namespace tomales {
namespace {

std::atomic<bool> flag{false};
std::atomic<int> signalNumber{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "used in a signal handler");

extern "C" void onSignal(int number) {
  signalNumber = number;
  flag = true;
}

}  // namespace

void catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interrupted() { return flag; }

int interruptExitCode() { return flag ? 128 + signalNumber : 0; }

}  // namespace tomales
