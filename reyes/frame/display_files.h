// Private to the frame: the files of all its Displays.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "reyes/frame.h"

namespace tomales {

/// The files of the Displays, and the rows that wait to be written to them.
class DisplayFiles {
 public:
  explicit DisplayFiles(Stats& stats) : stats_(stats) {}
  void add(std::unique_ptr<DisplayFile> file) { files_.push_back(std::move(file)); }

  /// Pre: no rows are being written.
  void take(Image rows, const FrameFilter& filter, int y0, int y1) {
    for (const auto& file : files_) {
      const std::optional<DeepMerge> merge = file->deep();
      deep_.push_back(merge ? filter.deepRows(y0, y1, *merge) : DeepRows{});
    }
    rows_ = std::move(rows);
  }
  void write() {
    if (!rows_) return;
    const StageTimer timer(stats_, "write", threadCpuSeconds);
    for (size_t i = 0; i < files_.size(); ++i)
      files_[i]->deep() ? files_[i]->write(deep_[i]) : files_[i]->write(*rows_);
    rows_.reset();
    deep_.clear();
  }
  void close(float finished) {
    write();
    const StageTimer timer(stats_, "write", threadCpuSeconds);
    for (const auto& file : files_)
      if (file->close(finished)) stats_.addOutput(file->written());
  }

 private:
  Stats& stats_;
  std::vector<std::unique_ptr<DisplayFile>> files_;
  std::optional<Image> rows_;
  std::vector<DeepRows> deep_;  ///< Indexed by file.
};

}  // namespace tomales
