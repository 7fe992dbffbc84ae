// A piece that one grid can hold: diced by the first bucket that does not hide it, and shared by those that it touches.
#pragma once
#include "reyes/frame/hide_node.h"

namespace tomales {

class PieceNode : public HideNode {
 public:
  PieceNode(HideContext& context, const SubPatch& piece, const BucketRange& range)
      : HideNode({piece.raster, piece.zMin}, range), context_(context), piece_(piece), users_(range.count()) {}

  void visit(size_t bucket, NodeQueue& queue, Hider& hider) override;
  void release(size_t bucket) override;

 private:
  std::shared_ptr<const RasterGrid> acquire();
  std::shared_ptr<const RasterGrid> makeGrid() const;
  /// Takes away the cells with vertices that are nearer than the eye plane at some key or not finite. True if there are.
  bool leaveOutUnseeable(Grid& grid) const;

  HideContext& context_;
  const SubPatch piece_;
  std::mutex mutex_;
  std::shared_ptr<const RasterGrid> grid_;
  bool made_ = false;
  int users_;
};

}  // namespace tomales
