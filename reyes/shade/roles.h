// The facts about each role of a parameter (TmRole).
#pragma once
#include "reyes/shade.h"

namespace tomales {

struct RoleInfo {
  TmRole role;
  const char* name;
  TmType type;
  TmKind kind;  ///< The kind of shaders that may declare it.
};

/// Returns the product of the parameters of a light that are factors (isFactor()), for a request that gives `params`.
vec3 factorOf(const TmShader& light, const std::vector<Param>& params);
/// Returns null if there is no such role.
const RoleInfo* roleInfo(int32_t role);

}  // namespace tomales
