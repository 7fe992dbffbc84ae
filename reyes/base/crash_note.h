// Notes whose code is running, so that the message of a crash can name it. Shaders are native code of the user's.
// Threads: a note belongs to the thread that makes it.
#pragma once

namespace tomales {

/// While it lives, a crash of this thread is attributed to `kind` `name` ("surface shader", "dots"). `user` is the
/// object that the code serves, and `other` a second one, or null. `file` and `line` say where the scene asks for the
/// code; `file` is null if it does not. The texts belong to the caller and must outlive the note. Notes nest: the
/// message names the latest.
class CrashNote {
 public:
  struct Text {
    const char *kind, *name, *user, *other, *file;
    int line;
  };
  explicit CrashNote(const Text& text);
  ~CrashNote();
  CrashNote(const CrashNote&) = delete;

 private:
  const Text text_;
  const Text* const outer_;
};

/// While it lives, the message of a crash of this thread names the bucket of the pixels [x0, x1) x [y0, y1). They do
/// not nest.
class CrashBucket {
 public:
  CrashBucket(int x0, int y0, int x1, int y1);
  ~CrashBucket();
  CrashBucket(const CrashBucket&) = delete;
};

/// Marks the latest note of every thread, if it has one.
void markNotes();
/// Looks for a thread whose latest note is still the marked one. Returns true after writing that note to standard
/// error, as code that does not return. Call both functions from one thread.
bool tellLastingNote();

/// Sets handlers: from now on SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT write the note of their thread, or else that
/// the program crashes, to standard error before they end the program as they always do.
void reportCrashes();
/// What is written to standard error goes to this log too, with the time before it. Negative: no longer.
void reportCrashesAlsoTo(int descriptor);

}  // namespace tomales
