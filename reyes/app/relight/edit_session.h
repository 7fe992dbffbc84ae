// The state of a relighting that pages and the shading thread share: the layers with the present edit, the order of
// work, the running step, and the results. An edit that makes the running step useless ends it. One lock of this class
// guards all of it. Threads: any.
#pragma once
#include <condition_variable>

#include "reyes/app/relight/work_order.h"
#include "reyes/base/stop.h"

namespace tomales {

class EditSession {
 public:
  /// `parts` must outlive it.
  EditSession(EditedLayers layers, const PictureParts& parts);

  // For pages. Pixels are those of the raster.
  void edit(const EditState& state);
  EditState present() const;
  void showVariable(const std::string& name);
  void pointAt(const ivec2& pixel);
  void shadeOnly(const std::optional<PixelRect>& pixels);
  void askForWhole();
  void askToGather(const PixelRect& pixels);
  bool isGathering() const;
  /// Returns the file of the records that have been gathered last; empty if there is none.
  std::string gatheredFile() const;
  /// Returns the layers but the last, by name and lights.
  Json layers() const;
  /// The member "imager" tells whether the present edit changes an imager.
  Json status() const;
  /// Calls `use`, with no edit meanwhile, if all parts of the layer show the present edit.
  void ifShown(size_t layer, const std::function<void()>& use) const;

  // For the thread that shades.
  /// Returns the next step, which runs until finish(); nothing if all is done, or after end().
  std::optional<WorkStep> begin();
  /// Ends the running step, which counts as done unless it was stopped. Returns true if its layer has no outdated parts
  /// any more.
  bool finish();
  /// Waits, after begin() has returned nothing, until a page has asked for something or end() is called.
  void wait();
  /// Asks for a stop once the running step is of no use any more.
  StopToken stop() const { return stop_; }
  bool isRehearsed() const;
  size_t layerCount() const { return layers_.count(); }
  RelitLayer layer(size_t layer) const;
  /// Sets the names of lights and objects whose bounced light is of another edit.
  void setStale(std::vector<std::string> names);
  /// Sets the names of objects whose light does not add up, unless the running step was stopped.
  void setNotLinear(std::vector<std::string> names);
  /// Calls `show` to show a coarse layer, unless the running step was stopped.
  void takeCoarse(size_t layer, const std::function<void()>& show);
  /// Notes that pixels were gathered, which makes everything that has been shaded outdated.
  void takeGathered(const std::string& file, const PixelRect& pixels);

  /// Stops the running step; no other begins.
  void end();
  bool hasEnded() const;

 private:
  void tellThread();
  void stopIfUseless();

  const PictureParts& parts_;
  mutable std::mutex mutex_;  ///< Guards what follows.
  EditedLayers layers_;
  WorkOrder order_;
  std::optional<WorkStep> running_;
  std::atomic<bool> stop_{false};  ///< Set with the lock.
  std::vector<std::string> stale_, notLinear_;
  std::vector<PixelRect> gathered_;  ///< From the window's corner.
  std::string gatheredFile_;
  bool ended_ = false;
  std::condition_variable asked_;
  uint64_t timesAsked_ = 0, timesSeen_ = 0;
};

}  // namespace tomales
