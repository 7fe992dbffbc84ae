#include "reyes/base/checksum.h"

#include <xxhash.h>

namespace tomales {

uint64_t checksum(BytesView bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace tomales
