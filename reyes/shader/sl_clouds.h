// PRMan's functions of point clouds, brick maps and photons, on values of a batch. Part of reyes/sl.h.
#pragma once
#include "reyes/shader/sl_services.h"

namespace sl {

/// A number or a triple of the batch, with the name of a channel.
struct Channel {
  Channel(const char* name, const Float& x) : value{name, {x.data(), nullptr, nullptr}} {}
  Channel(const char* name, const Triple& v) : value{name, v.out()} {}
  TmChannel value;
};
inline bool bake3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels,
                   const TmCloudOptions& options = tmCloudDefaults()) {
  std::vector<TmChannel> values;
  for (const Channel& c : channels) values.push_back(c.value);
  return grid()->call->bake3d(grid()->host, grid(), file, &options, p, n, values.data(), int32_t(values.size())) != 0;
}
template <class... List>
bool bake3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels, const char* first,
            const List&... list) {
  const CloudList all = listed(CloudList(), first, list...);
  return bake3d(file, p, n, channels, all.options());
}
/// Returns 1 where the file has data, and sets the channels there.
inline Float texture3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels,
                       const TmCloudOptions& options = tmCloudDefaults()) {
  std::vector<TmChannel> values;
  for (const Channel& c : channels) values.push_back(c.value);
  Float found;
  grid()->call->texture3d(grid()->host, grid(), file, &options, p, n, values.data(), int32_t(values.size()),
                          found.data());
  return found;
}
template <class... List>
Float texture3d(const char* file, const Point& p, const Normal& n, const std::vector<Channel>& channels,
                const char* first, const List&... list) {
  const CloudList all = listed(CloudList(), first, list...);
  return texture3d(file, p, n, channels, all.options());
}
/// Returns E/pi, estimated from the nearest photons.
inline Color photonmap(const char* file, const Point& p, const Normal& n, const TmPhotonOptions& options) {
  return tripleFrom([&](TmVec3 out) { grid()->call->photonMap(grid()->host, grid(), file, &options, p, n, out); });
}
inline Color photonmap(const char* file, const Point& p, const Normal& n, int estimator = 50) {
  TmPhotonOptions options = tmPhotonDefaults();
  options.estimator = estimator;
  return photonmap(file, p, n, options);
}
template <class... List>
Color photonmap(const char* file, const Point& p, const Normal& n, const char* first, const List&... list) {
  const PhotonList all = listed(PhotonList(), first, list...);
  if (!all.radiance) return photonmap(file, p, n, all.photons);
  Color found;
  texture3d(file, p, n, {{"_radiosity", found}});
  return found;
}

/// Returns E/pi from the photon map of Attribute "photon" "causticmap"; black if there is none.
inline Color caustic(const Point& p, const Normal& n) {
  const std::string file = askText(TM_OF_ATTRIBUTES, "photon:causticmap");
  return file.empty() ? Color() : photonmap(file.c_str(), p, n);
}
/// Returns the light that leaves at p after diffusion, as E/pi, from a cloud with "_radiance_t" and "_area". The list
/// names the material, marble by default. The approximation ignores the normal.
template <class... List>
Color subsurface(const Point& p, const Normal&, const char* file, const List&... list) {
  const TmSubsurfaceOptions material = listed(tmSubsurfaceDefaults(), list...);
  return tripleFrom([&](TmVec3 out) { grid()->call->subsurface(grid()->host, grid(), file, &material, p, out); });
}

}  // namespace sl
