// Private to the hider: the samples that transparent micropolygons cover, some of which opaque surfaces may hide later.
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "reyes/base/simd.h"

namespace tomales {

/// The samples, among up to 64 of a pixel, that cells of one grid cover, each sample once. Mostly it is the part of the
/// pixel that one surface covers.
struct TransparentLayer {
  uint32_t word;  ///< Bit s of `samples` is lane 64 * (word % TransparentLayers::wordsOfPixel()) + s of pixel word /
                  ///< wordsOfPixel().
  int object;     ///< The object whose neighbouring pieces may overlap at a border (reyes/hide/border_overlap.h); -1 if
                  ///< there is none.
  uint64_t samples;
};

/// Its thread keeps the memory from bucket to bucket, up to a limit, so that one bucket with very many layers does not
/// hold memory for the rest of the frame.
class TransparentLayers {
 public:
  static constexpr float kUncovered_d = __builtin_inff();
  static constexpr uint32_t kNoCell = ~0U, kNone = ~0U;  ///< No cell; no layer.

  TransparentLayers(size_t pixels, size_t lanes)
      : width_(std::min<size_t>(lanes, 64)), words_((lanes + 63) / 64), last_(pixels * words_, kNone) {
    list_.swap(spare().list);
    depths_.swap(spare().depths);
    cells_.swap(spare().cells);
  }
  ~TransparentLayers() {
    if (worthKeeping(list_, spare().list)) list_.swap(spare().list);
    if (worthKeeping(depths_, spare().depths)) depths_.swap(spare().depths);
    if (worthKeeping(cells_, spare().cells)) cells_.swap(spare().cells);
  }
  TransparentLayers(const TransparentLayers&) = delete;

  size_t count() const { return count_; }
  TransparentLayer& layer(size_t i) { return list_[i]; }
  const TransparentLayer& layer(size_t i) const { return list_[i]; }
  size_t width() const { return width_; }  ///< Number of lanes of each layer, a multiple of kLanes.
  size_t wordsOfPixel() const { return words_; }
  /// Return a depth key and a cell for each lane of a layer; kUncovered_d and kNoCell where it covers none.
  float* depths(size_t layer) { return depths_.data() + layer * width_; }
  const float* depths(size_t layer) const { return depths_.data() + layer * width_; }
  uint32_t* cells(size_t layer) { return cells_.data() + layer * width_; }
  const uint32_t* cells(size_t layer) const { return cells_.data() + layer * width_; }

  /// Begins a grid: layers of the next grid hold no cells of those before. object: TransparentLayer::object.
  void beginGrid(int object = -1) {
    firstOfGrid_ = count_;
    object_ = object;
  }
  /// Reserves memory for `more` layers. take() never allocates: a call there would spill all vectors of its caller's
  /// loops.
  void makeRoom(size_t more) {
    const size_t layers = count_ + more;
    if (list_.size() < layers) list_.resize(2 * layers);
    if (depths_.size() < layers * width_) depths_.resize(2 * layers * width_);
    if (cells_.size() < layers * width_) cells_.resize(2 * layers * width_);
  }
  /// Returns the layer of the current grid that gets these samples of a cell: the last one of that word, or a new one
  /// if that holds one of them. The layer's `samples` are updated, but its depths and cells are the caller's to write;
  /// a new layer is not initialised. Pre: there is room.
  uint32_t take(uint32_t word, uint64_t samples) {
    uint32_t& last = last_[word];
    if (last - firstOfGrid_ < count_ - firstOfGrid_ && (list_[last].samples & samples) == 0) {
      list_[last].samples |= samples;
      return last;
    }
    list_[count_] = {word, object_, samples};
    return last = count_++;
  }

  /// Removes samples from a layer.
  void drop(size_t layer, uint64_t samples) {
    list_[layer].samples &= ~samples;
    for (; samples; samples &= samples - 1) cells(layer)[std::countr_zero(samples)] = kNoCell;
  }

  /// Adds samples one by one: those of a cell stay together until the next flush().
  void add(uint32_t word, uint32_t sample, uint32_t cell, float depth) {
    if (word != openWord_ || cell != openCell_) flush();
    openWord_ = word;
    openCell_ = cell;
    open_ |= uint64_t{1} << sample;
    openDepths_[sample] = depth;
  }
  void flush() {
    if (open_ == 0) return;
    makeRoom(1);
    const uint32_t layer = take(openWord_, open_);
    if (list_[layer].samples == open_) {
      std::fill_n(depths(layer), width_, kUncovered_d);
      std::fill_n(cells(layer), width_, kNoCell);
    }
    for (; open_; open_ &= open_ - 1) {
      const int s = std::countr_zero(open_);
      depths(layer)[s] = openDepths_[s];
      cells(layer)[s] = openCell_;
    }
  }

 private:
  static constexpr size_t kMostKept_bytes = size_t{32} << 20;
  template <class T>
  static bool worthKeeping(const T& mine, const T& kept) {
    return mine.capacity() > kept.capacity() && mine.capacity() * sizeof(typename T::value_type) <= kMostKept_bytes;
  }
  struct Spare {
    UnsetVector<TransparentLayer> list;
    UnsetVector<float> depths;
    UnsetVector<uint32_t> cells;
  };
  static Spare& spare() {
    static thread_local Spare ofThread;
    return ofThread;
  }

  const size_t width_, words_;
  UnsetVector<TransparentLayer> list_;
  UnsetVector<float> depths_;
  UnsetVector<uint32_t> cells_;
  std::vector<uint32_t> last_;  ///< The last layer of each word; kNone before there is one.
  uint32_t count_ = 0, firstOfGrid_ = 0;
  int object_ = -1;
  uint64_t open_ = 0;
  uint32_t openWord_ = 0, openCell_ = 0;
  float openDepths_[64];
};

}  // namespace tomales
