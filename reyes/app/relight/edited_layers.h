// The layers of a picture that is relit: whose light each of them shows, and under which edit, which may not be the
// present one yet. Threads: plain object.
#pragma once
#include "reyes/app/frame/shot.h"
#include "reyes/app/relight/edit_state.h"
#include "reyes/app/relight/layer_parts.h"

namespace tomales {

/// Indices of layers: the whole picture, the glow of surfaces and air by themselves, and the first group of lights. The
/// last layer shows a variable.
constexpr size_t kWhole = 0, kGlow = 1, kFirstLight = 2;

struct RelitLayer {
  std::string name;
  std::optional<std::string> lights;  ///< The group whose light it shows; empty: no light; not given: all lights.
  bool indirect = true;
  std::vector<std::string> handles{};  ///< Names of the group's lights.
  LayerParts parts{};
  uint32_t coarse = 0;  ///< Number of the edit that its coarse picture shows.
};

/// Tells whether the records know which light has bounced.
bool sharesBounces(const ShotJob& job);
std::vector<RelitLayer> layersOf(const ShotJob& job, size_t parts);

class EditedLayers {
 public:
  /// `editable` must outlive it.
  EditedLayers(std::vector<RelitLayer> layers, const Editable& editable, EditState present);

  size_t count() const { return layers_.size(); }
  size_t variableLayer() const { return layers_.size() - 1; }
  const RelitLayer& operator[](size_t layer) const { return layers_[layer]; }
  RelitLayer& operator[](size_t layer) { return layers_[layer]; }
  auto begin() { return layers_.begin(); }
  auto end() { return layers_.end(); }

  const EditState& present() const { return present_; }
  void edit(EditState present);
  /// Returns what the last layer shows; empty for nothing.
  const std::string& variable() const { return variable_; }
  void showVariable(std::string name);

  /// Returns the edit that a layer is shaded under.
  EditState editFor(size_t layer) const;
  /// Returns the factor of a layer's light when it was shaded, if the page mixes that light by a factor.
  vec3 unitOf(size_t layer) const;

 private:
  std::string textFor(size_t layer) const;
  void wantPresent();

  std::vector<RelitLayer> layers_;
  const Editable& editable_;
  EditState present_;
  std::string variable_;
};

}  // namespace tomales
