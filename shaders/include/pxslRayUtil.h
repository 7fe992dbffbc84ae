/* The part of what shaders that Slim has written call that rays need: see pxslUtil.h. */
#ifndef PXSLRAYUTIL_H
#define PXSLRAYUTIL_H

#include "normals.h"

#define pxslUtilShadingNormal(n) shadingnormal(n)

#endif
