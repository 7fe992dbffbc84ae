// Pieces that a grid can hold: diced by the first bucket that does not hide them, and shared by those that they touch.
#pragma once
#include <atomic>

#include "reyes/frame/hide_node.h"

namespace tomales {

/// Pieces for one grid, all of nu x nv, and where they are together.
struct PieceStack {
  int object, nu, nv;
  std::vector<PatchPiece> pieces;
  Placement place;
  bool crossesEye;  ///< SubPatch::crossesEye
  bool round;       ///< Grid::round
};

class PieceNode : public HideNode {
 public:
  /// Stacks: nearest first.
  PieceNode(HideContext& context, std::vector<PieceStack> stacks, const Placement& place, const BucketRange& range);

  void visit(size_t bucket, NodeQueue& queue, Hider& hider) override;
  void release(size_t bucket) override;

 private:
  struct Stack {
    PieceStack pieces;
    BucketRange range;
    std::shared_ptr<const RasterGrid> grid{};
    RasterExtent extent{};  ///< Of the grid: displacement rarely takes it as far as it may.
    uint64_t wanted = 0;    ///< Buckets that the grid touches, as in done_.
    std::atomic<bool> made{false};

    Stack(PieceStack p, const BucketRange& r) : pieces(std::move(p)), range(r) {}
    Stack(Stack&& o) noexcept : pieces(std::move(o.pieces)), range(o.range) {}  ///< Pre: not made yet.
  };
  std::shared_ptr<const RasterGrid> acquire(Stack& stack);
  std::shared_ptr<const RasterGrid> makeGrid(const PieceStack& stack);
  static constexpr uint64_t kFarBuckets = uint64_t{1} << 63;  ///< Those past the 63rd of a node, which are never done.
  uint64_t bitsOf(const BucketRange& buckets) const;
  std::shared_ptr<Pool> makePool(const PieceStack& stack) const;
  /// Takes away the cells with vertices that are nearer than the eye plane at some key or not finite. True if there
  /// are.
  bool leaveOutUnseeable(Grid& grid) const;

  HideContext& context_;
  std::vector<Stack> stacks_;
  std::mutex mutex_;
  uint64_t done_ = 0;  ///< Buckets of the range, row by row: a grid that no other wants goes before its node.
  int users_;
};

/// A node for each large piece, and one for small ones that lie close together: most of what a tiny piece costs would
/// be its node and its grid. Which pieces share a grid may depend on buckets, what is seen may not
/// (docs/decisions/0040).
HideNodes pieceNodes(HideContext& context, std::span<const SubPatch> pieces, const BucketRange& within);

}  // namespace tomales
