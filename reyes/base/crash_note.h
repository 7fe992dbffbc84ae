// Whose code is running, so that a crash in it is told by name. Shaders are native code of the user's.
// Threads: a note is of the thread that makes it.
#pragma once

namespace tomales {

/// While it lives, a crash of this thread is that of `kind` `name` ("surface shader", "dots"), which serves `user`
/// (an object) and perhaps, unless null, `other` beside it; `file`, null for none, and `line` say where the scene asks
/// for it. The texts are the caller's and live as long. Notes nest: the latest is told.
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

/// From now on, SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT write the note of their thread to standard error before
/// they end the program, which they do as before. Without a note they write nothing.
void reportCrashes();

}  // namespace tomales
