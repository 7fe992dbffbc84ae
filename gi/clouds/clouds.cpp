#include "gi/clouds.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <numeric>

#include "gi/photons/irradiance.h"
#include "gi/point_file.h"
#include "reyes/base/output_root.h"
#include "reyes/base/search_path.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr float kMostIor = 3;  // The rational approximation of inner reflection holds for smaller values.

vec3 at(TmConstVec3 v, int i) { return {v.x[i], v.y[i], v.z[i]}; }

fs::path found(const std::string& file, const std::string& searchPath) {
  const std::string path = findFile(file, searchPath);
  return path.empty() ? file : path;
}

std::vector<CloudChannel> channelsOf(const std::vector<CloudValue>& values) {
  std::vector<CloudChannel> channels;
  for (const CloudValue& v : values) channels.push_back({v.name, v.floats});
  return channels;
}

/// Orders points by position, normal, radius and data.
bool comesBefore(const PointCloud& cloud, uint32_t a, uint32_t b) {
  const auto key = [&](uint32_t i) {
    const vec3 &p = cloud.position[i], &n = cloud.normal[i];
    return std::array{p.x, p.y, p.z, n.x, n.y, n.z, cloud.radius[i]};
  };
  const auto ka = key(a), kb = key(b);
  if (ka != kb) return ka < kb;
  const auto width = static_cast<size_t>(cloud.width());
  return std::lexicographical_compare(cloud.at(a), cloud.at(a) + width, cloud.at(b), cloud.at(b) + width);
}

/// Returns the sorted points without duplicates. A micropolygon on the border of buckets is shaded once in each of
/// them.
PointCloud sorted(const PointCloud& cloud) {
  std::vector<uint32_t> order(cloud.count());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return comesBefore(cloud, a, b); });
  // the points are sorted, so b never comes before a
  const auto same = [&](uint32_t a, uint32_t b) { return !comesBefore(cloud, a, b); };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  PointCloud out;
  out.channels = cloud.channels;
  out.reserve(order.size());
  for (const uint32_t i : order) out.add(cloud.position[i], cloud.normal[i], cloud.radius[i], cloud.at(i));
  return out;
}

/// Returns nothing if there is no material of this name.
std::optional<Translucency> materialOf(const TmSubsurfaceOptions& s) {
  const auto triple = [](const float(&v)[3]) { return vec3(v[0], v[1], v[2]); };
  if (s.material) return translucencyOf(s.material);
  if (s.meanFreePath[0] != 0) return translucencyOf(triple(s.albedo), triple(s.meanFreePath), s.ior);
  return Translucency{triple(s.scattering), triple(s.absorption), s.ior};
}

/// Returns why subsurface() cannot use these values; empty if it can.
std::string problemOf(const TmSubsurfaceOptions& given, const std::optional<Translucency>& material) {
  if (!material) return fmt::format("subsurface material \"{}\" is not known", given.material);
  if (!(material->ior >= 1 && material->ior <= kMostIor))
    return fmt::format("subsurface \"ior\" {} is not between 1 and {}", material->ior, kMostIor);
  if (!(given.unitLength > 0 && std::isfinite(given.unitLength)))
    return fmt::format("subsurface \"unitlength\" {} is no length", given.unitLength);
  if (!isFinite(material->scattering) || !isFinite(material->absorption))
    return "subsurface scattering and absorption are not finite";
  return {};
}

/// Reads the points, or makes irradiance points of photons. Throws FileError.
PointCloud cloudOf(const fs::path& path, const TmPhotonOptions* photons) {
  const PointFile file(path.string());
  if (!photons) return file.readAll();
  requirePhotons(file);
  PhotonIrradianceSettings settings;
  settings.nearest = photons->estimator;
  settings.every = 1;
  settings.maxRadius = photons->maxDistance;
  return estimateIrradiance(file.readAll(), settings);
}

}  // namespace

bool CloudFiles::bake(const CloudQuery& q, const std::vector<CloudValue>& values, std::string& problem) {
  const std::vector<CloudChannel> channels = channelsOf(values);
  std::vector<float> data;
  const std::lock_guard lock(mutex_);
  auto& [cloud, dropped] = baked_[q.file];
  if (cloud.count() == 0) cloud.channels = channels;
  if (cloud.channels != channels) {
    problem = "bakes other channels than those that the file has already";
    return false;
  }
  for (int i = 0; i < q.count; ++i) {
    if (!q.active[i]) continue;
    data.clear();
    for (const CloudValue& v : values)
      for (int k = 0; k < v.floats; ++k) data.push_back(v.c[k][i]);
    if (isValidPoint(at(q.P, i), at(q.N, i), q.radius[i], data))
      cloud.add(at(q.P, i), at(q.N, i), q.radius[i], data.data());
    else
      ++dropped;
  }
  return true;
}

const CloudFiles::Opened<BrickMap>& CloudFiles::opened(const std::string& file, const TmPhotonOptions* photons) {
  const fs::path path = found(file, searchPath_);
  const bool isCloud = path.extension() == ".ptc";
  const std::lock_guard lock(mutex_);
  const bool estimates = isCloud && photons;
  const auto [it, isNew] =
      opened_.try_emplace({file, estimates ? photons->estimator : 0, estimates ? photons->maxDistance : 0});
  if (!isNew) return it->second;
  try {
    if (isCloud)
      it->second.data = std::make_unique<const BrickMap>(cloudOf(path, photons));
    else
      it->second.data = std::make_unique<const BrickMap>(path.string(), cache_);
  } catch (const FileError& e) {
    it->second.problem = e.what();
  }
  return it->second;
}

