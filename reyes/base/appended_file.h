// A file that lines are appended to, possibly by several programs at a time: logs, and the history of runs. Threads:
// write() may be called concurrently.
#pragma once
#include <memory>
#include <string>

namespace tomales {

class AppendedFile {
 public:
  /// Makes the file if it is missing. Returns null on failure, and `error` says why.
  static std::unique_ptr<AppendedFile> open(const std::string& path, std::string& error);
  ~AppendedFile();
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;

  /// Appends whole lines; lines of other programs do not get between them. Returns false on failure, and `error` says
  /// why.
  bool write(const std::string& lines, std::string& error) const;
  int descriptor() const { return descriptor_; }

 private:
  explicit AppendedFile(int descriptor) : descriptor_(descriptor) {}
  const int descriptor_;
};

}  // namespace tomales
