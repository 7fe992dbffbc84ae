#include "gi/cache/amendments/switches.h"

#include <cstdio>
#include <cstdlib>

namespace tomales {

bool isOn(Amendment amendment) {
  static const uint32_t without = [] {
    const char* named = std::getenv("TOMALES_WITHOUT");
    const std::string list = "," + std::string(named ? named : "") + ",";
    uint32_t out = 0;
    for (size_t i = 0; i < kAmendments.size(); ++i)
      if (list.find("," + std::string(kAmendments[i]) + ",") != std::string::npos)
        out |= bitOf(static_cast<Amendment>(i));
    if (out != 0) std::fprintf(stderr, "tomales: TOMALES_WITHOUT leaves out of the irradiance cache: %s\n", named);
    return out;
  }();
  return !(without & bitOf(amendment));
}

}  // namespace tomales
