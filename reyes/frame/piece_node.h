// Pieces that fit into grids. The first bucket that does not hide them dices them, and all buckets that they touch
// share the grids.
#pragma once
#include <atomic>

#include "reyes/frame/hide_node.h"

namespace tomales {

/// The pieces of one grid, each of nu x nv cells, and their common placement.
struct PieceStack {
  int object, nu, nv;
  std::vector<PatchPiece> pieces;
  Placement place;
  bool crossesEye;  ///< See SubPatch::crossesEye.
  bool round;       ///< See Grid::round.
};

class PieceNode : public HideNode {
 public:
  /// Stacks are in order, nearest first.
  PieceNode(HideContext& context, std::vector<PieceStack> stacks, const Placement& place, const BucketRange& range);

  void visit(size_t bucket, NodeQueue& queue, Hider& hider) override;
  void release(size_t bucket) override;

 private:
  struct Stack {
    PieceStack pieces;
    BucketRange range;
    std::shared_ptr<const RasterGrid> grid{};
    RasterExtent extent{};  ///< Mostly smaller than the placement: displacement rarely reaches its bound.
    uint64_t wanted = 0;    ///< Buckets that the grid touches, as bits like those of done_.
    std::atomic<bool> made{false};

    Stack(PieceStack p, const BucketRange& r) : pieces(std::move(p)), range(r) {}
    Stack(Stack&& o) noexcept : pieces(std::move(o.pieces)), range(o.range) {}  ///< Pre: the grid is not made yet.
  };
  std::shared_ptr<const RasterGrid> acquire(Stack& stack);
  std::shared_ptr<const RasterGrid> makeGrid(const PieceStack& stack);
  /// The buckets after the 63rd of a node, which never count as done.
  static constexpr uint64_t kFarBuckets = uint64_t{1} << 63;
  uint64_t bitsOf(const BucketRange& buckets) const;
  std::shared_ptr<Pool> makePool(const PieceStack& stack) const;
  /// Removes the cells with vertices that are nearer than the eye plane at some motion key, or not finite. Returns
  /// whether there were any.
  bool leaveOutUnseeable(Grid& grid) const;

  HideContext& context_;
  std::vector<Stack> stacks_;
  std::mutex mutex_;
  /// Bits for the buckets of the range that are done, row by row: a grid that no other bucket wants is freed before its
  /// node.
  uint64_t done_ = 0;
  int users_;
};

/// Makes a node for each large piece, and one for small ones that lie close together: most of the cost of a tiny piece
/// would be its node and its grid. Which pieces share a grid may depend on buckets, but the picture does not
/// (docs/decisions/0040).
HideNodes pieceNodes(HideContext& context, std::span<const SubPatch> pieces, const BucketRange& within);

}  // namespace tomales
