#include "reyes/rib.h"

#include "reyes/rib/reader.h"

namespace tomales {

std::vector<int> RibArg::ints() const {
  std::vector<int> out;
  out.reserve(numbers.size());
  for (const float f : numbers)
    out.push_back(std::abs(f) < 2147483648.0f ? static_cast<int>(std::lround(f)) : -1);
  return out;
}

bool readRib(const std::vector<std::string>& files, const RibSettings& settings, Log& log) {
  rib::Reader reader(settings, log);
  bool good = true;
  for (const std::string& file : files) good = reader.readFile(file) && good;
  reader.finish();
  return good;
}

bool readRibText(const std::string& text, const std::string& name, const RibSettings& settings, Log& log) {
  rib::Reader reader(settings, log);
  const bool good = reader.readText(text, name);
  reader.finish();
  return good;
}

}  // namespace tomales
