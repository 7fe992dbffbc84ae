// The pictures of the layers: as pages get them, and the finished picture in full floats. Every shaded layer contains
// the light of glowing surfaces (kGlow), which is subtracted from the layers of lights. Threads: store() and finished()
// may be called by any; all else belongs to the thread that shades.
#pragma once
#include "reyes/app/frame/shot.h"
#include "reyes/app/relight/layers.h"
#include "reyes/app/relight/work_order.h"

namespace tomales {

inline vec3 colorAt(const Image& rows, int x, int y) {
  const float* p = rows.at(x, y);
  return {p[0], p[1], p[2]};
}

class LayerPictures {
 public:
  LayerPictures(const PixelRect& window, size_t layers);

  const LayerStore& store() const { return store_; }
  /// Returns the floats R G B of the whole picture, row by row; empty if none of it has been shaded.
  std::vector<float> finished() const;

  /// Takes rows of a step's part.
  void take(const WorkStep& step, const Image& rows, const ShotJob& job);
  /// Subtracts the glow from a coarse layer. Coarse colours of layer kGlow itself are kept for that.
  void subtractGlow(size_t layer, std::vector<vec3>& colors);
  void putCoarse(size_t layer, std::span<const vec3> rgb, uint32_t version) { store_.putCoarse(layer, rgb, version); }
  void dropCoarse(size_t layer) { store_.dropCoarse(layer); }

 private:
  size_t placeOf(int x, int y) const;
  void takeFinished(const Image& rows);

  const PixelRect window_;
  const size_t variableLayer_;
  LayerStore store_;
  std::vector<vec3> glow_, coarseGlow_;
  mutable std::mutex mutex_;  ///< Guards what follows.
  std::vector<float> finished_;
};

/// Returns the variables and channels that a page may ask for.
std::vector<std::string> variablesOf(const Options& options);

}  // namespace tomales
