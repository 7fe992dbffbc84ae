// A program of the user's, run by the shell. It gets requests as lines of text, and its output is read as it comes. It
// ends at the latest with this object, which kills its whole process group.
#pragma once
#include <sys/types.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "reyes/base/child_process.h"

namespace tomales::rib {

class Program {
 public:
  explicit Program(const std::string& command);
  ~Program();
  Program(const Program&) = delete;

  /// Sends a request. `patience_s`: the longest total time that read() waits for the answer.
  void ask(std::string text, double patience_s);
  /// Closes its input, which tells it that no more requests follow.
  void closeInput();
  /// Returns 0 if the program has closed its output, or if the time is over.
  size_t read(char* buffer, size_t size);
  /// Waits for the program's end for the time that is left. Returns what went wrong; empty if nothing did. Pre: read()
  /// has returned 0.
  std::string finish();

 private:
  void writeInput();

  pid_t id_ = -1;
  std::optional<ChildGuard> guard_;
  int toChild_ = -1, fromChild_ = -1, startError_ = 0;
  std::string input_;
  size_t written_ = 0;
  double patience_s_ = 0;
  bool hung_ = false;
};

/// Programs that have answered wait here for the next request. So each is started once, or once for each thread that
/// needs it at the same time. Threads: calls may be concurrent.
class ProgramPool {
 public:
  std::unique_ptr<Program> take(const std::string& command);
  void giveBack(const std::string& command, std::unique_ptr<Program> program);

 private:
  std::mutex mutex_;
  std::map<std::string, std::vector<std::unique_ptr<Program>>> idle_;
};

}  // namespace tomales::rib
