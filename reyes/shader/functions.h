/* Functions of plugins that shaders in the shading language call as if they were built in; other renderers know them as
 * DSO shadeops. The interface is plain C. A plugin exports TM_FUNCTIONS_SYMBOL, with or without shaders of its own.
 * Threads: a function runs on many threads at once and must keep no state. */
#pragma once
#include "reyes/shader/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A call for all points of a batch. */
typedef struct TmFunctionCall {
  uint32_t structBytes;
  int32_t count;
  const uint8_t* active; /* 1 where a point wants a result */
  /* The result first, unless the function is void; then the arguments, in their order. Component k of point i is
   * c[k][i * step]. The result and outputs have step 1, and the function writes them for active points (it casts const
   * away); an output holds no value before. A matrix is 16 numbers of c[0], the same for all points, and a text is
   * `string`. */
  const TmValue* args;
} TmFunctionCall;

typedef struct TmFunction {
  /* The declaration in the shading language, without names of arguments: "color weave(float, float, output float)".
   * The types are float, color, point, vector, normal, matrix and string; a result, and outputs, must not be a matrix
   * or a string. Several functions may have one name. */
  const char* prototype;
  const char* doc; /* a line for users */
  void (*call)(const TmFunctionCall*);
} TmFunction;

typedef struct TmFunctionLibrary {
  uint32_t abi, structBytes; /* TM_SHADER_ABI and sizeof(TmFunctionLibrary) */
  const TmFunction* functions;
  int32_t count;
  uint32_t functionBytes; /* sizeof(TmFunction) */
} TmFunctionLibrary;

typedef const TmFunctionLibrary* (*TmFunctionsFunction)(void);
#define TM_FUNCTIONS_SYMBOL "tomales_functions"

#ifdef __cplusplus
}
#endif
