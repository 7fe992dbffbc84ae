// Noun and file: the irradiance cache of a shot (.icf, docs/dfb.md), and the answers that rays gave when it was shaded.
// With it a .dfb is shaded without a ray: indirect light comes from the records, shadows and emitters from the answers.
// Threads: answers may be written and read concurrently.
#pragma once
#include "gi/point_cloud.h"
#include "gi/services.h"
#include "reyes/base/record_file.h"

namespace tomales {

/// The whole file except for the answers.
struct IrradianceShot {
  uint64_t shot = 0;  ///< DfbFile::shotSum() of the shot that the answers and `learnt` belong to; 0 if there is none.
  GiSettings settings;
  mat4 cameraFromWorld{1.0f};
  std::vector<PreparedCache> caches;  ///< Caches in camera space.
  /// Empty if an emitter is curved or cut by trim curves: sampling it needs its geometry.
  std::optional<EmitterTable> emitters;
  std::vector<std::shared_ptr<LightCall>> lights;  ///< Scene::lights as they were when the records were gathered.
  std::vector<std::string> groups;  ///< The groups of lights whose shares the records hold (GiServices::keepShares).
  std::shared_ptr<LearntLight> learnt;  ///< Light that was learnt in camera space, for this shot alone.
};

class IcfWriter {
 public:
  static std::unique_ptr<IcfWriter> create(const std::string& path, std::string& error);
  bool writeAnswers(size_t tile, const std::vector<RayAnswers>& answers);
  bool finish(const IrradianceShot& shot);
  std::string error() const { return records_->error(); }

 private:
  explicit IcfWriter(std::unique_ptr<RecordWriter> records) : records_(std::move(records)) {}
  std::unique_ptr<RecordWriter> records_;
};

class IcfFile {
 public:
  static std::unique_ptr<IcfFile> open(const std::string& path, std::string& error);
  IrradianceShot takeShot() { return std::move(shot_); }
  const IrradianceShot& shot() const { return shot_; }
  /// Returns the answers of one bucket, one for each batch; empty: the file has none. Null: they are damaged, which
  /// `error` explains.
  std::optional<std::vector<RayAnswers>> answers(size_t tile, std::string& error) const;
  /// Checks that the answers of every bucket are as they were written.
  bool intact(std::string& error) const;
  uint64_t size() const { return records_->size(); }
  uint64_t sum() const { return sum_; }  ///< Identifies the records and their settings.

 private:
  IcfFile() = default;
  std::unique_ptr<RecordFile> records_;
  uint64_t sum_ = 0;
  IrradianceShot shot_;
};

/// Returns the records of all caches as points in world space, with a radius of 0. Channels: "record", which is 1;
/// "irradiance" (E/pi), "closest" and "harmonicmean" (units of the world, 1e30 where rays meet nothing), "noise" (of
/// E/pi).
PointCloud recordsOf(const IrradianceShot& shot);

/// Moves records to the camera of another frame and drops `learnt`, which holds for one camera. If the camera is the
/// same, nothing changes.
void moveToCamera(IrradianceShot& shot, const mat4& cameraFromWorld);

}  // namespace tomales
