/* The functions that shaders written by Slim call and that need rays: see pxslUtil.h. */
#ifndef PXSLRAYUTIL_H
#define PXSLRAYUTIL_H

#include "normals.h"

#define pxslUtilShadingNormal(n) shadingnormal(n)

#endif
