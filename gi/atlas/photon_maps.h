// Private to gi: sorts stored photons into the files of their maps. Space: world. Threads: plain object.
#pragma once
#include "gi/atlas_files.h"
#include "gi/point_file.h"
#include "gi/world_from_current.h"

namespace tomales {

/// Increase this when the same inputs begin to make other files.
constexpr uint32_t kAtlasMethod = 14;

/// A photon as a map holds it.
struct MapPhoton {
  vec3 P, N, power;
  size_t map;  ///< Its number in MapNames::all().
  int surface;
};

/// Knows where the photons of a scene go.
class PhotonSorter {
 public:
  PhotonSorter(const Scene& scene, const MapNames& names, int mostBounces);
  /// Calls `put` with the photon once for each map that holds it.
  template <class Put>
  void sort(const StoredPhoton& photon, const Put& put) const {
    const vec3 P = transformPoint(world_.points, photon.P), power = world_.scale * world_.scale * photon.power;
    if (photon.group < 0) return put({P, vec3(0), power, volume_, 0});
    const vec3 N = normalizeOr(world_.normals * photon.N, vec3(0, 0, 1));
    const auto group = static_cast<size_t>(photon.group);
    if (photon.bounces <= mostBounces_) put({P, N, power, global_[group], names_.surface[group]});
    if (photon.caustic() && !names_.caustic[group].empty()) put({P, N, power, caustic_[group], names_.surface[group]});
  }

 private:
  const MapNames& names_;
  const WorldFromCurrent world_;
  const int mostBounces_;
  std::vector<size_t> global_, caustic_;  ///< The map of each group.
  size_t volume_ = 0;
};

/// The files of all maps in a folder.
class PhotonMapFiles {
 public:
  /// `direct`: they hold what comes straight from lights, too. Throws FileError, like every member.
  PhotonMapFiles(const std::filesystem::path& folder, const MapNames& names, bool direct);
  void add(const MapPhoton& p) {
    const std::array values{p.power.x, p.power.y, p.power.z, static_cast<float>(p.surface)};
    files_[p.map].add(p.P, p.N, 0, values.data());
  }
  /// Warns of maps that no photon came to.
  void finish(const MadeFrom& madeFrom, Log& log);
  size_t count() const { return files_.size(); }

 private:
  const std::filesystem::path folder_;
  const std::set<std::string> maps_;
  const bool direct_;
  std::vector<PointFileWriter> files_;
};

}  // namespace tomales
