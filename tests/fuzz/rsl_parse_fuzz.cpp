// libFuzzer entry: any bytes as a shader's text through the preprocessor and the parser, and the tree through its
// printer, which walks all of it. Run
//   rsl_parse_fuzz -max_len=4096 -timeout=60 -rss_limit_mb=2048 WORK_FOLDER tests/corpus/rsl
#include <cstddef>
#include <cstdint>

#include "reyes/rsl/parse.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace tomales::compiler;
  Sources sources;
  Messages messages;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto tokens = preprocessText("fuzz.sl", text, {}, sources, messages);
  const File file = parse(tokens, messages);
  if (file.shaders.empty() && file.functions.empty() && tokens.size() > 1 && !messages.hasErrors() &&
      !tokens[0].is(";"))
    __builtin_trap();
  if (!messages.hasErrors() && dump(file).empty() && (!file.shaders.empty() || !file.functions.empty()))
    __builtin_trap();
  messages.rendered(sources);
  return 0;
}
