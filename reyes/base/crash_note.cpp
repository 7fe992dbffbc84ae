#include "reyes/base/crash_note.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <memory>

#include "reyes/base/loaded_plugins.h"

namespace tomales {
namespace {

constinit thread_local const CrashNote::Text* current = nullptr;
struct Pixels {
  int x0, y0, x1, y1;
};
constinit thread_local Pixels bucket{};  // empty: no bucket is worked on
std::atomic<bool> reports{false};

// The code below runs in a signal handler: no allocation, no streams.

void put(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody is left to be told
}

void put(int number) {
  if (number < 0) put("-");
  char digits[12] = {}, *at = digits + sizeof digits - 1;
  unsigned left = number < 0 ? 0u - static_cast<unsigned>(number) : static_cast<unsigned>(number);
  do *--at = static_cast<char>('0' + left % 10);
  while (left /= 10);
  put(at);
}

void putBucket() {
  if (bucket.x0 == bucket.x1) return;
  put(", in the bucket of the pixels ");
  put(bucket.x0);
  put(",");
  put(bucket.y0);
  put(" to ");
  put(bucket.x1 - 1);
  put(",");
  put(bucket.y1 - 1);
}

const char* nameOf(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV: memory that is not its own";
    case SIGBUS:
      return "SIGBUS: memory that is not there";
    case SIGFPE:
      return "SIGFPE: integers divided by zero";
    case SIGILL:
      return "SIGILL: an instruction that this machine does not have";
    default:
      return "SIGABRT: it gave up";
  }
}

extern "C" void onCrash(int signal) {
  if (const CrashNote::Text* t = current) {
    put("tomales: error: ");
    if (t->file) {
      put(t->file);
      put(":");
      put(t->line);
      put(": ");
    }
    put(t->user);
    if (t->other) {
      put(", on ");
      put(t->other);
    }
    putBucket();
    put(": ");
    put(t->kind);
    put(" \"");
    put(t->name);
    put("\" crashes (");
    put(nameOf(signal));
    put("); this ends the program\n");
  } else if (loadedPlugin(0)) {
    put("tomales: error: the program crashes (");
    put(nameOf(signal));
    put("); it has loaded plugins, one of which may be to blame:");
    for (int i = 0; loadedPlugin(i); ++i) {
      put(" ");
      put(loadedPlugin(i));
    }
    put("\n");
  }
  raise(signal);  // SA_RESETHAND has restored the default, which kills
}

/// Shaders may crash because they have used up their stack: the handler needs another one.
class HandlerStack {
 public:
  HandlerStack() : memory_(new char[kBytes]) {
    stack_t stack{};
    stack.ss_sp = memory_.get();
    stack.ss_size = kBytes;
    sigaltstack(&stack, nullptr);
  }
  ~HandlerStack() {
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
  }
  HandlerStack(const HandlerStack&) = delete;

 private:
  static constexpr size_t kBytes = 64 << 10;
  std::unique_ptr<char[]> memory_;
};

}  // namespace

CrashNote::CrashNote(const Text& text) : text_(text), outer_(current) {
  if (reports.load(std::memory_order_relaxed)) thread_local const HandlerStack stack;
  current = &text_;
}

CrashNote::~CrashNote() { current = outer_; }

CrashBucket::CrashBucket(int x0, int y0, int x1, int y1) { bucket = {x0, y0, x1, y1}; }
CrashBucket::~CrashBucket() { bucket = {}; }

void reportCrashes() {
#ifndef TOMALES_SANITIZED  // sanitizers tell more than a note does
  struct sigaction action {};
  action.sa_handler = onCrash;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_ONSTACK);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(signal, &action, nullptr);
  reports = true;
#endif
}

}  // namespace tomales
