// A file on its way to its name. Every file that this program leaves is made here, so that what has its name
// is whole.
//
// It is written under another name in the same folder and renamed when it is complete. Of two processes that
// write the same file, the last one to finish wins as a whole. A target that is a link stays one: what it
// leads to is replaced, as with `>` of the shell. Another hard link to the old file keeps the old contents.
// So whoever reads the old file goes on reading it, and a program's input may be its output. finish() calls
// fsync() before the rename: else a name could stand for an empty file after the machine has lost power.
// Threads: plain object.
#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reyes/base/scratch_path.h"

namespace tomales {

enum class UnfinishedKind {
  Scratch,    ///< Its name is a ScratchPath, and it is gone unless finished. The target must be a regular file,
              ///< or not be there.
  Stream,     ///< The same; but devices, pipes and what /dev/stdout and /dev/fd lead to are written directly.
  Resumable,  ///< It is called NAME.part, is locked, and stays until it is finished or discarded. Contents
              ///< are those of an earlier one.
};

class UnfinishedFile {
 public:
  /// Null: `error` says why, without naming the file.
  static std::unique_ptr<UnfinishedFile> create(const std::string& target, UnfinishedKind kind, std::string& error);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// For libraries that open files by name: it is there already, and must be written over, not replaced.
  const std::string& path() const { return path_; }
  /// Open for reading and writing.
  int descriptor() const { return descriptor_; }
  /// The same for stdio. Pre: not used together with descriptor().
  std::FILE* stream();
  /// Gives it its name. False: `error` says why, and it is gone, or kept if it is resumable.
  bool finish(std::string& error);
  /// Takes its name away: it can still be written and read, and nothing is left at the end.
  void discard();

 private:
  UnfinishedFile() = default;
  bool openScratch(std::string& error);
  bool openStream(std::string& error);
  bool openResumable(std::string& error);

  std::filesystem::path target_;
  std::string path_;  ///< Empty: it has no name.
  std::unique_ptr<ScratchPath> scratch_;
  int descriptor_ = -1;
  std::FILE* stream_ = nullptr;
};

/// All of a small file at once. False: `error` says why.
bool writeFile(const std::string& target, const std::string& content, std::string& error);

/// For what a library or another program has written into a TemporaryFolder beside `target`: what
/// UnfinishedFile::finish() does.
bool moveFinished(const std::filesystem::path& from, const std::filesystem::path& target, std::string& error);

/// Where `target` leads by links; not necessarily there. A TemporaryFolder for moveFinished() belongs beside
/// it.
std::filesystem::path throughLinks(const std::filesystem::path& target);

/// Is `target`, by whatever name, one of these? A command says so before it replaces what it was given to
/// read.
bool isAmong(const std::filesystem::path& target, const std::vector<std::string>& files);

}  // namespace tomales
