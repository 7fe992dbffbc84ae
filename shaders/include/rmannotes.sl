/* The other name of rmannotes.h. */
#include "rmannotes.h"
