// Noun: a brick map (Christensen and Batali 2004, section 3) on disk, .bkm: a tiled 3D MIP map of data on surfaces or
// in volumes. It is a file of chunks (reyes/base/chunk_file.h), one for each brick; its header has the channels, the
// octree, and what the map was made from. Space: that of the points it was made from (world). Threads: const members
// may be called concurrently; a writer belongs to one thread.
#pragma once
#include <string>

#include "gi/bricks/brick.h"
#include "gi/point_cloud.h"
#include "reyes/base/chunk_file.h"

namespace tomales {

class BrickFile {
 public:
  explicit BrickFile(const std::string& path);  ///< Throws FileError.

  const std::vector<CloudChannel>& channels() const { return channels_; }
  int width() const { return width_; }  ///< Floats that one lookup returns.
  const BrickTree& tree() const { return tree_; }
  const MadeFrom& madeFrom() const { return madeFrom_; }
  const std::string& path() const { return file_.path(); }
  uint64_t fileBytes() const { return file_.fileBytes(); }
  Brick brick(int32_t node) const;           ///< Throws DamageError where the file is damaged.
  void readAll() const { file_.readAll(); }  ///< Throws DamageError if it is damaged anywhere.

 private:
  ChunkReader file_;
  std::vector<CloudChannel> channels_;
  int width_ = 0;
  BrickTree tree_;
  MadeFrom madeFrom_;
};

class BrickFileWriter {
 public:
  explicit BrickFileWriter(const std::string& path);  ///< Throws FileError, like every member.
  void add(const Brick& brick);                       ///< Bricks must come in the order of their nodes.
  void finish(const std::vector<CloudChannel>& channels, const BrickTree& tree, const MadeFrom& madeFrom);

 private:
  ChunkWriter file_;
};

/// Returns the voxels of one level, and of coarser bricks where that level has none; level < 0: the finest. They are
/// disks as wide as the voxel is across its corners, so that neighbours meet whichever way their surface goes. Throws
/// FileError.
PointCloud voxelsOf(const BrickFile& file, int level);

}  // namespace tomales
