// The files that a shot is shaded from: a .dfb, and an .icf if one is given. It also keeps shaders and geometry once
// they are loaded. Several edits of the shot may use them, one after the other.
#pragma once
#include "gi/icf.h"
#include "reyes/app/frame/ray_world.h"
#include "reyes/app/settings.h"
#include "reyes/dfb.h"

namespace tomales {

inline SourceLoc wholeFile(const std::string& path) { return {std::make_shared<std::string>(path), 0}; }

class ShotFiles {
 public:
  /// Opens InputSettings::files and StoredLightSettings::irradiance. Returns null if one of them cannot be read, which
  /// is reported.
  static std::shared_ptr<ShotFiles> open(const RenderSettings& settings, Log& log);

  const DfbFile& dfb() const { return *dfb_; }
  bool hasIrradiance() const { return icf_ != nullptr; }
  /// Pre: hasIrradiance(). Its caches are lent to one shading of the shot at a time.
  IrradianceShot& irradiance() { return irradiance_; }
  const IrradianceShot& irradiance() const { return irradiance_; }
  /// Returns a checksum of the records and their settings; 0 without an .icf.
  uint64_t irradianceSum() const { return icf_ ? icf_->sum() : 0; }
  /// Tells whether the .icf was gathered for this shot. Only then are its answers of rays, if it has any, valid.
  bool isOfShot() const { return icf_ && irradiance_.shot == dfb_->shotSum(); }
  /// Returns nothing if they are damaged, which `error` explains. Pre: isOfShot().
  std::optional<std::vector<RayAnswers>> answers(size_t tile, std::string& error) const {
    return icf_->answers(tile, error);
  }
  /// Returns a tile with its answers; nothing if the bucket is damaged, which is reported. Threads: any.
  std::optional<DeepTile> load(size_t tile, Log& log) const;
  /// Its shaders are there once the shot has been prepared, and its geometry once a ray was wanted.
  KeptGeometry& kept() { return kept_; }

 private:
  ShotFiles() = default;
  std::string dfbPath_, icfPath_;
  std::unique_ptr<DfbFile> dfb_;
  std::unique_ptr<IcfFile> icf_;
  IrradianceShot irradiance_;
  KeptGeometry kept_;
};

}  // namespace tomales
