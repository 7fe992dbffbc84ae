// Verb: deep frame buffer <-> .dfb file (docs/dfb.md). The file holds one record for each bucket, and the parts of the
// scene that shading needs: options, camera, lights, named spaces, and the attributes, shaders and primitive variable
// layouts of every shade group. It holds no geometry: where rays are needed, the RIB is read again. Threads: tiles may
// be written and read concurrently.
#pragma once
#include "reyes/base/record_file.h"
#include "reyes/deep.h"

namespace tomales {

struct SourceFile {
  std::string path;  ///< The absolute path, or "-" for standard input.
  uint64_t sum = 0;  ///< The result of sumOfFile().
  bool operator==(const SourceFile&) const = default;
};

/// The contents of a .dfb except for the tiles.
struct Shot {
  Scene scene;  ///< If read from a file, `objects` has one for every group, without shape; freeze() must not be called.
  DeepFrame frame;  ///< The layout, without tiles.
  uint32_t seed = 0;
  std::vector<SourceFile> sources;  ///< The files of the RIB stream, in order.
  std::string folder;               ///< Folder in which the program ran, where relative names start.
  int world = 0;                    ///< Number of the scene in the stream, from 0.
};

class DfbWriter {
 public:
  /// `Unfinished::Resumed` counts only if the shot is the same. Returns null on failure, and `error` says why.
  static std::unique_ptr<DfbWriter> create(const std::string& path, const Shot& shot, Unfinished unfinished,
                                           std::string& error);

  size_t tilesKept() const { return kept_; }
  bool has(size_t tile) const;
  std::optional<DeepTile> tile(size_t index) const;
  /// Returns false if the disk is full or gone, as error() says; tiles written before stay in the file.
  bool write(size_t index, const DeepTile& tile);
  bool finish();
  std::string error() const { return records_->error(); }
  const std::string& unfinishedPath() const { return records_->unfinishedPath(); }
  /// Deletes the unfinished file's name. Tiles can still be written and read until the writer is destroyed.
  void discard() { records_->discard(); }

 private:
  explicit DfbWriter(std::unique_ptr<RecordWriter> records) : records_(std::move(records)) {}
  std::unique_ptr<RecordWriter> records_;
  size_t kept_ = 0;
};

class DfbFile {
 public:
  static std::unique_ptr<DfbFile> open(const std::string& path, std::string& error);

  const Shot& shot() const { return shot_; }
  /// Returns the checksum of the shot, which files made for it carry.
  uint64_t shotSum() const { return shotSum_; }
  /// Returns nothing if the tile cannot be read, and `error` says what is wrong.
  std::optional<DeepTile> tile(size_t index, std::string& error) const;
  uint64_t size() const { return records_->size(); }

 private:
  DfbFile() = default;
  std::unique_ptr<RecordFile> records_;
  Shot shot_;
  uint64_t shotSum_ = 0;
};

}  // namespace tomales
