#include "reyes/prim/facing.h"

#include <fmt/format.h>

namespace tomales {

Primvar widthOf(const std::vector<Primvar>& primvars) {
  const Primvar* found = nullptr;
  for (const char* name : {"constantwidth", "width"})
    for (const Primvar& var : primvars)
      if (var.name == name && var.width == 1) found = &var;
  if (!found) return {"width", Storage::Constant, ValueType::Float, 1, {1.0f}};
  for (float w : found->values)
    if (!(w >= 0 && w < kInfinity)) throw PrimError(fmt::format("{} is {} somewhere", found->name, w));
  return *found;
}

const Primvar* normalsOf(const std::vector<Primvar>& primvars) {
  for (const Primvar& var : primvars)
    if (var.name == "N" && var.width == 3) return &var;
  return nullptr;
}

}  // namespace tomales
