#include "reyes/app/bucket_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "reyes/app/hide.h"

namespace tomales {

BucketFile::BucketFile(const Scene& scene, const DeepFrame& layout, int world, const RenderSettings& settings, Log& log)
    : picture_(scene.options.displays.front().name), layout_(layout), log_(log), resumes_(settings.resume) {
  if (!resumes_) return;
  const Shot shot{scene, layout_, settings.seed, sourcesOf(settings.files), std::filesystem::current_path().string(),
                  world};
  std::string error;
  file_ = DfbWriter::create(picture_ + ".dfb", shot, true, error);
  if (!file_)
    log.report(Severity::Warning, "resume", {}, "buckets cannot be kept for --resume: " + error);
  else
    log.report(Severity::Info, "resume", {},
               fmt::format("{} of {} buckets were finished before", file_->tilesKept(), layout_.tileCount()));
}

void BucketFile::keepForResume(size_t index, const DeepTile& tile) {
  if (resumes_ && file_ && !file_->has(index) && !file_->write(index, tile))
    log_.report(Severity::Warning, "resume", {}, "buckets cannot be kept for --resume: " + file_->error());
}

void BucketFile::spill(size_t index, const DeepTile& tile) {
  std::string error;
  {
    const std::lock_guard lock(opening_);
    if (!file_) file_ = openUnnamed(error);
  }
  if (!file_ || (!file_->has(index) && !file_->write(index, tile)))
    log_.report(Severity::Output, "spill", {},
                "the frame's buckets do not fit into memory, nor into a file beside \"" + picture_ +
                    "\", and some are left out: " + (file_ ? file_->error() : error));
  ++spilled_;
}

void BucketFile::forget() {
  std::error_code problem;
  if (file_) std::filesystem::remove(file_->temporary(), problem);
}

std::unique_ptr<DfbWriter> BucketFile::openUnnamed(std::string& error) const {
  Shot layoutAlone;
  layoutAlone.frame = layout_;
  auto file = DfbWriter::create(fmt::format("{}.{}.dfb", picture_, ::getpid()), layoutAlone, false, error);
  std::error_code problem;
  if (file) std::filesystem::remove(file->temporary(), problem);
  return file;
}

}  // namespace tomales
