#include "reyes/app/frame/shot_files.h"

namespace tomales {

std::shared_ptr<ShotFiles> ShotFiles::open(const RenderSettings& settings, Log& log) {
  std::shared_ptr<ShotFiles> out(new ShotFiles);
  out->dfbPath_ = settings.input.files.front();
  out->icfPath_ = settings.stored.irradiance;
  std::string error;
  out->dfb_ = DfbFile::open(out->dfbPath_, error);
  if (!out->dfb_) {
    log.report(Severity::Error, "dfb-read", wholeFile(out->dfbPath_),
               "cannot be read as a deep frame buffer: " + error);
    return nullptr;
  }
  if (out->icfPath_.empty()) return out;
  out->icf_ = IcfFile::open(out->icfPath_, error);
  if (!out->icf_) {
    log.report(Severity::Error, "icf-read", wholeFile(out->icfPath_),
               "cannot be read as an irradiance cache: " + error);
    return nullptr;
  }
  out->irradiance_ = out->icf_->takeShot();
  if (!out->isOfShot())
    log.report(Severity::Warning, "icf-shot", wholeFile(out->icfPath_),
               "was gathered for another shot: its irradiance is used, its shadows are not");
  return out;
}

std::optional<DeepTile> ShotFiles::load(size_t tile, Log& log) const {
  std::string error;
  auto out = dfb_->tile(tile, error);
  if (!out) {
    log.report(Severity::Error, "dfb-bucket", wholeFile(dfbPath_),
               "bucket " + std::to_string(tile) + " is left out of the picture: " + error);
    return out;
  }
  if (!isOfShot()) return out;
  if (auto known = answers(tile, error)) {
    out->answers = std::move(*known);
  } else {
    log.report(Severity::Error, "icf-bucket", wholeFile(icfPath_),
               "the shadows of bucket " + std::to_string(tile) + " are traced anew: " + error);
  }
  return out;
}

}  // namespace tomales
