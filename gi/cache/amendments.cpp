#include "gi/cache/amendments.h"

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>

namespace tomales {

bool isOn(Amendment amendment) {
  static const uint32_t without = [] {
    const char* named = std::getenv("TOMALES_WITHOUT");
    const std::string list = "," + std::string(named ? named : "") + ",";
    uint32_t out = 0;
    for (size_t i = 0; i < std::size(kAmendments); ++i)
      if (list.find("," + std::string(kAmendments[i]) + ",") != std::string::npos) out |= uint32_t{1} << i;
    if (out != 0) std::fprintf(stderr, "tomales: TOMALES_WITHOUT leaves out of the irradiance cache: %s\n", named);
    return out;
  }();
  return !(without >> static_cast<uint32_t>(amendment) & 1);
}

}  // namespace tomales
