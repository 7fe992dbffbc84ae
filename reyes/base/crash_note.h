// Notes of whose code is running, so that a crash in it is told by name. Shaders are native code of the user's.
// Threads: a note belongs to the thread that makes it.
#pragma once

namespace tomales {

/// While it lives, a crash of this thread is said to be that of `kind` `name` ("surface shader", "dots"). `user` is the
/// object that it serves, and `other` a second one, or null. `file` and `line` say where the scene asks for it; `file`
/// is null if there is no place. The texts belong to the caller and must outlive the note. Notes nest: the latest is
/// told.
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

/// While it lives, a crash of this thread is said to be in the bucket of the pixels [x0, x1) x [y0, y1). They do not
/// nest.
class CrashBucket {
 public:
  CrashBucket(int x0, int y0, int x1, int y1);
  ~CrashBucket();
  CrashBucket(const CrashBucket&) = delete;
};

/// Every thread marks its latest note, if it has one.
void markNotes();
/// Returns whether the latest note of a thread is the one that it marked, after one such has been written to standard
/// error as code that does not return. Call both from one thread.
bool tellLastingNote();

/// Sets handlers: from now on SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT write the note of their thread, if it has
/// one, to standard error before they end the program as they always do.
void reportCrashes();

}  // namespace tomales
