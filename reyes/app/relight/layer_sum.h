// Checks that the layers, each times a gain, add up to the picture under lights with these gains. Threads: plain
// object.
#pragma once
#include "reyes/app/relight/edit_session.h"
#include "reyes/app/relight/layer_pictures.h"
#include "reyes/app/relight/relit_shot.h"

namespace tomales {

class LayerSum {
 public:
  /// Chooses gains for the lights of an edit. All arguments but `edit` must outlive this object.
  LayerSum(const EditState& edit, const EditSession& session, const LayerStore& layers, RelitShot& shot);

  /// Returns the edit with lights of these gains.
  const EditState& edit() const { return edit_; }
  /// Compares rows that were shaded under edit() with the layers.
  void compare(const Image& rows);
  /// Forgets the buckets of rows that have been compared.
  void forgetBuckets() { buckets_.clear(); }
  /// Returns the names of objects at whose pixels the light does not add up.
  std::vector<std::string> objectsOff() const;

 private:
  bool isOff(const Image& rows, int x, int y) const;
  std::string objectAt(int x, int y);

  EditState edit_;
  std::vector<vec3> weights_;  ///< Each layer but the last has one.
  const LayerStore& layers_;
  RelitShot& shot_;
  std::map<size_t, std::shared_ptr<const DeepTile>> buckets_;
  std::map<std::string, int> pixelsOff_;  ///< Indexed by name.
};

}  // namespace tomales
