// Private to gi: the light of the gather pass in brick maps that another camera reads. Space: current, but world in
// files. Irradiance: E/pi, but E in W/m2 in files.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Implements GiServices::bake().
void bakeLight(const GiState&, const DeepFrame& layout, const TileReader&, const std::filesystem::path& folder,
               const MapNames&, uint64_t world);

/// Implements indirectDiffuse() in GiMode::Baked, at any depth.
void bakedIndirect(const GiState&, const ShadePoints&, const uint8_t* active, const IndirectResult& out);

}  // namespace tomales
