// A file that is written before it gets its name. Every output file of this program is made here, so a file under its
// final name is complete.
//
// It is written under another name in the same folder and renamed when it is complete. Of two processes that write the
// same file, the last one to finish wins as a whole. A target that is a symbolic link stays one, and the file that it
// points to is replaced, as with `>` in a shell. Other hard links to the old file, and programs that read it, keep the
// old contents, so a program's input may be its output. finish() calls fsync() before the rename, because otherwise the
// file could be empty after a power failure. Threads: plain object.
#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reyes/base/scratch_path.h"

namespace tomales {

enum class UnfinishedKind {
  Scratch,    ///< Its name is a ScratchPath, and it is removed unless it is finished. The target must be a regular file
              ///< or not exist.
  Stream,     ///< As Scratch, but devices, pipes and the targets of /dev/stdout and /dev/fd are written directly.
  Resumable,  ///< It is called NAME.part, is locked, and stays until it is finished or discarded. It begins with the
              ///< contents of an earlier one.
};

class UnfinishedFile {
 public:
  /// Returns null on failure, and `error` says why, without naming the file.
  static std::unique_ptr<UnfinishedFile> create(const std::string& target, UnfinishedKind kind, std::string& error);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  /// Returns the path for libraries that open files by name: the file exists already, and must be written over, not
  /// replaced.
  const std::string& path() const { return path_; }
  /// Returns the descriptor, which is open for reading and writing.
  int descriptor() const { return descriptor_; }
  /// Returns the same file for stdio. Pre: descriptor() is not used as well.
  std::FILE* stream();
  /// Gives the file its name. Returns false on failure: `error` says why, and the file is removed unless resumable.
  bool finish(std::string& error);
  /// Has finish() give it this name beside its target instead.
  void finishAs(const std::string& name) { target_.replace_filename(name); }
  /// Removes its name. The file can still be written and read, and nothing is left at the end.
  void discard();

 private:
  UnfinishedFile() = default;
  bool openScratch(std::string& error);
  bool openStream(std::string& error);
  bool openResumable(std::string& error);

  std::filesystem::path target_;
  std::string path_;  ///< Empty if it has no name.
  std::unique_ptr<ScratchPath> scratch_;
  int descriptor_ = -1;
  std::FILE* stream_ = nullptr;
};

/// Writes all of a small file at once. Returns false on failure, and `error` says why.
bool writeFile(const std::string& target, const std::string& content, std::string& error);

/// Does what UnfinishedFile::finish() does, for a file that a library or another program has written into a
/// TemporaryFolder beside `target`.
bool moveFinished(const std::filesystem::path& from, const std::filesystem::path& target, std::string& error);

/// Follows the links of `target`; the result need not exist.
/// A TemporaryFolder for moveFinished() belongs beside it.
std::filesystem::path throughLinks(const std::filesystem::path& target);

/// Returns one name for all paths that lead to the same file by links or folders, be it there or not yet. Hard links
/// have names of their own, because finish() replaces one of them and leaves the others.
std::string placeOf(const std::filesystem::path& target);

/// Tells whether `target`, by whatever name, is one of these. A command that would replace one of its own inputs says
/// so before. Hard links of an input count too, because logs are written in place.
bool isAmong(const std::filesystem::path& target, const std::vector<std::string>& files);

}  // namespace tomales
