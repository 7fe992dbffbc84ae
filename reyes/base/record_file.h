// Files of compressed, checksummed records: what .dfb and .icf are made of (docs/dfb.md has the bytes).
//   header     magic, version, schema of the contents
//   record*     32 bytes that say what and how long, then zstd; in the order of finishing
//   directory  the last record: where every other one starts
//   trailer    where the directory starts
// Written to NAME.part, which a killed program leaves behind with whole records in it, and renamed when complete.
// Every byte is under a checksum. Numbers are little-endian.
// Threads: write() and read() may be called concurrently; records are compressed by the caller's thread.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "reyes/base/checksum.h"

namespace tomales {

/// What kind of file this is, and which description of its contents the writer had.
struct RecordFileKind {
  char magic[9];  ///< Eight characters.
  uint32_t version;
  uint64_t schema = 0;  ///< Builds whose structures differ must not read each other's files.
};

struct RecordName {
  uint32_t kind, index;
  auto operator<=>(const RecordName&) const = default;
};

class RecordWriter {
 public:
  /// `resume`: whole records of NAME.part are kept, if it is of this kind. Null: cannot be written, `error` says why.
  static std::unique_ptr<RecordWriter> create(const std::string& path, const RecordFileKind& kind, bool resume,
                                              std::string& error);
  ~RecordWriter();  ///< Leaves NAME.part unless finished.

  bool has(RecordName name) const;
  /// A record kept or written before; nothing if there is none.
  std::optional<Bytes> read(RecordName name) const;
  /// False once writing has failed (a full disk): error() says why, and what was written stays.
  bool write(RecordName name, BytesView content);
  /// Writes the directory and gives the file its name. False: error() says why.
  bool finish();
  /// Forgets and removes what is in NAME.part.
  bool restart();
  std::string error() const;
  const std::string& temporary() const { return temporary_; }
  uint64_t bytesWritten() const { return end_; }

 private:
  RecordWriter(std::string path, const RecordFileKind& kind);
  bool open(bool resume, std::string& error);
  bool append(const void* data, size_t size);
  bool fail(const std::string& what);
  void keepWholeRecords();

  const std::string path_, temporary_;
  const RecordFileKind kind_;
  int file_ = -1;
  uint64_t end_ = 0;
  std::map<RecordName, uint64_t> offsets_;
  std::string error_;
  mutable std::mutex mutex_;
};

class RecordFile {
 public:
  /// Null: `error` says what is wrong (missing, truncated, damaged, another kind or version).
  static std::unique_ptr<RecordFile> open(const std::string& path, const RecordFileKind& kind, std::string& error);
  ~RecordFile();

  bool has(RecordName name) const { return offsets_.contains(name); }
  std::vector<RecordName> names() const;
  /// The contents of a record. Nothing: there is none, or it is damaged, as `error` says.
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
