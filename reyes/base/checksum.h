// The XXH3 checksum of some bytes. It finds damage and names contents, but is no defence against malice.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tomales {

using Bytes = std::vector<std::byte>;
using BytesView = std::span<const std::byte>;

uint64_t checksum(BytesView bytes);

}  // namespace tomales
