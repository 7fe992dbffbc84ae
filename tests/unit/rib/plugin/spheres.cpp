// A plugin of Procedural "DynamicLoad" for tests. Each digit of its text makes a sphere of that radius, and `d` one
// whose radius is the detail that it is asked for. `!` fails.
#include <stdexcept>
#include <string>

#include "reyes/ri.h"

namespace {

void sphere(float radius) { RiSphereV(radius, -radius, radius, 360, 0, nullptr, nullptr); }

}  // namespace

extern "C" {

RtPointer ConvertParameters(char* text) { return new std::string(text); }

void Subdivide(RtPointer text, RtFloat detail) {
  for (const char c : *static_cast<std::string*>(text)) {
    if (c == '!') throw std::runtime_error("out of twigs");
    sphere(c == 'd' ? detail : static_cast<float>(c - '0'));
  }
}

void Free(RtPointer text) { delete static_cast<std::string*>(text); }

}  // extern "C"
