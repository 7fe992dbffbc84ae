// `tomales hide`: hides geometry to a deep frame buffer in a file.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/stats.h"
#include "reyes/dfb.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Writes to PictureSettings::output, bucket by bucket. With PictureSettings::resume it hides only the buckets that an
/// interrupted run left out.
void hideToFile(Scene& scene, ShaderRegistry& shaders, int world, const RenderSettings& settings, Stats& stats,
                Log& log);

/// Makes paths absolute and computes checksums. Standard input has no checksum.
std::vector<SourceFile> sourcesOf(const std::vector<std::string>& files);

}  // namespace tomales
