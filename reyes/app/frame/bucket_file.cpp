#include "reyes/app/frame/bucket_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "reyes/app/frame/hide.h"

namespace tomales {

BucketFile::BucketFile(const Scene& scene, const DeepFrame& layout, int world, const RenderSettings& settings, Log& log)
    : picture_(scene.options.displays.front().name), layout_(layout), log_(log), resumes_(settings.picture.resume) {
  if (!resumes_) return;
  const Shot shot{
      scene, layout_, settings.picture.seed, sourcesOf(settings.input.files), std::filesystem::current_path().string(),
      world};
  std::string error;
  file_ = DfbWriter::create(picture_ + ".dfb", shot, Unfinished::Resumed, error);
  if (!file_)
    log.report(Severity::Note, "resume", {}, "buckets cannot be kept for --resume: " + error);
  else
    log.report(Severity::Info, "resume", {},
               fmt::format("{} of {} buckets were finished before", file_->tilesKept(), layout_.tileCount()));
}

std::optional<DeepTile> BucketFile::tile(size_t index) const {
  const DfbWriter* const file = opened();
  return file ? file->tile(index) : std::nullopt;
}

DfbWriter* BucketFile::opened() const {
  const std::lock_guard lock(opening_);
  return file_.get();
}

void BucketFile::keepForResume(size_t index, const DeepTile& tile) {
  DfbWriter* const file = resumes_ ? opened() : nullptr;
  if (file && !file->has(index) && !file->write(index, tile))
    log_.report(Severity::Note, "resume", {}, "buckets cannot be kept for --resume: " + file->error());
}

void BucketFile::spill(size_t index, const DeepTile& tile) {
  std::string error;
  DfbWriter* file = nullptr;
  {
    const std::lock_guard lock(opening_);
    if (!file_) file_ = openUnnamed(error);
    file = file_.get();
  }
  if (!file || (!file->has(index) && !file->write(index, tile)))
    log_.report(Severity::Output, "spill", {},
                "the frame's buckets do not fit into memory, nor into a file beside \"" + picture_ +
                    "\", and some are left out: " + (file ? file->error() : error));
  else
    ++spilled_;
}

void BucketFile::forget() {
  if (file_) file_->discard();
}

std::unique_ptr<DfbWriter> BucketFile::openUnnamed(std::string& error) const {
  Shot layoutAlone;
  layoutAlone.frame = layout_;
  auto file = DfbWriter::create(picture_ + ".dfb", layoutAlone, Unfinished::Removed, error);
  if (file) file->discard();
  return file;
}

}  // namespace tomales
