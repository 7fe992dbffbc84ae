// Point clouds, brick maps and photons, on values of a batch (rispec-table 9.6). Part of reyes/sl.h.
#pragma once
#include "reyes/sl_services.h"

namespace sl {

/// A number or a triple of the batch under the name of a channel.
struct Channel {
  Channel(const char* name, const Float& x) : value{name, 1, {x.data(), nullptr, nullptr}} {}
  Channel(const char* name, const Triple& v) : value{name, 3, {v.out().x, v.out().y, v.out().z}} {}
  TmCloudValue value;
};
inline TmCloudLookup cloudLookup() { return TM_CLOUD_DEFAULTS; }
inline bool bake3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels,
                   const TmCloudLookup& options = cloudLookup()) {
  std::vector<TmCloudValue> values;
  for (const Channel& c : channels) values.push_back(c.value);
  return grid()->call->bake3d(grid()->host, grid(), file, p, n, &options, values.data(), int32_t(values.size())) != 0;
}
template <class... List>
bool bake3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels, const char* first,
            const List&... list) {
  const CloudList all = listed(CloudList(), first, list...);
  return bake3d(file, p, n, channels, all.options());
}
/// 1 where the file has data, which the channels then hold.
inline Float texture3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels,
                       const TmCloudLookup& options = cloudLookup()) {
  std::vector<TmCloudValue> values;
  for (const Channel& c : channels) values.push_back(c.value);
  Float found;
  grid()->call->texture3d(grid()->host, grid(), file, p, n, &options, values.data(), int32_t(values.size()),
                          found.data());
  return found;
}
template <class... List>
Float texture3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels,
                const char* first, const List&... list) {
  const CloudList all = listed(CloudList(), first, list...);
  return texture3d(file, p, n, channels, all.options());
}
/// E/pi of the nearest photons.
inline Color photonmap(const char* file, const Point& p, const Normal& n, int estimator = 50) {
  return tripleFrom([&](TmVec3 out) { grid()->call->photonMap(grid()->host, grid(), file, p, n, estimator, out); });
}
template <class... List>
Color photonmap(const char* file, const Point& p, const Normal& n, const char* first, const List&... list) {
  const PhotonList all = listed(PhotonList(), first, list...);
  Color found;
  if (all.radiance)
    texture3d(file, p, n, {{"_radiosity", found}});
  else
    grid()->call->photonMapWith(grid()->host, grid(), file, p, n, &all.photons, found.out());
  return found;
}

/// Of the photons of Attribute "photon" "causticmap"; none: black.
inline Color caustic(const Point& p, const Normal& n) {
  const std::string file = askText(TM_OF_ATTRIBUTES, "photon:causticmap");
  return file.empty() ? Color() : photonmap(file.c_str(), p, n);
}
/// Light that was baked as "_radiance_t" with "_area", where it leaves after diffusion: of the material of the list,
/// else of marble. E/pi. The approximation does not look at the normal.
template <class... List>
Color subsurface(const Point& p, const Normal&, const char* file, const List&... list) {
  const TmSubsurface material = listed(TmSubsurface(TM_SUBSURFACE_DEFAULTS), list...);
  return tripleFrom([&](TmVec3 out) { grid()->call->subsurface(grid()->host, grid(), file, p, &material, out); });
}

}  // namespace sl
