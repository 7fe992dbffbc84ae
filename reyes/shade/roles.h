// What the host knows of each role of a parameter (TmRole).
#pragma once
#include "reyes/shade.h"

namespace tomales {

struct RoleInfo {
  TmRole role;
  const char* name;
  TmType type;
  TmKind kind;  ///< The kind of shaders that may declare it.
};

/// Null if there is no such role.
const RoleInfo* roleInfo(int32_t role);
/// The role that a parameter declares, or that of the standard parameter of its name and type.
TmRole roleOf(const TmShader& shader, const TmParamDecl& decl);

}  // namespace tomales
