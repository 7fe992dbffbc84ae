// Private to Relighting: the numbers of its layers, and what their lights are multiplied by.
#pragma once
#include "reyes/app/relight/edit_state.h"
#include "reyes/deep.h"
#include "reyes/image.h"

namespace tomales {

constexpr size_t kWhole = 0, kGlow = 1, kFirstLight = 2;

/// Returns a value for a parameter that only multiplies the light, at which all of the light can be seen: that of the
/// scene unless a component is 0.
inline std::vector<float> unitOf(const EditableParam& param) {
  std::vector<float> out = param.value.numbers;
  if (std::ranges::count(out, 0.0f) > 0) std::ranges::fill(out, 1.0f);
  return out;
}

/// Returns the shade group of the nearest thing at a raster pixel of a bucket.
std::optional<int> groupAt(const DeepTile& tile, int x, int y);

/// Returns the variables and channels that a page may ask for.
std::vector<std::string> variablesOf(const Options& options);
/// Returns the value of the one that ShotJob::prepareToShow() has been asked for; a number is a grey.
vec3 variableAt(const Image& rows, int x, int y, const std::string& variable);

}  // namespace tomales
