#include "reyes/base/crash_note.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
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

std::atomic<int> alsoTo{-1};  ///< Descriptor of a log; negative: there is none.

// The code below runs in a signal handler: no allocation, no streams.

/// A line for standard error, and for a log, whose lines begin with the time. What is too long is cut.
class Line {
 public:
  Line() { putTime(); }
  void put(const char* text) {
    const size_t size = std::min(std::strlen(text), sizeof text_ - 1 - size_);
    std::memcpy(text_ + size_, text, size);
    size_ += size;
  }
  void put(int number, int width = 1) {
    if (number < 0) put("-");
    char digits[12] = {}, *at = digits + sizeof digits - 1;
    unsigned left = number < 0 ? 0u - static_cast<unsigned>(number) : static_cast<unsigned>(number);
    for (int k = 0; k == 0 || left > 0 || k < width; ++k, left /= 10) *--at = static_cast<char>('0' + left % 10);
    put(at);
  }
  void send() {
    text_[size_++] = '\n';
    if (alsoTo >= 0 && write(alsoTo, text_, size_) < 0) alsoTo = -1;
    if (write(STDERR_FILENO, text_ + timeSize_, size_ - timeSize_) < 0) return;  // nobody is left to read it
  }

 private:
  /// timeNow() of process.h may wait for a lock.
  void putTime() {
    using namespace std::chrono;
    const auto now = floor<seconds>(system_clock::now());
    const auto day = floor<days>(now);
    const year_month_day date(day);
    const hh_mm_ss clock(now - day);
    const struct {
      int64_t number;
      int width;
      const char* after;
    } fields[] = {{int{date.year()}, 4, "-"},        {unsigned{date.month()}, 2, "-"},
                  {unsigned{date.day()}, 2, "T"},    {clock.hours().count(), 2, ":"},
                  {clock.minutes().count(), 2, ":"}, {clock.seconds().count(), 2, "Z "}};
    for (const auto& f : fields) {
      put(static_cast<int>(f.number), f.width);
      put(f.after);
    }
    timeSize_ = size_;
  }

  char text_[4096];
  size_t size_ = 0, timeSize_ = 0;
};

void putBucket(Line& line) {
  if (bucket.x0 == bucket.x1) return;
  line.put(", in the bucket of the pixels ");
  line.put(bucket.x0);
  line.put(",");
  line.put(bucket.y0);
  line.put(" to ");
  line.put(bucket.x1 - 1);
  line.put(",");
  line.put(bucket.y1 - 1);
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

void putNote(Line& line, const CrashNote::Text& t) {
  line.put("tomales: error: ");
  if (t.file) {
    line.put(t.file);
    line.put(":");
    line.put(t.line);
    line.put(": ");
  }
  line.put(t.user);
  if (t.other) {
    line.put(", on ");
    line.put(t.other);
  }
  putBucket(line);
  line.put(": ");
  line.put(t.kind);
  line.put(" \"");
  line.put(t.name);
}

extern "C" void onCrash(int signal) {
  Line line;
  if (current) {
    putNote(line, *current);
    line.put("\" crashes (");
  } else {
    line.put("tomales: error: the program crashes (");
  }
  line.put(nameOf(signal));
  if (current) {
    line.put("); this ends the program");
  } else if (loadedPlugin(0)) {
    line.put("); it has loaded plugins, one of which may be to blame:");
    for (int i = 0; loadedPlugin(i); ++i) {
      line.put(" ");
      line.put(loadedPlugin(i));
    }
  } else {
    line.put(")");
  }
  line.send();
  raise(signal);  // SA_RESETHAND has restored the default, which kills
}

extern "C" void onAsked(int) {
  if (!compares) {
    marked = current ? changes : 0;
  } else if (current && marked == changes && !told.exchange(true)) {
    Line line;
    putNote(line, *current);
    line.put("\" does not return; this ends the program");
    line.send();
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

void reportCrashesAlsoTo(int descriptor) { alsoTo = descriptor; }

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
