#include "reyes/dfb.h"

#include "reyes/dfb/scene_fields.h"
#include "reyes/dfb/tile.h"

namespace tomales {
namespace {

constexpr RecordName kShotRecord{1, 0};
constexpr uint32_t kTileRecords = 2;

RecordName tileRecord(size_t tile) { return {kTileRecords, static_cast<uint32_t>(tile)}; }

RecordFileKind dfbKind() {
  SchemaSum schema;
  schema.add(schemaOf<Shot>());
  schema.add(tileSchema());
  return {"TomalDFB", 1, schema.sum};
}

/// One empty object for each group, so that messages still name an object and its place.
Scene withoutGeometry(const Scene& scene) {
  Scene out = scene.withoutObjects();
  out.groups = scene.groups;
  for (ShadeGroup& group : out.groups) {
    Object empty;
    empty.where = group.where;
    group.exampleObject = static_cast<int>(out.objects.size());
    out.objects.push_back(std::move(empty));
  }
  return out;
}

bool consistent(const Shot& shot) {
  const DeepFrame& f = shot.frame;
  const auto enough = [](int count, int size, int pixels) { return int64_t{count} * size >= pixels; };
  return f.bucketWidth > 0 && f.bucketHeight > 0 && f.columns >= 0 && f.rows >= 0 && f.samplesPerPixel > 0 &&
         int64_t{f.columns} * f.rows <= kMostTiles && enough(f.columns, f.bucketWidth, f.padded.width()) &&
         enough(f.rows, f.bucketHeight, f.padded.height()) && shot.scene.objects.size() == shot.scene.groups.size();
}

}  // namespace

std::unique_ptr<DfbWriter> DfbWriter::create(const std::string& path, const Shot& shot, Unfinished unfinished,
                                             std::string& error) {
  auto records = RecordWriter::create(path, dfbKind(), unfinished, error);
  if (!records) return nullptr;
  const Bytes packed =
      pack(Shot{withoutGeometry(shot.scene), shot.frame, shot.seed, shot.sources, shot.folder, shot.world});
  std::unique_ptr<DfbWriter> writer(new DfbWriter(std::move(records)));
  const auto kept = writer->records_->read(kShotRecord);
  if (kept == packed) {
    for (size_t i = 0; i < shot.frame.tileCount(); ++i) writer->kept_ += writer->has(i);
    return writer;
  }
  if ((!kept || writer->records_->restart()) && writer->records_->write(kShotRecord, packed)) return writer;
  error = writer->error();
  return nullptr;
}

bool DfbWriter::has(size_t tile) const { return records_->has(tileRecord(tile)); }

std::optional<DeepTile> DfbWriter::tile(size_t index) const {
  const auto bytes = records_->read(tileRecord(index));
  return bytes ? unpackTile(*bytes) : std::nullopt;
}

bool DfbWriter::write(size_t index, const DeepTile& tile) { return records_->write(tileRecord(index), packTile(tile)); }

bool DfbWriter::finish() { return records_->finish(); }

std::unique_ptr<DfbFile> DfbFile::open(const std::string& path, std::string& error) {
  std::unique_ptr<DfbFile> file(new DfbFile);
  file->records_ = RecordFile::open(path, dfbKind(), error);
  if (!file->records_) return nullptr;
  const auto packed = file->records_->read(kShotRecord, error);
  if (!packed) return nullptr;
  if (!unpack(*packed, file->shot_) || !consistent(file->shot_)) {
    error = "its description of the shot is damaged";
    return nullptr;
  }
  file->shotSum_ = checksum(*packed);
  return file;
}

std::optional<DeepTile> DfbFile::tile(size_t index, std::string& error) const {
  const auto bytes = records_->read(tileRecord(index), error);
  if (!bytes) return std::nullopt;
  auto tile = unpackTile(*bytes);
  const auto known = [&](const ShadePoints& p) {
    return p.group() >= 0 && p.group() < static_cast<int>(shot_.scene.groups.size());
  };
  if (tile && std::all_of(tile->batches.begin(), tile->batches.end(), known)) return tile;
  error = "a bucket does not fit its shot";
  return std::nullopt;
}

}  // namespace tomales
