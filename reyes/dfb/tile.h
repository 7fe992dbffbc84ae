// A tile to bytes and back: its arrays one after the other, member by member, which compresses better than structures
// do. Private to reyes/dfb.
#pragma once
#include "reyes/base/pack.h"
#include "reyes/deep.h"

namespace tomales {

Bytes packTile(const DeepTile& tile);
/// Nothing: the bytes are not those of a tile whose indices stay inside it.
std::optional<DeepTile> unpackTile(BytesView bytes);
/// Changes with what a tile holds.
uint64_t tileSchema();

}  // namespace tomales
