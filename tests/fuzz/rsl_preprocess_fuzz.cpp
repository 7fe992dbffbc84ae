// libFuzzer entry: any bytes through the preprocessor of shaders, and what it says through the printer of messages. Run
//   rsl_preprocess_fuzz -max_len=4096 -timeout=60 -rss_limit_mb=2048 WORK_FOLDER tests/corpus/rsl
#include <cstddef>
#include <cstdint>

#include "places.h"
#include "reyes/rsl/preprocess.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace tomales::compiler;
  Sources sources;
  Messages messages;
  PreprocessOptions options;
  options.includeFolders = {TOMALES_SOURCE_DIR "/tests/corpus/rsl/include"};
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto tokens = preprocessText("fuzz.sl", text, options, sources, messages);
  if (tokens.empty() || tokens.back().kind != TokenKind::End) __builtin_trap();
  if (dump(tokens, sources).empty()) __builtin_trap();
  if (messages.hasErrors() == messages.rendered(sources).empty() && messages.hasErrors()) __builtin_trap();
  return 0;
}
