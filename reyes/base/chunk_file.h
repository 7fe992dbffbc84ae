// A file of numbered chunks that can be read one by one: point clouds, brick maps and whatever else is larger
// than memory.
//   8 bytes    what is in it ("TMPOINTS"), 4 bytes version, 4 bytes 0x01020304 in the writer's byte order
//   chunks     one after the other, each a zstd frame with its checksum
//   header     one more chunk: what a reader needs to know first
//   directory  8 bytes offset, 4 bytes stored size, 4 bytes size of every chunk, the header last; itself a zstd frame
//   footer     8 bytes offset of the directory, 4 bytes its stored size, 4 bytes its size, "TOMALESX"
// Numbers are little-endian. The writer works on an UnfinishedFile.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "reyes/base/checksum.h"
#include "reyes/base/log.h"

namespace tomales {

/// A file cannot be used. what() is a sentence that names the file and the fault.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A file cannot be written.
struct WriteError : FileError {
  using FileError::FileError;
};
/// A file is cut off, corrupt, or of another kind. A file of another version is no such error: another program can read
/// it.
struct DamageError : FileError {
  DamageError(std::string file, const std::string& problem) : FileError(problem), path(std::move(file)) {}
  std::string path;
};

/// Runs `make`, which makes and reads files of its own. If one of them is damaged, this is reported, the file is
/// removed, and `make` runs again, to make it anew. If a file is damaged a second time, its DamageError is thrown: it
/// was made that way.
void makeAnewWhatIsDamaged(const std::function<void()>& make, Log& log);

/// Threads: one writer is used by one thread.
class ChunkWriter {
 public:
  /// `kind` has eight characters. Throws WriteError, as all members do (a full disk).
  ChunkWriter(const std::string& path, const char (&kind)[9], uint32_t version);
  ~ChunkWriter();  ///< Removes a file that was not finished.
  ChunkWriter(ChunkWriter&&) noexcept;

  /// Returns the number of the chunk.
  uint32_t add(std::span<const std::byte> bytes);
  uint32_t count() const;
  /// Writes the header and the directory, and gives the file its name.
  void finish(std::span<const std::byte> header);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Threads: const members may be called concurrently.
class ChunkReader {
 public:
  /// Throws FileError for a file that is missing, foreign, of another version, truncated, or damaged.
  ChunkReader(const std::string& path, const char (&kind)[9], uint32_t version);
  ~ChunkReader();
  ChunkReader(ChunkReader&&) noexcept;

  const std::string& path() const;
  uint32_t count() const;            ///< Number of chunks, without the header.
  Bytes takeHeader();                ///< Moves it out: it may be large, and the caller keeps it.
  Bytes read(uint32_t chunk) const;  ///< Throws FileError.
  void readAll() const;              ///< Throws FileError unless every chunk can be read.
  uint64_t fileBytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct Unpacker;
/// Throws DamageError if more was read from the bytes of a file than they hold.
void throwIfDamaged(const Unpacker& read, const std::string& path);

}  // namespace tomales
