/* The binary contract between the renderer and a shader, built-in or plugin. Plain C, so that it survives
 * compilers and releases; reyes/shader.h is its C++ face and what most shader writers include.
 *
 * A shader is one callback for a batch of points. All arrays are structures of arrays, start on a 64-byte
 * boundary and are padded to TM_LANES floats, so a loop may run over `padded` points without a tail; points
 * whose `active` byte is 0 must keep their values, and services leave them alone.
 *
 * Space: "current" is camera space at shutter open (left-handed, +z into the scene). Colours are linear.
 * Irradiance: diffuse(), ambient() and indirect light are E/pi, the RSL convention: Ci = Cs * diffuse(N).
 * Threads: one shader runs on many threads at once, on different batches. It must keep no state.
 * Growth: fields and functions are only ever appended; check structBytes before using a later one. */
#pragma once
#include "reyes/shader_services.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct TmShader {
  uint32_t abi, structBytes; /* TM_SHADER_ABI and sizeof(TmShader) of the plugin's header: checked before all else */
  const char* name;
  int32_t kind;          /* TmKind */
  uint32_t capabilities; /* of TmCapability */
  const TmParamDecl* params;
  int32_t paramCount;
  void (*shade)(const TmGrid* grid);
  const char* doc;
} TmShader;

typedef struct TmShaderLibrary {
  uint32_t abi, structBytes;
  const TmShader* const* shaders;
  int32_t count;
} TmShaderLibrary;

/* The one symbol that a plugin exports. */
typedef const TmShaderLibrary* (*TmShadersFunction)(void);
#define TM_SHADERS_SYMBOL "tomales_shaders"

/* The shaders that come with the renderer (shaders/library.cpp). */
const TmShaderLibrary* tomales_builtin_shaders(void);

#ifdef __cplusplus
}
#endif
