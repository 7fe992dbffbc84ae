#include "reyes/shade/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#ifdef TOMALES_SANITIZED
// OpenImageIO 2.4 frees a TextureSystem through a base class of another size; the report would end every
// test.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }
#endif

namespace tomales {

struct Textures::Impl {
  const TextureSettings settings;
  Log& log;
  Stats& stats;
  std::once_flag opened{};
  std::unique_ptr<TextureCache> cache{};  ///< Null if it could not be made; `problem` says why.
  std::string problem{};

  TextureCache* open() {
    std::call_once(opened, [this] {
      TextureSettings told = settings;
      told.note = [this](const std::string& note) { log.report(Severity::Note, "texture-cache", {}, note); };
      if (const PictureLibrary* library = pictureLibrary(problem)) cache = library->textures(told);
    });
    return cache.get();
  }
  bool lookup(const TextureQuery& query, TmVec3 out, std::string& remark) {
    if (!open()) {
      remark = problem;
      return false;
    }
    int64_t lookups = 0;
    const bool found = cache->lookup(query, out, lookups, remark);
    stats.textures.lookups += lookups;
    return found;
  }
};

Textures::Textures(const TextureSettings& settings, Log& log, Stats& stats) : impl_(new Impl{settings, log, stats}) {}

Textures::~Textures() {
  if (!impl_->cache) return;
  const TextureFigures figures = impl_->cache->takeFigures();
  auto& s = impl_->stats.textures;
  s.tileRequests += figures.tileRequests;
  s.tileMisses += figures.tileMisses;
  s.bytesRead += figures.bytesRead;
}

bool Textures::info(const std::string& name, const std::string& what, std::vector<float>& numbers,
                    std::string& text) const {
  return impl_->open() && impl_->cache->info(name, what, numbers, text);
}

namespace {

void fill(const TextureQuery& q, const vec3& value, TmVec3 out) {
  float* const channels[3] = {out.x, out.y, out.z};
  for (int i = 0; i < q.count; ++i)
    if (q.active[i])
      for (int k = 0; k < std::min(q.channels, 3); ++k) channels[k][i] = value[k];
}

}  // namespace

bool Textures::lookup(const TextureQuery& q, const SourceLoc& where, const std::string& user, TmVec3 out) const {
  if (!*q.name) {
    fill(q, vec3(q.fill), out);
    return true;
  }  // shaders that are given no picture look up ""
  std::string remark;
  if (impl_->lookup(q, out, remark)) {
    if (!remark.empty())
      impl_->log.report(Severity::Warning, "texture-elsewhere", where,
                        fmt::format("{}: texture \"{}\" {}", user, q.name, remark), q.name);
    return true;
  }
  fill(q, vec3(1, 0, 1), out);
  impl_->log.report(Severity::Missing, "texture-missing", where,
                    fmt::format("{}: texture \"{}\" cannot be read ({}); magenta is used", user, q.name,
                                remark.empty() ? "not found" : remark),
                    q.name);
  return false;
}

}  // namespace tomales
