#include "reyes/shade/texture.h"

#include <OpenImageIO/texture.h>
#include <fmt/format.h>

#ifdef TOMALES_SANITIZED
// OpenImageIO 2.4 frees a TextureSystem through a base class of another size; the report would end every
// test.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }
#endif

namespace tomales {

struct Textures::Impl {
  OIIO::TextureSystem* system;
  Log& log;
  Stats& stats;
};

Textures::Textures(const std::string& searchPath, Log& log, Stats& stats)
    : impl_(new Impl{OIIO::TextureSystem::create(false), log, stats}) {
  impl_->system->attribute("searchpath", searchPath);
  impl_->system->attribute("automip", 1);  // pictures that no one ran maketx on
  impl_->system->attribute("autotile", 64);
}

Textures::~Textures() { OIIO::TextureSystem::destroy(impl_->system, true); }

bool Textures::lookup(const TextureQuery& q, const SourceLoc& where, const std::string& user,
                      TmVec3 out) const {
  OIIO::TextureSystem& system = *impl_->system;
  OIIO::TextureSystem::Perthread* thread = system.get_perthread_info();
  OIIO::TextureSystem::TextureHandle* handle = system.get_texture_handle(OIIO::ustring(q.name), thread);
  bool found = handle && system.good(handle);
  OIIO::TextureOpt options;
  options.firstchannel = q.channel;
  if (q.latlong) options.swrap = OIIO::TextureOpt::WrapPeriodic, options.twrap = OIIO::TextureOpt::WrapClamp;
  float* const channels[3] = {out.x, out.y, out.z};
  const int n = std::min(q.channels, 3);
  int64_t lookups = 0;
  for (int i = 0; i < q.count && found; ++i) {
    if (!q.active[i]) continue;
    float texel[3] = {0, 0, 0};
    found = system.texture(handle, thread, options, q.s[i], q.t[i], q.width[i], 0, 0, q.height[i], n, texel);
    for (int k = 0; k < n; ++k) channels[k][i] = texel[k];
    ++lookups;
  }
  impl_->stats.textures.lookups += lookups;
  const std::string error = system.geterror();
  if (found) return true;

  for (int i = 0; i < q.count; ++i)
    if (q.active[i])
      for (int k = 0; k < n; ++k) channels[k][i] = k == 1 ? 0.0f : 1.0f;
  impl_->log.report(Severity::Missing, fmt::format("texture-missing {}", q.name), where,
                    fmt::format("{}: texture \"{}\" cannot be read ({}); magenta is used", user, q.name,
                                error.empty() ? "not found" : error));
  return false;
}

}  // namespace tomales