bool CloudFiles::lookUp(const CloudQuery& q, const std::vector<CloudValue>& values, float* isFound,
                        std::string& problem) {
  const Opened<BrickMap>& file = opened(q.file);
  problem = file.problem;
  if (!file.data) return false;
  std::vector<int> places;
  for (const CloudValue& v : values) {
    places.push_back(offsetOf(file.data->channels(), v.name, v.floats));
    if (places.back() < 0) problem = fmt::format("has no channel \"{}\" of {} floats", v.name, v.floats);
  }
  std::vector<float> data(static_cast<size_t>(file.data->width()));
  try {
    for (int i = 0; i < q.count; ++i) {
      if (!q.active[i]) continue;
      isFound[i] = file.data->lookup(at(q.P, i), at(q.N, i), q.radius[i], data.data()) ? 1.0f : 0.0f;
      for (size_t v = 0; isFound[i] != 0 && v < values.size(); ++v)
        for (int k = 0; places[v] >= 0 && k < values[v].floats; ++k)
          values[v].c[k][i] = data[static_cast<size_t>(places[v] + k)];
    }
  } catch (const FileError& e) {
    problem = e.what();
  }
  return problem.empty();
}

bool CloudFiles::photons(const CloudQuery& q, const TmPhotonOptions& given, TmVec3 E, std::string& problem) {
  TmPhotonOptions lookup = given;
  lookup.estimator = std::max(2, lookup.estimator);  // a single photon would have all its power in one point
  lookup.maxDistance = std::max(0.0f, lookup.maxDistance);
  const Opened<BrickMap>& file = opened(q.file, &lookup);
  problem = file.problem;
  const auto placeOf = [&](const char* channel) {
    return file.data ? offsetOf(file.data->channels(), channel, 3) : -1;
  };
  const int place = std::max(placeOf(kIrradiance), placeOf(kIndirectIrradiance));
  if (file.data && place < 0) problem = "is no photon map";
  if (place < 0) return false;
  std::vector<float> data(static_cast<size_t>(file.data->width()));
  try {
    for (int i = 0; i < q.count; ++i) {
      if (!q.active[i]) continue;
      file.data->lookup(at(q.P, i), at(q.N, i), q.radius[i], data.data());
      const float* e = data.data() + place;
      set(E, i, vec3(e[0], e[1], e[2]) / kPi);
    }
  } catch (const FileError& e) {
    problem = e.what();
  }
  return problem.empty();
}

template <class Data, class Key, class Make>
const CloudFiles::Opened<Data>& CloudFiles::openedWhole(std::map<Key, Opened<Data>>& known, const Key& key,
                                                        const std::string& file, const Make& make) {
  const std::lock_guard lock(mutex_);
  const auto [it, isNew] = known.try_emplace(key);
  if (!isNew) return it->second;
  try {
    it->second.data = make(PointFile(found(file, searchPath_).string()).readAll());
  } catch (const FileError& e) {
    it->second.problem = e.what();
  }
  return it->second;
}

bool CloudFiles::occlusion(const CloudQuery& q, const DisksQuery& query, float* covered, TmVec3 radiance, float* coarse,
                           std::string& problem) {
  const Opened<Disks>& file =
      openedWhole(disks_, std::pair(q.file, query.channel), q.file,
                  [&](const PointCloud& cloud) { return std::make_unique<const Disks>(cloud, query.channel); });
  problem = file.problem;
  if (file.data && radiance.x && !file.data->sends())
    problem = fmt::format("has no channel \"{}\" of 3 floats", query.channel);
  if (!problem.empty()) return false;
  for (int i = 0; i < q.count; ++i) {
    if (!q.active[i] || at(q.N, i) == vec3(0)) continue;
    const HemisphereView seen = file.data->seenFrom(at(q.P, i), at(q.N, i), query, q.radius[i]);
    covered[i] = seen.covered;
    coarse[i] = seen.coarse;
    if (radiance.x) set(radiance, i, seen.radiance);
  }
  return true;
}

bool CloudFiles::subsurface(const CloudQuery& q, const TmSubsurfaceOptions& given, TmVec3 out, std::string& problem) {
  const Opened<Diffusion>& file = openedWhole(
      diffusing_, q.file, q.file, [](const PointCloud& cloud) { return std::make_unique<const Diffusion>(cloud); });
  problem = file.problem;
  const std::optional<Translucency> material = materialOf(given);
  if (problem.empty()) problem = problemOf(given, material);
  if (!problem.empty()) return false;
  const Dipole dipole(*material);
  for (int i = 0; i < q.count; ++i) {
    if (!q.active[i]) continue;
    set(out, i, file.data->at(at(q.P, i), dipole, given.unitLength, given.maxSolidAngle));
  }
  return true;
}

bool CloudFiles::hasBaked() const {
  const std::lock_guard lock(mutex_);
  return !baked_.empty();
}

void CloudFiles::write(Log& log) {
  for (const auto& [file, baked] : baked_) {
    const SourceLoc where{std::make_shared<const std::string>(file), 0};
    if (baked.dropped > 0)
      log.report(Severity::Warning, "bake3d-points", where,
                 fmt::format("{} of {} baked points are not finite or have a negative radius; dropped", baked.dropped,
                             baked.dropped + baked.cloud.count()));
    try {
      writePointFile(sorted(baked.cloud), placeBelow(outputRoot_, file));
    } catch (const FileError& e) {
      log.report(Severity::Output, "bake3d", where, e.what());
    }
  }
  baked_.clear();
}

}  // namespace tomales
