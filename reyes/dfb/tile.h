// Private to reyes/dfb: converts a tile to bytes and back. Its arrays are stored one after the other, member by member,
// which compresses better than structures.
#pragma once
#include "reyes/base/pack.h"
#include "reyes/deep.h"

namespace tomales {

Bytes packTile(const DeepTile& tile);
/// Returns nothing if the bytes are not a tile, or if an index in it is out of range.
std::optional<DeepTile> unpackTile(BytesView bytes);
/// Returns a number that changes with the layout of a tile.
uint64_t tileSchema();

}  // namespace tomales
