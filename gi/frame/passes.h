// Private to gi: the passes over a frame's tiles before it is shaded.
#pragma once
#include "gi/frame/state.h"

namespace tomales {

/// Runs the shaders of each group that asksHemispheres() at a few of its visible points, to learn what they ask.
void learnHemisphereQueries(GiState&, const DeepFrame& layout, const TileReader&, const std::atomic<bool>* cancelled);

/// Implements GiServices::gatherPass().
void fillCaches(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                const std::atomic<bool>* cancelled, const std::function<void(int stride)>& covered);

/// Implements GiServices::bake().
void bakeLight(const GiState&, const DeepFrame& layout, const TileReader&, const std::filesystem::path& folder,
               const MapNames&, uint64_t world);

/// Notes where shaders ask for indirect light, and counts photons there, if state.passes says how many.
void measureLight(GiState&, const DeepFrame& layout, const TileReader&, const std::function<void(float)>& progress,
                  const std::atomic<bool>* cancelled);
/// Notes the places while measureLight() asks for them, and answers that they are dark. Returns false at any other
/// time.
bool noteMeasured(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, int bounces,
                  const ShadeContext&, const IndirectResult& out);
/// Adds what has been measured to E, where the eye looks and by mirrors and glass.
void addMeasured(const GiState&, const ShadePoints&, const uint8_t* active, TmConstVec3 N, int bounces,
                 const ShadeContext&, const IndirectResult& out);

}  // namespace tomales
