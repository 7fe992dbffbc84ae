// Private to reyes/image: Cryptomatte (Friedman and Jones 2015; the public specification, version 1.2.0). Every pixel
// lists, in ranks, the names that are visible in it and their coverage.
#pragma once
#include "reyes/image/image_file.h"
#include "reyes/image/weights.h"

namespace tomales {

constexpr int kCryptoFloats = 12;  ///< Six ranks of id and coverage.

/// Returns the MurmurHash3_x86_32 of a name, as the float with these bits; exponents of zero, infinity and NaN are
/// avoided.
float cryptoId(const std::string& name);

/// Fills kCryptoFloats from float `first` of every pixel of `band`. `names` are indexed as Scene::groups.
void cryptomatte(const DeepFrame& frame, const Options& options, const SampleOffsets& samples,
                 const std::vector<std::string>& names, int first, Image& band);

/// Returns the metadata of a layer: its name, how ids are made, and all names with their ids.
std::vector<Metadata> cryptoMetadata(const std::string& layer, const std::vector<std::string>& names);

}  // namespace tomales
