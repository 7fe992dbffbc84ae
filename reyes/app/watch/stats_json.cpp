#include "reyes/app/watch/stats_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "reyes/app/build_info.h"
#include "reyes/base/parallel.h"
#include "reyes/base/process.h"
#include "reyes/image.h"

namespace tomales {
namespace {

using Json = nlohmann::ordered_json;

Json timesOf(const Stats& stats, double total_s) {
  Json out{{"total", total_s}};
  for (const auto& [name, figures] : stats.stages()) out[name] = figures.wall_s;
  return out;
}

Json shadersOf(const Stats& stats) {
  Json out = Json::object();
  for (const auto& [name, f] : stats.byShader()) out[name] = {{"vertices", f.vertices}, {"time_s", f.time_s}};
  return out;
}

Json warningsOf(const std::vector<LogEntry>& messages) {
  static constexpr const char* kSeverity[] = {"info", "note", "warning", "missing", "error", "output"};
  Json out = Json::array();
  for (const LogEntry& e : messages) {
    Json places = Json::array();
    for (const SourceLoc& place : e.places) places.push_back(place.text());
    out.push_back({{"code", e.code},
                   {"severity", kSeverity[static_cast<int>(e.severity)]},
                   {"message", e.message},
                   {"file", e.where.file ? *e.where.file : ""},
                   {"line", e.where.line},
                   {"count", e.count},
                   {"places", places}});
  }
  return out;
}

Json auditOf(const Stats& stats) {
  Json out{{"pixels", stats.audit.pixels.load()}, {"paths", stats.audit.paths.load()}};
  for (const auto& [light, f] : stats.audits()) {
    out[light] = {{"mean", f.mean}, {"low", f.low}, {"high", f.high}, {"noise", f.noise}, {"told", f.mean >= f.noise}};
    if (f.p99 > 0) out[light]["p99"] = f.p99;
  }
  return out;
}

double hitRate(int64_t lookups, int64_t misses) {
  return lookups > 0 ? 1 - static_cast<double>(misses) / static_cast<double>(lookups) : 0.0;
}

Json countersOf(const Stats& s) {
  const auto& [primitives, subpatches, grids, diced, visible, culled, eyeSplits, visited] = s.geometry;
  return {{"geometry",
           {{"primitives", primitives.load()},
            {"subpatches", subpatches.load()},
            {"grids_diced", grids.load()},
            {"micropolygons_diced", diced.load()},
            {"micropolygons_visible", visible.load()},
            {"culled", culled.load()},
            {"eye_splits_given_up", eyeSplits.load()},
            {"pieces_visited", visited.load()}}},
          {"shade", {{"vertices_shaded", s.shade.verticesShaded.load()}, {"by_shader", shadersOf(s)}}},
          {"rays",
           {{"gather", s.rays.gather.load()},
            {"transmission", s.rays.transmission.load()},
            {"specular", s.rays.specular.load()},
            {"photon", s.rays.photon.load()},
            {"reference", s.rays.reference.load()},
            {"hitlist_adjusted", s.rays.hitlistAdjusted.load()}}},
          {"raytrace", {{"coarse_polygons", s.raytrace.coarsePolygons.load()}, {"bytes", s.raytrace.bytes.load()}}},
          {"geometry_cache",
           {{"lookups", s.geometryCache.lookups.load()},
            {"misses", s.geometryCache.misses.load()},
            {"hit_rate", hitRate(s.geometryCache.lookups, s.geometryCache.misses)},
            {"bytes", s.geometryCache.bytes.load()},
            {"fine_polygons", s.geometryCache.finePolygons.load()}}},
          {"irradiance_cache",
           {{"samples", s.irradianceCache.samples.load()},
            {"lookups", s.irradianceCache.lookups.load()},
            {"interpolated", s.irradianceCache.interpolated.load()}}},
          {"photons",
           {{"emitted", s.photons.emitted.load()},
            {"stored", s.photons.stored.load()},
            {"groups", s.photons.groups.load()},
            {"groups_kept", s.photons.groupsKept.load()}}},
          {"bricks",
           {{"total", s.bricks.total.load()},
            {"lookups", s.bricks.lookups.load()},
            {"misses", s.bricks.misses.load()},
            {"hit_rate", hitRate(s.bricks.lookups, s.bricks.misses)},
            {"cache_bytes", s.bricks.cacheBytes.load()},
            {"bytes_on_disk", s.bricks.bytesOnDisk.load()}}},
          {"textures",
           {{"lookups", s.textures.lookups.load()},
            {"tile_requests", s.textures.tileRequests.load()},
            {"tile_misses", s.textures.tileMisses.load()},
            {"hit_rate", hitRate(s.textures.tileRequests, s.textures.tileMisses)},
            {"bytes_read", s.textures.bytesRead.load()}}}};
}

Json statsJson(const RenderSettings& settings, const Stats& stats, const RunFigures& figures) {
  Json out{{"version", kVersion},
           {"command", settings.report.commandLine},
           {"scene", settings.input.files.empty() ? "" : settings.input.files.front()},
           {"frame", figures.frame ? Json(*figures.frame) : Json(nullptr)},
           {"outputs", stats.outputs()},
           {"host", hostName()},
           {"written", timeNow()},
           {"threads", threadCount()},
           {"time_s", timesOf(stats, figures.wall_s)},
           {"cpu_s", figures.cpu_s},
           {"memory_bytes",
            {{"peak_rss", figures.peak_bytes},
             {"geometry", stats.memoryBytes.geometry.load()},
             {"grids", stats.memoryBytes.grids.load()},
             {"deep_frame", stats.memoryBytes.deepFrame.load()},
             {"raytrace", stats.raytrace.bytes.load()}}}};
  out.update(countersOf(stats));
  if (settings.quality.audits()) out["audit"] = auditOf(stats);
  out["warnings"] = warningsOf(figures.messages);
  return out;
}

}  // namespace

std::string statsText(const RenderSettings& settings, const Stats& stats, const RunFigures& figures, int indent) {
  // Text of the user may hold bytes that are no UTF-8; they must not stop the report.
  return statsJson(settings, stats, figures).dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string statsOfHeader(const RenderSettings& settings, const Stats& stats, const RunFigures& figures) {
  Json all = statsJson(settings, stats, figures);
  for (const char* key : {"version", "command", "scene", "frame", "outputs", "warnings"}) all.erase(key);
  const auto text = [&] { return all.dump(-1, ' ', false, Json::error_handler_t::replace); };
  if (text().size() > kStatisticsRoom) all["shade"].erase("by_shader");
  if (text().size() > kStatisticsRoom) all.erase("audit");
  return text();
}

void printShaderProfile(const Stats& stats) {
  const auto byName = stats.byShader();
  std::vector<std::pair<std::string, Stats::ShaderFigures>> shaders(byName.begin(), byName.end());
  std::stable_sort(shaders.begin(), shaders.end(),
                   [](const auto& a, const auto& b) { return a.second.time_s > b.second.time_s; });
  std::puts(fmt::format("{:<24}{:>14}{:>12}{:>14}", "shader", "points", "seconds", "ns a point").c_str());
  for (const auto& [name, f] : shaders)
    std::puts(fmt::format("{:<24}{:>14}{:>12.3f}{:>14.0f}", name, f.vertices, f.time_s,
                          f.vertices > 0 ? 1e9 * f.time_s / static_cast<double>(f.vertices) : 0.0)
                  .c_str());
}

}  // namespace tomales
