// Makes the maps of light that frames share before the frames: in one process, or in parts by several. Threads: uses
// the pool.
#pragma once
#include <filesystem>

#include "reyes/app/frame/atlas_job.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Makes the maps of a frame's light in the folder of --atlas: all that are missing, or those of one pass of the atlas.
/// Failures are reported.
void makeSharedLight(Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings,
                     std::optional<AtlasPass> pass, WorkPart part, Stats& stats, Log& log);

/// The maps of light that a frame looks into.
struct SharedLight {
  std::string folder;  ///< Folder of --atlas or of the scene's lights; empty if none is named.
  uint64_t world = 0;  ///< Frames of the same sum may share maps.
  std::set<std::string> maps;
  bool photons = false;  ///< They are made of photons, in passes.
};
/// Returns nothing if the frame makes no maps that others could use. It opens what rays may meet.
std::optional<SharedLight> sharedLightOf(Scene& scene, const RenderSettings& settings, Log& log);

/// Returns the file of the brick map of that name, and the other files that are made with it.
std::vector<std::string> filesOfMap(const SharedLight& light, const std::string& folder, const std::string& map);
std::string photonsOfMap(const std::string& folder, const std::string& map);

}  // namespace tomales
