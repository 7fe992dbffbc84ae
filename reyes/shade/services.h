// The table of TmServices, in parts: each function sets, by name, the calls that its file implements. So a new call is
// added in shader_api.h and in that file alone.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

void addSurfaceServices(TmServices&);  // services.cpp
void addLightServices(TmServices&);
void addLobeServices(TmServices&);
void addRayServices(TmServices&);
void addOcclusionServices(TmServices&);
void addPictureServices(TmServices&);
void addCloudServices(TmServices&);
void addMessageServices(TmServices&);
void addVolumeServices(TmServices&);

}  // namespace tomales
