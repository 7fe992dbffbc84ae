// A shot that is lit again and again: the picture's share by each group of lights, and the whole under the present
// edit. A thread of its own shades what an edit makes old: first coarse, then near the pointer. An edit that makes the
// running work useless ends that work. Threads: any may call the members.
#pragma once
#include <atomic>
#include <chrono>
#include <thread>

#include "reyes/app/frame/shot.h"
#include "reyes/app/frame/tile_store.h"
#include "reyes/app/relight/edit_state.h"
#include "reyes/app/relight/layer_parts.h"
#include "reyes/app/relight/layers.h"
#include "reyes/app/relight/sketch_points.h"
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

  /// Opens the shot, after a scene has been hidden, and, without --irradiance, gathers its light first. Returns false
  /// if a file cannot be read, which is reported, or if it was interrupted. Call it once. Until it has returned, only
  /// preparation() and tell() may be called, from any thread.
  bool prepare();
  /// Returns what prepare() is doing: "doing", and "done" from 0 to 1.
  Json preparation() const;
  /// Sets what preparation() returns. Threads: any.
  void tell(const char* doing, float done);
  /// Begins to shade.
  void start();
  /// Returns the shot, what may be changed of it, and what the layers are.
  Json description() const;
  /// Returns the shaders that may take the place of others, and one of them. Throws BadRequest if there is none.
  Json offered() const;
  Json offeredShader(const std::string& kind, const std::string& name) const;
  /// Returns what is being done, and for each layer what it shows.
  Json status() const;
  const LayerStore& layers() const { return *layers_; }

  /// Makes this the present edit. Throws BadRequest if the shot has nothing of that kind.
  void edit(const Json& state);
  EditState present() const;
  const Editable& editable() const { return *editable_; }
  /// Parts near this pixel come first from now on.
  void pointAt(int x, int y);
  /// Nothing outside of these pixels is shaded from now on; empty: all is.
  void shadeOnly(const std::optional<PixelRect>& pixels);
  /// Asks for the picture under the present edit, as `tomales shade --edit` makes it.
  void askForWhole();
  /// Asks for a variable of surfaces or a channel of the scene in the last layer; empty for none. Throws BadRequest if
  /// the shot has none of this name.
  void askForVariable(const std::string& name);
  /// Asks for the bounced light of these pixels to be gathered under the present edit.
  void askToGather(const PixelRect& pixels);
  bool isGathering() const;
  /// Returns the floats R G B of the finished picture, row by row; empty if the present edit has not been shaded yet.
  std::vector<float> whole();
  /// Returns what the pixel shows: the nearest object, and its surface shader.
  Json objectAt(int x, int y) const;
  /// Returns the file of the records that the picture is shaded with, if some of them were gathered here; empty: those
  /// that were given.
  std::string gatheredFile() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// The whole picture is layer 0, what shines by itself is layer 1, the last is a variable.
  struct Layer {
    std::string name;
    std::optional<std::string> lights;  ///< The group whose light it is, empty for none; not given: all.
    bool indirect = true;
    std::vector<std::string> handles{};  ///< Names of the group's lights.
    LayerParts parts{};
    uint32_t coarse = 0;          ///< Number of the edit that its coarse picture shows.
    Clock::time_point changed{};  ///< Time when another edit was wanted.
  };
  /// One step of the work.
  struct Step {
    enum Kind { Part, Coarse, Gather, Check, Rehearse } kind;
    size_t layer = 0, part = 0;
    uint32_t number = 0;  ///< LayerParts::wanted() when it begins.
    EditState edit{};
    std::string variable{};
    PixelRect pixels{};
  };
  /// A shaded bucket that parts of a layer share.
  struct SharedTile {
    std::shared_ptr<const DeepTile> outline;  ///< The bucket without points and colours, which all layers share.
    std::vector<ShadedPoints> shaded;
  };
  struct SharedTiles {
    uint32_t number = 0;
    std::map<size_t, SharedTile> tiles;
  };

  bool openFiles();
  /// Returns the files for threads other than its own.
  std::shared_ptr<const ShotFiles> files() const {
    const std::lock_guard lock(mutex_);
    return files_;
  }
  void takeGivenEdits();
  void listLayers(const ShotJob& job);
  void layOutParts();
  size_t partOfBucket(size_t bucket) const;
  PixelRect insideOfWindow(const PixelRect& pixels) const;

  // These find the edit that each layer shows.
  bool isMixed(const Layer& layer, const std::string& handle) const;
  EditState editFor(const Layer& layer) const;
  std::string textFor(const Layer& layer) const;
  void wantPresent();

  // These belong to the thread that shades.
  std::optional<Step> next() const;
  std::optional<Step> nextPart(size_t from, size_t to) const;
  Step stepFor(Step::Kind kind, size_t layer, size_t part = 0) const;
  bool isWantedStill(const Step& step) const;
  void work();
  void run(const Step& step);
  void finish(const Step& step);
  void shadePart(const Step& step);
  void shadeCoarse(const Step& step);
  void rehearse(const Step& step);
  void gather(const Step& step);
  void checkLinearity(const Step& step);
  ShotJob& jobFor(const EditState& edit, const std::string& variable = "");
  std::string writeEdit(const EditState& edit) const;  ///< Returns the name of the file.
  void take(const Step& step, const Image& rows);
  std::shared_ptr<const DeepTile> outlineOf(size_t bucket, const DeepTile& tile);
  bool isNeededBesides(const Layer& layer, size_t bucket, size_t part) const;
  ShownTiles plainTiles();
  size_t placeOf(int x, int y) const;

  RenderSettings settings_;
  Stats& stats_;
  Log& log_;
  const TemporaryFolder folder_;
  std::shared_ptr<ShotFiles> files_;  ///< Changed by the thread with the mutex locked.
  std::unique_ptr<TileStore> tiles_;
  std::unique_ptr<ShotJob> job_;
  std::string textOfJob_;
  std::unique_ptr<Editable> editable_;
  PixelRect window_;
  ivec2 partGrid_{1, 1};
  std::vector<PixelRect> parts_;
  bool sharesBounces_ = true;  ///< The records tell which light has bounced.
  std::unique_ptr<LayerStore> layers_;
  std::unique_ptr<SketchPoints> sketch_;

  mutable std::mutex mutex_;  ///< Guards what follows.
  std::condition_variable changed_;
  std::vector<Layer> list_;
  EditState present_;
  std::optional<PixelRect> only_;
  std::optional<PixelRect> toGather_;
  std::vector<PixelRect> gathered_;
  std::vector<std::string> stale_;
  std::string variable_;
  bool wantsWhole_ = true;
  bool sketches_ = false;  ///< The first picture is there, and the rays of the coarse one are known.
  int pointerX_ = 0, pointerY_ = 0;
  std::string doing_;
  float done_ = 0;
  std::optional<Step> running_;
  bool ended_ = false;
  std::vector<std::string> notLinear_;
  bool checked_ = false;
  std::string gatheredFile_;
  Image finished_;  ///< The whole picture before exposure and imager.

  std::vector<SharedTiles> shared_;  ///< Indexed by layer; guarded, like outlines_, by a mutex of its own.
  std::map<size_t, std::weak_ptr<const DeepTile>> outlines_;
  std::mutex sharing_;
  std::vector<vec3> glow_;        ///< Layer 1 in full floats; the thread's own.
  std::vector<vec3> coarseGlow_;  ///< The same, coarse.
  std::atomic<bool> cancel_{false};
  std::thread thread_;
};

}  // namespace tomales
