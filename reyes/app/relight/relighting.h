// A shot that is lit again and again: the picture's share by each group of lights, and the whole under the present
// edit. It shades what an edit makes old in a thread of its own, near the pointer first, and gives an edit that makes
// the running work useless precedence over it. Threads: any may call the members.
#pragma once
#include <atomic>
#include <thread>

#include "reyes/app/frame/shot.h"
#include "reyes/app/frame/tile_store.h"
#include "reyes/app/relight/edit_state.h"
#include "reyes/app/relight/layers.h"
#include "reyes/base/temporary_folder.h"

namespace tomales {

inline vec3 colorAt(const Image& rows, int x, int y) {
  const float* p = rows.at(x, y);
  return {p[0], p[1], p[2]};
}

class Relighting {
 public:
  Relighting(const RenderSettings& settings, Stats& stats, Log& log);
  ~Relighting();

  /// Opens the shot and, without --irradiance, gathers its light first. Returns false if a file cannot be read, which
  /// is reported. To be called once, before any other member.
  bool prepare();
  /// Begins to shade.
  void start();
  /// The shot, its lights and its shaders, and what the layers are.
  Json description() const;
  /// What is being done, and for each layer the edit that it was last shaded under.
  Json status() const;
  const LayerStore& layers() const { return *layers_; }

  /// Makes this the present edit. Throws BadRequest if the shot has nothing of that kind.
  void edit(const Json& state);
  EditState present() const;
  const Editable& editable() const { return editable_; }
  /// Parts near this pixel come first from now on.
  void pointAt(int x, int y);
  /// Asks for the picture under the present edit, as `tomales shade --edit` makes it.
  void askForWhole();
  /// The floats R G B of the finished picture, row by row; empty if the present edit has not been shaded yet.
  std::vector<float> whole() const;
  /// What the pixel shows: the nearest object, and its surface shader.
  Json objectAt(int x, int y) const;

 private:
  /// The whole picture is layer 0, what shines by itself is layer 1.
  struct Layer {
    std::string name;
    std::optional<std::string> lights;  ///< The group whose light it is, empty for none; not given: all.
    bool indirect = true;
    std::vector<std::string> handles{};  ///< Names of the group's lights.
    std::optional<EditState> shaded{};   ///< The edit that it holds; not given: none yet.
    std::optional<EditState> begun{};    ///< The edit that is being shaded.
    uint32_t version = 0;                ///< Counts the passes that have begun.
  };
  struct Pass {
    size_t layer;
    EditState state;
  };

  void listLayers(const ShotJob& job);
  /// The part of an edit that a layer depends on other than by a factor.
  EditState relevant(const Layer& layer, const EditState& state) const;
  bool isOld(const Layer& layer, const std::optional<EditState>& held) const;
  std::optional<Pass> next() const;
  void work();
  void run(const Pass& pass);
  ShotJob& jobFor(const EditState& state);
  std::vector<PixelRect> parts() const;
  void take(size_t layer, const Image& rows);
  void checkLinearity();
  ShownTiles plainTiles();
  /// The shade group of the nearest thing at a raster pixel.
  std::optional<int> groupAt(int x, int y) const;

  RenderSettings settings_;
  Stats& stats_;
  Log& log_;
  const TemporaryFolder folder_;
  std::shared_ptr<ShotFiles> files_;
  std::unique_ptr<TileStore> tiles_;
  std::unique_ptr<ShotJob> job_;
  std::string textOfJob_;
  Editable editable_;
  PixelRect window_;
  bool sharesBounces_ = true;  ///< The records tell which light has bounced.
  std::unique_ptr<LayerStore> layers_;

  mutable std::mutex mutex_;  ///< Guards what follows.
  std::condition_variable changed_;
  std::vector<Layer> list_;
  EditState present_;
  bool wantsWhole_ = true;
  int pointerX_ = 0, pointerY_ = 0;
  std::string doing_;
  float done_ = 0;
  std::optional<size_t> running_;
  bool ended_ = false;
  std::vector<std::string> notLinear_;
  bool checked_ = false;

  std::vector<vec3> glow_;      ///< Layer 1 in full floats; the thread's own.
  std::vector<vec3> finished_;  ///< The finished whole picture; guarded.
  std::atomic<bool> cancel_{false};
  std::thread thread_;
};

}  // namespace tomales
