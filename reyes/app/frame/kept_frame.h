// The data that a frame keeps besides its hidden buckets (bucket_file.h) while it is rendered with --resume: gathered
// records, maps of light, and the colours of shaded buckets.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/checkpoint.h"
#include "reyes/deep.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Opens the file beside the frame's first picture. Returns null without --resume. It also returns null, with a
/// message, where nobody can tell whether a later run renders the same. Pre: all procedurals have been opened.
std::unique_ptr<Checkpoint> checkpointOf(const Scene& scene, ShaderRegistry& shaders, const DeepFrame& layout,
                                         const RenderSettings& settings, Log& log);

/// Sets the colours of a hidden tile that has been shaded before. Returns false if it has not. kept: may be null.
bool takeShaded(const Checkpoint* kept, size_t index, DeepTile& tile);
/// Pre: the tile is shaded as the finished picture has it. kept: may be null.
void keepShaded(Checkpoint* kept, size_t index, const DeepTile& tile);

}  // namespace tomales
