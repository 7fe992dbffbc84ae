// Pieces that a grid each can hold: diced by the first bucket that does not hide them, and shared by those that they touch.
#pragma once
#include "reyes/frame/hide_node.h"

namespace tomales {

class PieceNode : public HideNode {
 public:
  /// Pieces: nearest first.
  PieceNode(HideContext& context, std::span<const SubPatch* const> pieces, const Placement& place, const BucketRange& range);

  void visit(size_t bucket, NodeQueue& queue, Hider& hider) override;
  void release(size_t bucket) override;

 private:
  struct Piece {
    SubPatch patch;
    BucketRange range;
    std::shared_ptr<const RasterGrid> grid{};
    bool made = false;
  };
  std::shared_ptr<const RasterGrid> acquire(Piece& piece);
  std::shared_ptr<const RasterGrid> makeGrid(const SubPatch& piece);
  std::shared_ptr<Pool> makePool() const;
  /// Takes away the cells with vertices that are nearer than the eye plane at some key or not finite. True if there are.
  bool leaveOutUnseeable(Grid& grid) const;

  HideContext& context_;
  std::vector<Piece> pieces_;
  std::mutex mutex_;
  std::shared_ptr<Pool> pool_;  ///< Of the grids. Hiders keep them longer than nodes do.
  int users_;
};

/// A node for each large piece, and one for small ones that lie close together: most of what a tiny piece costs would be its node.
HideNodes pieceNodes(HideContext& context, std::span<const SubPatch> pieces, const BucketRange& within);

}  // namespace tomales
