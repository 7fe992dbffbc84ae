#include "reyes/base/crash_note.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <thread>

#include "reyes/base/loaded_plugins.h"

namespace tomales {
namespace {

constinit thread_local const CrashNote::Text* current = nullptr;
struct Pixels {
  int x0, y0, x1, y1;
};
constinit thread_local Pixels bucket{};  // empty: no bucket is worked on
std::atomic<bool> reports{false};
constinit thread_local uint64_t changes = 0;  ///< Counts the notes that this thread has made and ended.
constinit thread_local uint64_t marked = 0;   ///< `changes` when notes were marked, or 0 if there was no note.
std::atomic<bool> compares{false}, told{false};

// The code below runs in a signal handler: no allocation, no streams.

void put(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody is left to read it
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

void putNote(const CrashNote::Text& t) {
  put("tomales: error: ");
  if (t.file) {
    put(t.file);
    put(":");
    put(t.line);
    put(": ");
  }
  put(t.user);
  if (t.other) {
    put(", on ");
    put(t.other);
  }
  putBucket();
  put(": ");
  put(t.kind);
  put(" \"");
  put(t.name);
}

extern "C" void onCrash(int signal) {
  if (current) {
    putNote(*current);
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

extern "C" void onAsked(int) {
  if (!compares) {
    marked = current ? changes : 0;
  } else if (current && marked == changes && !told.exchange(true)) {
    putNote(*current);
    put("\" does not return; this ends the program\n");
  }
}

/// Makes every thread run onAsked(), because each knows only its own notes.
void askThreads(bool compare) {
  compares = compare;
  struct sigaction action {};
  action.sa_handler = onAsked;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_ONSTACK);
  sigemptyset(&action.sa_mask);
  sigaction(SIGURG, &action, nullptr);  // a signal that nobody else uses, and that is ignored by default
  std::error_code error;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", error))
    syscall(SYS_tgkill, getpid(), std::atoi(task.path().filename().c_str()), SIGURG);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

/// The stack of the handler: shaders may crash because they have used up their own.
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
  ++changes;
}

CrashNote::~CrashNote() {
  current = outer_;
  ++changes;
}

CrashBucket::CrashBucket(int x0, int y0, int x1, int y1) { bucket = {x0, y0, x1, y1}; }
CrashBucket::~CrashBucket() { bucket = {}; }

void markNotes() { askThreads(false); }

bool tellLastingNote() {
  askThreads(true);
  return told;
}

void reportCrashes() {
#ifndef TOMALES_SANITIZED  // sanitizers report more than a note does
  struct sigaction action {};
  action.sa_handler = onCrash;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_ONSTACK);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(signal, &action, nullptr);
  reports = true;
#endif
}

}  // namespace tomales
