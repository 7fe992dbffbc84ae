// Files of compressed, checksummed records, such as .dfb and .icf (docs/formats.md has the bytes).
//   header     magic, version, schema of the contents
//   record*    32 bytes that say its name and length, then zstd; in the order of their names
//   directory  the last record: where every other one starts
//   trailer    where the directory starts
// A file that is not finished may stay as NAME.part with whole records in it, also after the program is killed. There
// the records are in the order of writing, which depends on threads; a finished file always has the same bytes. Every
// byte is under a checksum. Numbers are little-endian. Threads: write() and read() may be called concurrently; records
// are compressed by the caller's thread.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "reyes/base/checksum.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {

/// The kind of a file, and the schema that its writer had.
struct RecordFileKind {
  char magic[9];  ///< Eight characters.
  uint32_t version;
  uint64_t schema = 0;  ///< Builds whose structures differ must not read each other's files.
};

struct RecordName {
  uint32_t kind, index;
  auto operator<=>(const RecordName&) const = default;
};

/// What happens to the records of a file that is not finished.
enum class Unfinished {
  Removed,
  Kept,     ///< They stay in NAME.part, for a later run to resume.
  Resumed,  ///< As Kept; whole records of an earlier NAME.part of this kind are also taken over.
};

class RecordWriter {
 public:
  /// Returns null if the file cannot be written, and `error` says why.
  static std::unique_ptr<RecordWriter> create(const std::string& path, const RecordFileKind& kind,
                                              Unfinished unfinished, std::string& error);

  bool has(RecordName name) const;
  /// Returns a record kept or written before, or nothing if there is none.
  std::optional<Bytes> read(RecordName name) const;
  /// Returns false once writing has failed (a full disk): error() says why, and what was written stays.
  bool write(RecordName name, BytesView content);
  /// Puts records in the order of their names, writes the directory and gives the file its name. Where records were
  /// written in another order they are copied, which takes room for a second file meanwhile. Returns false on failure,
  /// and error() says why; the file NAME.part, if there is one, stays as it was.
  bool finish();
  /// Removes all records from the file.
  bool restart();
  /// Takes the name of the unfinished file away; records can still be written and read.
  void discard() { file_->discard(); }
  std::string error() const;
  const std::string& unfinishedPath() const { return file_->path(); }
  uint64_t bytesWritten() const { return end_; }

 private:
  RecordWriter(std::string path, std::unique_ptr<UnfinishedFile> file, const RecordFileKind& kind)
      : path_(std::move(path)), file_(std::move(file)), kind_(kind) {}
  bool finishInOrder();
  bool copyTo(RecordWriter& other);
  bool append(const void* data, size_t size);
  bool fail(const std::string& what);
  void keepWholeRecords();

  const std::string path_;
  const std::unique_ptr<UnfinishedFile> file_;
  const RecordFileKind kind_;
  uint64_t end_ = 0;
  std::map<RecordName, uint64_t> offsets_;
  std::string error_;
  mutable std::mutex mutex_;
};

class RecordFile {
 public:
  /// Returns null on failure, and `error` says what is wrong (missing, truncated, damaged, another kind or version).
  static std::unique_ptr<RecordFile> open(const std::string& path, const RecordFileKind& kind, std::string& error);
  ~RecordFile();

  bool has(RecordName name) const { return offsets_.contains(name); }
  std::vector<RecordName> names() const;
  /// Returns the contents of a record, or nothing if there is none or it is damaged, as `error` says.
  std::optional<Bytes> read(RecordName name, std::string& error) const;
  uint64_t size() const { return size_; }

 private:
  RecordFile() = default;
  bool readDirectory(const RecordFileKind& kind, std::string& error);

  int file_ = -1;
  uint64_t size_ = 0;
  std::map<RecordName, uint64_t> offsets_;
};

}  // namespace tomales
