// libFuzzer entry: any bytes through the RIB reader. Run as
//   rib_fuzz -max_len=4096 -timeout=10 WORK_FOLDER tests/corpus/rib
#include <cstddef>
#include <cstdint>

#include "reyes/rib.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  tomales::Log log(tomales::Log::Verbosity::Quiet);
  tomales::RibSettings settings;
  settings.archivePath.clear();
  tomales::readRibText({reinterpret_cast<const char*>(data), size}, "fuzz.rib", settings, log);
  return 0;
}
