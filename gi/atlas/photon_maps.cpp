#include "gi/atlas/photon_maps.h"

#include <fmt/format.h>

#include <array>
#include <map>

#include "reyes/base/folder_lock.h"
#include "reyes/base/unfinished_folder.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

size_t numberOf(const std::set<std::string>& maps, const std::string& name) {
  return static_cast<size_t>(std::distance(maps.begin(), maps.find(name)));
}

uint64_t photonInputs(const MapNames& names, const AtlasSettings& settings) {
  // specularFirstOnly keeps its default here.
  const auto& [emit, maxDepth, seed, direct, specularFirstOnly, mostBounces] = settings.photons;
  return contentSum(kAtlasMethod, settings.world, names.global, names.caustic, names.volume, emit, maxDepth,
                    mostBounces, seed, direct);
}

uint64_t partInputs(const MapNames& names, const AtlasSettings& settings, WorkPart part) {
  return contentSum(photonInputs(names, settings), part.index, part.count);
}

/// Channels of a file of photons of all maps. Normals are a channel of three floats, because packing them twice may
/// change them.
const std::vector<CloudChannel> kPartChannels = {{"power", 3}, {"photonnormal", 3}, {"map", 1}, kSurfaceChannel};

/// Traces a part of the photons, and calls `put` with each for every map that holds it.
template <class Put>
PhotonFigures traceSorted(const AtlasWork& work, WorkPart part, const Put& put) {
  const PhotonSorter sorter(work.scene(), work.names, work.settings.photons.mostBounces);
  const auto sort = [&](std::span<const StoredPhoton> photons) {
    for (const StoredPhoton& p : photons) sorter.sort(p, put);
  };
  const PhotonFigures figures = tracePhotons(work.scene(), *work.tools.rays, *work.tools.shading, work.settings.photons,
                                             sort, work.progress, work.stats, work.log, part);
  work.stats.photons.emitted += figures.emitted;
  work.stats.photons.stored += figures.stored;
  return figures;
}

}  // namespace

PhotonSorter::PhotonSorter(const Scene& scene, const MapNames& names, int mostBounces)
    : names_(names), world_(scene), mostBounces_(mostBounces) {
  const std::set<std::string> maps = names.all();
  for (const std::string& name : names.global) global_.push_back(numberOf(maps, name));
  for (const std::string& name : names.caustic) caustic_.push_back(numberOf(maps, name));
  volume_ = numberOf(maps, names.volume);
}

PhotonMapFiles::PhotonMapFiles(const std::filesystem::path& folder, const MapNames& names, bool direct)
    : folder_(folder), maps_(names.all()), direct_(direct) {
  const char* channel = direct ? kPower : kIndirectPower;
  files_.reserve(maps_.size());
  for (const std::string& name : maps_)
    files_.emplace_back(atlasFile(folder, name, ".ptc").string(),
                        name == names.volume ? std::vector<CloudChannel>{{kPathPower, 3}}
                                             : std::vector<CloudChannel>{{channel, 3}, kSurfaceChannel});
}

void PhotonMapFiles::finish(const MadeFrom& madeFrom, Log& log) {
  UnfinishedFolder set(folder_);
  auto file = files_.begin();
  for (const std::string& name : maps_) {
    file->finish(madeFrom);
    if (file->count() == 0)
      log.report(direct_ ? Severity::Warning : Severity::Info, "photons-none", {},
                 fmt::format("no photon came to the objects of photon map \"{}\"{}", name,
                             direct_ ? "" : " except straight from lights"));
    ++file;
  }
  set.finish();
}

PhotonFigures writePhotons(const fs::path& folder, const AtlasWork& work) {
  makeAtlasFolder(folder);
  const FolderLock lock(folder, [&] {
    work.log.report(Severity::Info, "photons-wait", {},
                    "waits for another program that writes photons to \"" + folder.string() + "\"");
  });
  PhotonMapFiles files(folder, work.names, work.settings.photons.direct);
  const PhotonFigures figures = traceSorted(work, {}, [&](const MapPhoton& p) { files.add(p); });
  files.finish({work.settings.world, photonInputs(work.names, work.settings)}, work.log);
  work.stats.photons.groups += static_cast<int64_t>(files.count());
  return figures;
}

PhotonFigures writePhotonPart(const fs::path& file, WorkPart part, const AtlasWork& work) {
  PointFileWriter writer(file.string(), kPartChannels);
  const auto write = [&](const MapPhoton& p) {
    const std::array values{
        p.power.x, p.power.y, p.power.z, p.N.x, p.N.y, p.N.z, static_cast<float>(p.map), static_cast<float>(p.surface)};
    writer.add(p.P, vec3(0), 0, values.data());
  };
  const PhotonFigures figures = traceSorted(work, part, write);
  writer.finish({work.settings.world, partInputs(work.names, work.settings, part)});
  return figures;
}

void joinPhotonParts(const std::vector<fs::path>& parts, const fs::path& folder, const MapNames& names,
                     const AtlasSettings& settings, Stats& stats, Log& log) {
  makeAtlasFolder(folder);
  PhotonMapFiles files(folder, names, settings.photons.direct);
  const int count = static_cast<int>(parts.size());
  for (int index = 0; index < count; ++index) {
    const PointFile part(parts[static_cast<size_t>(index)].string());
    if (part.channels() != kPartChannels || part.madeFrom().inputs != partInputs(names, settings, {index, count}))
      throw FileError(fmt::format("\"{}\" is not part {} of {} of the photons of this scene and these settings",
                                  part.path(), index + 1, count));
    for (size_t chunk = 0; chunk < part.chunkCount(); ++chunk) {
      PointCloud points;
      part.read(chunk, points);
      for (size_t i = 0; i < points.count(); ++i) {
        const float* v = points.at(i);
        if (!(v[6] >= 0 && v[6] < static_cast<float>(files.count())))
          throw DamageError(part.path(), fmt::format("\"{}\" is damaged: a photon has no map", part.path()));
        files.add({points.position[i], vec3(v[3], v[4], v[5]), vec3(v[0], v[1], v[2]), static_cast<size_t>(v[6]),
                   static_cast<int>(v[7])});
      }
    }
  }
  files.finish({settings.world, photonInputs(names, settings)}, log);
  stats.photons.groups += static_cast<int64_t>(files.count());
}

bool hasPhotons(const fs::path& folder, const MapNames& names, const AtlasSettings& settings) {
  const std::set<std::string> maps = names.all();
  const uint64_t inputs = photonInputs(names, settings);
  return std::all_of(maps.begin(), maps.end(), [&](const std::string& name) {
    return pointsMadeFrom(atlasFile(folder / "photons", name, ".ptc")).inputs == inputs;
  });
}

}  // namespace tomales
