// `tomales hide`: geometry -> deep frame buffer, in a file.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/stats.h"
#include "reyes/dfb.h"

namespace tomales {

/// To settings.output, bucket by bucket; with settings.resume, only those that an interrupted run has left out.
void hideToFile(Scene& scene, int world, const RenderSettings& settings, Stats& stats, Log& log);

/// Paths made absolute, and checksums. Standard input has none.
std::vector<SourceFile> sourcesOf(const std::vector<std::string>& files);

}  // namespace tomales
