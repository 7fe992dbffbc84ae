// A shot that is lit again and again: the picture's share by each group of lights, and the whole under the present
// edit. A thread of its own shades again what an edit makes outdated: first coarsely, then from the pointer outwards.
// EditSession holds what pages and that thread share. Threads: any may call the members.
#pragma once
#include <thread>

#include "reyes/app/relight/edit_session.h"
#include "reyes/app/relight/layer_pictures.h"
#include "reyes/app/relight/relit_shot.h"
#include "reyes/app/relight/shared_tiles.h"
#include "reyes/app/relight/sketch_points.h"
#include "reyes/app/relight/work_status.h"

namespace tomales {

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
  void tell(const char* doing, float done) { status_.tell(doing, done); }
  /// Begins to shade.
  void start();
  /// Returns the shot, what may be changed of it, and what the layers are.
  Json description() const;
  /// Returns the shaders that may take the place of others, and one of them. Throws BadRequest if there is none.
  Json offered() const;
  Json offeredShader(const std::string& kind, const std::string& name) const;
  /// Returns what is being done, and which edit each layer shows.
  Json status() const;
  const LayerStore& layers() const { return pictures_->store(); }

  /// Makes this the present edit. Throws BadRequest if the shot has nothing of that kind.
  void edit(const Json& state);
  EditState present() const { return session_->present(); }
  const Editable& editable() const { return shot_.editable(); }
  /// Parts near this pixel come first from now on.
  void pointAt(int x, int y);
  /// Only these pixels are shaded from now on; if not given, all are.
  void shadeOnly(const std::optional<PixelRect>& pixels);
  /// Asks for the picture under the present edit, as `tomales shade --edit` makes it.
  void askForWhole() { session_->askForWhole(); }
  /// Asks for a variable of surfaces or a channel of the scene in the last layer; empty for none. Throws BadRequest if
  /// the shot has none of this name.
  void askForVariable(const std::string& name);
  /// Asks for the bounced light of these pixels to be gathered under the present edit.
  void askToGather(const PixelRect& pixels);
  bool isGathering() const { return session_->isGathering(); }
  /// Returns the floats R G B of the finished picture, row by row; empty if the present edit has not been shaded yet.
  std::vector<float> whole() const;
  /// Returns what the pixel shows: the nearest object, and its surface shader.
  Json objectAt(int x, int y) const;
  /// Returns the file of the records that the picture is shaded with, if some of them were gathered here; empty: those
  /// that were given.
  std::string gatheredFile() const { return session_->gatheredFile(); }

 private:
  /// Returns the pixels by their raster coordinates. Throws BadRequest if they are outside of the picture.
  PixelRect insideOfWindow(const PixelRect& pixels) const;

  // These belong to the thread that shades.
  void work();
  void run(const WorkStep& step);
  void shadePart(const WorkStep& step);
  void shadeCoarse(const WorkStep& step);
  void rehearse(const WorkStep& step);
  void gather(const WorkStep& step);
  void checkLinearity(const WorkStep& step);
  ShotJob& jobFor(const EditState& edit, const std::string& variable = "");
  ShownTiles plainTiles();
  ShownTiles tilesOf(const WorkStep& step, const RelitLayer& layer);

  const std::string file_;  ///< The shot's, for pages.
  Log& log_;
  WorkStatus status_;
  RelitShot shot_;
  bool sharesBounces_ = true;  ///< The records know which light has bounced.
  // These are there once prepare() has returned.
  std::unique_ptr<PictureParts> parts_;
  std::unique_ptr<EditSession> session_;
  std::unique_ptr<LayerPictures> pictures_;
  std::unique_ptr<SketchPoints> sketch_;  ///< The thread's own, as the next one is.
  std::unique_ptr<SharedTiles> shared_;
  std::thread thread_;
};

}  // namespace tomales
