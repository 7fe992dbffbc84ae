// RSL's message passing: what shaders may know of each other, of attributes, options and the renderer.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

int32_t ask(void* host, const TmGrid*, int32_t whom, int32_t light, const char* name, int32_t* type, TmValue* out);

}  // namespace tomales
