// libFuzzer entry: the bytes are the choices of a valid program (tests/unit/rsl/written_program.h), which the compiler
// and the machine have to run as a walk through its tree does. Run
//   rsl_run_fuzz -max_len=4096 -timeout=60 -rss_limit_mb=2048 WORK_FOLDER
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "tests/unit/rsl/against_walk.h"
#include "tests/unit/rsl/written_program.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace tomales::compiler;
  size_t at = 0;
  const Choose choose = [&](uint32_t below) { return at < size ? data[at++] % below : 0u; };
  if (const std::string what = difference(WrittenProgram(choose).text()); !what.empty()) {
    std::fputs(what.c_str(), stderr);
    __builtin_trap();
  }
  return 0;
}
