/* The name under which some shaders know patterns.h. */
#include "patterns.h"
