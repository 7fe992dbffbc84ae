// Verb: deep frame buffer <-> .dfb file (docs/dfb.md). The file holds a bucket a record, and what shading needs of the
// scene: options, camera, lights, named spaces, and the attributes, shaders and primitive variable layouts of every
// shade group. No geometry: where rays are needed, the RIB is read again. Threads: tiles may be written and read
// concurrently.
#pragma once
#include "reyes/base/record_file.h"
#include "reyes/deep.h"

namespace tomales {

struct SourceFile {
  std::string path;  ///< Absolute; "-": standard input.
  uint64_t sum = 0;  ///< checksum() of its bytes.
  bool operator==(const SourceFile&) const = default;
};

/// What a .dfb holds besides the tiles.
struct Shot {
  Scene scene;      ///< From a file: `objects` has one for every group, without shape; freeze() must not be called.
  DeepFrame frame;  ///< Layout, without tiles.
  uint32_t seed = 0;
  std::vector<SourceFile> sources;  ///< The RIB stream, in order.
  std::string folder;               ///< Where the program ran: relative names start there.
  int world = 0;                    ///< Number of the scene in the stream, from 0.
};

class DfbWriter {
 public:
  /// `resume`: tiles of an interrupted run with the same shot are kept. Null: `error` says why.
  static std::unique_ptr<DfbWriter> create(const std::string& path, const Shot& shot, bool resume, std::string& error);

  size_t tilesKept() const { return kept_; }
  bool has(size_t tile) const;
  std::optional<DeepTile> tile(size_t index) const;
  /// False: the disk is full or gone, as error() says; tiles written before stay in the file.
  bool write(size_t index, const DeepTile& tile);
  bool finish();
  std::string error() const { return records_->error(); }
  const std::string& temporary() const { return records_->temporary(); }

 private:
  explicit DfbWriter(std::unique_ptr<RecordWriter> records) : records_(std::move(records)) {}
  std::unique_ptr<RecordWriter> records_;
  size_t kept_ = 0;
};

class DfbFile {
 public:
  static std::unique_ptr<DfbFile> open(const std::string& path, std::string& error);

  const Shot& shot() const { return shot_; }
  /// Names the shot: files that were made for it carry it.
  uint64_t shotSum() const { return shotSum_; }
  /// Nothing: `error` says what is wrong.
  std::optional<DeepTile> tile(size_t index, std::string& error) const;
  uint64_t size() const { return records_->size(); }

 private:
  DfbFile() = default;
  std::unique_ptr<RecordFile> records_;
  Shot shot_;
  uint64_t shotSum_ = 0;
};

}  // namespace tomales
