// In which order the buckets of a frame are worked on (Option "bucket" "string order"). No order changes a picture.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace tomales {

/// Indices row * columns + column. "horizontal", "vertical", "zigzag-x" and "zigzag-y" (every other row or column
/// backwards), "spacefill" (along a Hilbert curve), "spiral" (outwards from the middle), "random". Others count as
/// horizontal.
std::vector<uint32_t> bucketOrder(const std::string& order, int columns, int rows);

}  // namespace tomales
