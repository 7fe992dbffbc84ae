#include "gi/icf.h"

#include "gi/frame/learnt_light.h"
#include "gi/frame/record_fields.h"
#include "gi/world_from_current.h"
#include "reyes/base/pack.h"
#include "reyes/state_fields.h"

namespace tomales {

// The compiler looks these functions up in the namespace of their structures, so they cannot stand in the unnamed one.
// The structured bindings make the compiler refuse a structure that has gained a field which its list lacks.
template <class A>
void fields(A& a, HemisphereQuery& x) {
  auto& [samples, maxDistance, bias, falloff, falloffMode, maxVariation, radiance, mode, diffuseLimit, subset,
         excludeSubset, sides] = x;
  each(a, samples, maxDistance, bias, falloff, falloffMode, maxVariation, radiance, mode, diffuseLimit, subset,
       excludeSubset, sides);
}

template <class A>
void fields(A& a, CacheKey& x) {
  auto& [cache, gather] = x;
  auto& [errorFunction, kappa, maxPixels, minPixels, minWeight] = cache;
  auto& [samples, maxDistance, seed, light, curvature, maxError, depth, indirect, specularRaysSeeLights, subset,
         asked] = gather;
  each(a, errorFunction, kappa, maxPixels, minPixels, minWeight, samples, maxDistance, seed, light, curvature, maxError,
       depth, indirect, specularRaysSeeLights, subset, asked);
}

template <class A>
void fields(A& a, EmitterLattice& x) {
  auto& [columns, rows, flips, quads, normals, curved, surface, firstQuad, group] = x;
  each(a, columns, rows, flips, quads, normals);
}

template <class A>
void fields(A& a, EmitterShape& x) {
  auto& [kind, center, u, v, normal, group] = x;
  each(a, kind, center, u, v, normal);
}

template <class A>
void fields(A& a, EmitterLight& x) {
  auto& [shapes, lattices, reach] = x;
  each(a, shapes, lattices, reach);
}

template <class A>
void fields(A& a, GiSettings& x) {
  auto& [mode, samples, bounces, maxError, seed, errorFunction, storesDirect] = x;
  each(a, mode, samples, bounces, maxError, seed, errorFunction, storesDirect);
}

template <class A>
void fields(A& a, ShadowQuestion& x) {
  auto& [subBatch, light, sample] = x;
  each(a, subBatch, light, sample);
}

template <class A>
void fields(A& a, ShadowAnswer& x) {
  auto& [asked, passed, parts] = x;
  each(a, asked, passed, parts);
}

template <class A>
void fields(A& a, IndirectAnswer& x) {
  auto& [E, dominant, shares] = x;
  each(a, E, dominant, shares);
}

template <class A>
void fields(A& a, RayAnswers& x) {
  each(a, x.shadows, x.indirect);
}

template <class A>
void fields(A& a, BrightSpots::Spot& x) {
  auto& [center, radius, radiance, normal, found, halfU, halfV] = x;
  each(a, center, radius, radiance, normal, found, halfU, halfV);
}

template <class A>
void fields(A& a, BounceCaches::Levels& x) {
  auto& [bound, records, groups, leastDistance] = x;
  each(a, bound.lo, bound.hi, records, groups, leastDistance);
}

namespace {

constexpr RecordName kShotRecord{1, 0};
constexpr uint32_t kAnswerRecords = 2;

/// A cache as it is stored: the octree is built again from the records.
struct StoredCache {
  CacheKey key;
  Bound3 bound;
  std::vector<IrradianceRecord> records;
  std::vector<uint64_t> frames;
};

struct StoredLearnt {
  std::vector<BrightSpots::Spot> spots;
  float irradianceOfSpots = 0;
  BounceCaches::Levels bounces;
};

struct StoredShot {
  uint64_t shot = 0;
  GiSettings settings;
  mat4 cameraFromWorld{1.0f};
  std::vector<StoredCache> caches;
  std::optional<EmitterTable> emitters;
  std::vector<std::shared_ptr<LightCall>> lights;
  std::vector<std::string> groups;
  StoredLearnt learnt;
};

template <class A>
void fields(A& a, StoredLearnt& x) {
  auto& [spots, irradianceOfSpots, bounces] = x;
  each(a, spots, irradianceOfSpots, bounces);
}

template <class A>
void fields(A& a, StoredCache& x) {
  each(a, x.key, x.bound.lo, x.bound.hi, x.records, x.frames);
}

template <class A>
void fields(A& a, StoredShot& x) {
  auto& [shot, settings, cameraFromWorld, caches, emitters, lights, groups, learnt] = x;
  each(a, shot, settings, cameraFromWorld, caches, emitters, lights, groups, learnt);
}

RecordFileKind icfKind() {
  SchemaSum schema;
  schema.add(schemaOf<StoredShot>());
  schema.add(schemaOf<RayAnswers>());
  return {"TomalICF", 1, schema.sum};
}

bool consistent(const StoredShot& stored) {
  for (const auto& light : stored.emitters.value_or(EmitterTable{}))
    for (const EmitterLattice& l : light.lattices) {
      const uint64_t quads = uint64_t{l.columns} * l.rows;
      if (l.quads.size() != quads || l.normals.size() != quads) return false;
    }
  const auto fits = [&](const IrradianceRecord& r) {
    return r.shares.empty() || r.shares.size() == stored.groups.size();
  };
  const BounceCaches::Levels& bounces = stored.learnt.bounces;
  const auto sharesAll = [&](const IrradianceRecord& r) { return r.shares.size() == bounces.groups.size(); };
  return std::ranges::all_of(stored.caches,
                             [&](const StoredCache& c) { return std::ranges::all_of(c.records, fits); }) &&
         std::ranges::all_of(bounces.records, [&](const auto& level) { return std::ranges::all_of(level, sharesAll); });
}

StoredLearnt storedForm(const LearntLight& learnt) {
  return {learnt.spots.spots(), learnt.spots.irradiance(), learnt.bounces.levels()};
}

std::shared_ptr<LearntLight> restored(StoredLearnt&& stored) {
  auto out = std::make_shared<LearntLight>();
  out->spots = BrightSpots(std::move(stored.spots), stored.irradianceOfSpots);
  out->bounces.restore(stored.bounces);
  return out;
}

}  // namespace

std::unique_ptr<IcfWriter> IcfWriter::create(const std::string& path, std::string& error) {
  auto records = RecordWriter::create(path, icfKind(), Unfinished::Removed, error);
  return records ? std::unique_ptr<IcfWriter>(new IcfWriter(std::move(records))) : nullptr;
}

bool IcfWriter::writeAnswers(size_t tile, const std::vector<RayAnswers>& answers) {
  return records_->write({kAnswerRecords, static_cast<uint32_t>(tile)}, pack(answers));
}

bool IcfWriter::finish(const IrradianceShot& shot) {
  StoredShot stored{shot.shot, shot.settings, shot.cameraFromWorld, {}, shot.emitters, shot.lights, shot.groups, {}};
  if (shot.learnt) stored.learnt = storedForm(*shot.learnt);
  const auto asksSurface = [](const EmitterLattice& l) { return l.surface != nullptr; };
  for (const auto& light : shot.emitters.value_or(EmitterTable{}))
    if (std::any_of(light.lattices.begin(), light.lattices.end(), asksSurface)) stored.emitters.reset();
  for (const PreparedCache& c : shot.caches)
    stored.caches.push_back({c.key, c.cache.bound(), {c.cache.records().begin(), c.cache.records().end()}, c.frames});
  return records_->write(kShotRecord, pack(stored)) && records_->finish();
}

std::unique_ptr<IcfFile> IcfFile::open(const std::string& path, std::string& error) {
  std::unique_ptr<IcfFile> file(new IcfFile);
  file->records_ = RecordFile::open(path, icfKind(), error);
  const auto packed = file->records_ ? file->records_->read(kShotRecord, error) : std::nullopt;
  if (!packed) return nullptr;
  file->sum_ = checksum(*packed);
  StoredShot stored;
  if (!unpack(*packed, stored) || !consistent(stored)) {
    error = "its description is damaged";
    return nullptr;
  }
  file->shot_ = {stored.shot,
                 stored.settings,
                 stored.cameraFromWorld,
                 {},
                 std::move(stored.emitters),
                 std::move(stored.lights),
                 std::move(stored.groups),
                 restored(std::move(stored.learnt))};
  for (const StoredCache& c : stored.caches) {
    IrradianceCache& cache =
        file->shot_.caches.emplace_back(PreparedCache{c.key, {c.bound, c.key.cache}, c.frames}).cache;
    for (const IrradianceRecord& record : c.records) cache.restore(record);
  }
  return file;
}

std::optional<std::vector<RayAnswers>> IcfFile::answers(size_t tile, std::string& error) const {
  const RecordName name{kAnswerRecords, static_cast<uint32_t>(tile)};
  std::vector<RayAnswers> out;
  if (!records_->has(name)) return out;
  const auto packed = records_->read(name, error);
  if (!packed) return std::nullopt;
  if (unpack(*packed, out)) return out;
  error = "a bucket is damaged";
  return std::nullopt;
}

bool IcfFile::intact(std::string& error) const {
  const std::vector<RecordName> names = records_->names();
  return std::all_of(names.begin(), names.end(), [&](const RecordName& name) {
    return name.kind == kAnswerRecords ? answers(name.index, error).has_value()
                                       : records_->read(name, error).has_value();
  });
}

PointCloud recordsOf(const IrradianceShot& shot) {
  PointCloud out;
  out.channels = {{"record", 1}, {"irradiance", 3}, {"closest", 1}, {"harmonicmean", 1}, {"noise", 1}};
  const WorldFromCurrent world(shot.cameraFromWorld);
  for (const PreparedCache& c : shot.caches)
    for (const IrradianceRecord& r : c.cache.records()) {
      const float data[] = {1,
                            r.light.E.x,
                            r.light.E.y,
                            r.light.E.z,
                            std::min(world.scale * r.closest, kRiInfinity),
                            std::min(world.scale * r.harmonicMean, kRiInfinity),
                            r.noise};
      out.add(transformPoint(world.points, r.position), glm::normalize(world.normals * r.normal), 0, data);
    }
  return out;
}

}  // namespace tomales
