#include "reyes/bindings/assimp/parts.h"

#include <fmt/format.h>

#include <filesystem>

#include "reyes/base/chunk_file.h"
#include "reyes/base/unfinished_file.h"

namespace tomales::model {
namespace {

/// Makes a name of letters, digits, - and _ from what a stranger's file calls something.
std::string fileName(const std::string& stem) {
  constexpr size_t kLongest = 48;
  std::string out;
  for (const char c : stem) out += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
  return out.substr(0, kLongest);
}

}  // namespace

void writePart(const std::string& path, const std::string& bytes) {
  std::string error;
  if (!writeFile(path, bytes, error)) throw WriteError(fmt::format("{} cannot be written: {}", path, error));
}

Parts::Place Parts::reserve(const std::string& stem, const std::string& ending) {
  if (count_ == 0) std::filesystem::create_directories(settings_.parts);
  const std::string name = fmt::format("/{:04}_{}{}", ++count_, fileName(stem), ending);
  return {settings_.parts + name, settings_.partsByName + name};
}

std::string Parts::addArchive(const std::string& stem, const Requests& requests) {
  std::string rib;
  write(requests, *makeRibWriter({true, false, [&](std::string_view more) { rib += more; }}));
  const Place place = reserve(stem, ".rib");
  writePart(place.path, rib);
  return place.name;
}

}  // namespace tomales::model
