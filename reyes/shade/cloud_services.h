// Lookups of shaders in the disks of a point cloud, converted from current space to the space of the file and back.
#pragma once
#include "reyes/cloud_services.h"
#include "reyes/shade/batch.h"

namespace tomales {

/// Does TmServices::occlusion for options that name a point cloud, without neighbours.
bool occlusionByDisks(Batch&, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, const DisksQuery&,
                      float* covered, TmVec3 radiance);

}  // namespace tomales
