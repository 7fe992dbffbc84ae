#include "reyes/app/catrib.h"

#include <cstdio>
#include <memory>

#include "reyes/rib.h"

namespace tomales {

int catribCommand(const CatribSettings& settings) {
  Log log;
  const bool toFile = !settings.output.empty();
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      toFile ? std::fopen(settings.output.c_str(), "wb") : nullptr, [](std::FILE* f) { return std::fclose(f); });
  std::FILE* out = toFile ? file.get() : stdout;
  bool written = out != nullptr;
  if (out) {
    const auto write = [&](std::string_view text) {
      written = std::fwrite(text.data(), 1, text.size(), out) == text.size() && written;
    };
    parseRib(settings.files, *makeRibWriter({settings.binary, settings.gzip, write}), log);
  }
  written = written && std::fflush(out) == 0;
  if (!written)
    log.report(Severity::Output, "output-write",
               {std::make_shared<std::string>(toFile ? settings.output : "standard output"), 0}, "cannot be written");
  return exitCodeOf(log);
}

}  // namespace tomales
