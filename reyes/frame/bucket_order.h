// The order in which the buckets of a frame are processed (Option "bucket" "string order"). No order changes a picture.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tomales {

/// Returns indices row * columns + column. Orders: "horizontal", "vertical", "zigzag-x" and "zigzag-y" (every other row
/// or column backwards), "spacefill" (along a Hilbert curve), "spiral" (outwards from the middle), "random". Any other
/// name counts as horizontal.
std::vector<uint32_t> bucketOrder(const std::string& order, int columns, int rows);

}  // namespace tomales
