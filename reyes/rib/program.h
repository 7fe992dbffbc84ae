// A program of the user's, run by the shell: its input is one text, its output is read as it comes. Whatever
// becomes of it, it ends with this object: its whole process group is killed.
#pragma once
#include <sys/types.h>

#include <string>

namespace tomales::rib {

class Program {
 public:
  /// `patience_s`: the longest total time that read() waits for it.
  Program(const std::string& command, std::string input, double patience_s);
  ~Program();
  Program(const Program&) = delete;

  /// 0: it has closed its output, or patience is over.
  size_t read(char* buffer, size_t size);
  /// Pre: read() gave 0. Waits for its end with the patience that is left. Empty, or what went wrong with it.
  std::string finish();

 private:
  void writeInput();
  void closeInput();

  pid_t id_ = -1;
  int toChild_ = -1, fromChild_ = -1, startError_ = 0;
  std::string input_;
  size_t written_ = 0;
  double patience_s_;
  bool hung_ = false;
};

}  // namespace tomales::rib
