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
 *
 * Growth: what ABI 1 holds stays where it is, with the same meaning and the same values of enumerations. A later
 * release of ABI 1 may append fields to structs that begin with structBytes (and to TmParamDecl: paramBytes), functions
 * to TmServices, and values to enumerations; 0, or the value that the struct's function of defaults gives, then means
 * what it meant before. A new field begins where the earlier struct ended, padding included, and no field leaves a hole
 * before it. Other structs never change. A plugin that uses what is new looks at structBytes of TmGrid or TmServices
 * first; the renderer looks at structBytes of all that plugins give, and takes what they do not know of as the
 * defaults. Anything else is ABI 2. tests/abi/ keeps the headers of ABI 1, and plugins that
 * are compiled against them. */
#pragma once
#include "reyes/shader/services.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct TmShader {
  uint32_t abi, structBytes; /* TM_SHADER_ABI and sizeof(TmShader) of the plugin's header: checked before all else */
  int32_t kind;              /* TmKind */
  uint32_t capabilities;     /* an or of TmCapability */
  int32_t paramCount;
  uint32_t paramBytes; /* sizeof(TmParamDecl) of the plugin's header */
  const TmParamDecl* params;
  void (*shade)(const TmGrid* grid);
  const char* name;
  const char* doc;
  /* A mistake that the author has to mend, such as a parameter that is listed at two places. It is reported, and the
   * shader is left out. NULL if there is none. */
  const char* fault;
  /* For `tomales shadetest --check`; NULL where a plugin has no such function. Moves the k-th parameter of the plugin's
   * code that this shader does not list behind its last one, puts every other back in its place, and returns its name.
   * Returns NULL where there are not so many; all parameters are then in their places. */
  const char* (*unlist)(const struct TmShader*, int32_t k);
} TmShader;

typedef struct TmShaderLibrary {
  uint32_t abi, structBytes;
  const TmShader* const* shaders;
  const char* fault; /* a mistake that concerns the whole plugin, as TmShader::fault */
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
