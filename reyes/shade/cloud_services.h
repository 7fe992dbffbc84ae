// The disks of a point cloud, for shaders: from current space to that of the file and back.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// TmServices::occlusion where its options name a point cloud, without neighbours.
bool occlusionByDisks(Batch&, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, const DisksQuery&,
                      float* covered, TmVec3 radiance);

}  // namespace tomales
