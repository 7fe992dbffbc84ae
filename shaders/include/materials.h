/* The other spelling of material.h. */
#include "material.h"
