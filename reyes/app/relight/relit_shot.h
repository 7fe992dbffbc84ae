// A shot whose light is edited: its files, the records that light it, and the job that shades it under one edit.
// Threads: files() and editable() may be called by any; all else belongs to the thread that shades.
#pragma once
#include "reyes/app/frame/shot.h"
#include "reyes/app/frame/tile_store.h"
#include "reyes/app/relight/edit_state.h"
#include "reyes/base/temporary_folder.h"

namespace tomales {

class RelitShot {
 public:
  RelitShot(const RenderSettings& settings, Stats& stats, Log& log);

  /// Opens the shot and, without --irradiance, gathers its light first. Returns a job for reading, which must be
  /// destroyed before jobFor() or gather() makes another; null if a file cannot be read, which is reported, or if it
  /// was interrupted.
  std::unique_ptr<ShotJob> open();
  /// Returns the edit of the command line, which becomes part of what a page saves.
  EditState takeGivenEdit();

  std::shared_ptr<const ShotFiles> files() const;
  const Editable& editable() const { return *editable_; }

  /// Returns the job that shades the shot under this edit. It shows the picture, and the variable if one is named. The
  /// next call of this or of gather() ends it. Throws if the edit cannot be applied.
  ShotJob& jobFor(const EditState& edit, const std::string& variable = "");
  /// Returns the names of lights and objects whose bounced light is of another edit than that of the job.
  const std::vector<std::string>& staleLight() const { return staleLight_; }
  /// Makes the records of these pixels anew under an edit, as `tomales gather --crop` does. Returns the file of the
  /// records that the shot is lit by now; empty if none were made.
  std::string gather(const EditState& edit, const PixelRect& pixels);
  /// Returns a hidden bucket; null if it is damaged, which is reported.
  std::shared_ptr<const DeepTile> tile(size_t bucket) { return tiles_->read(bucket); }

 private:
  bool gatherFirst();
  bool openFiles();
  std::string writeEdit(const EditState& edit) const;  ///< Returns the name of the file.

  RenderSettings settings_;
  Stats& stats_;
  Log& log_;
  const TemporaryFolder folder_;
  mutable std::mutex mutex_;          ///< Guards the pointer to the files.
  std::shared_ptr<ShotFiles> files_;  ///< Only the shading thread changes it, so that thread reads it without the lock.
  std::unique_ptr<TileStore> tiles_;
  std::unique_ptr<ShotJob> job_;
  std::string textOfJob_;  ///< The edit of job_, and its variable.
  std::vector<std::string> staleLight_;
  std::unique_ptr<Editable> editable_;
  int gatherings_ = 0;
};

/// Returns the attributes of the nearest thing at a raster pixel of a bucket; null if there is none.
const Attributes* nearestAt(const Shot& shot, const DeepTile& tile, int x, int y);

}  // namespace tomales
