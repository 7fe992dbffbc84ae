// The five bases that RISpec section 5.2 names, and the step of each.
#include "reyes/prim_factories.h"

namespace tomales {

Basis bezierBasis() { return {mat4(-1, 3, -3, 1, 3, -6, 3, 0, -3, 3, 0, 0, 1, 0, 0, 0), 3}; }

Basis bsplineBasis() { return {mat4(-1, 3, -3, 1, 3, -6, 3, 0, -3, 0, 3, 0, 1, 4, 1, 0) / 6.0f, 1}; }

Basis catmullRomBasis() { return {mat4(-1, 3, -3, 1, 2, -5, 4, -1, -1, 0, 1, 0, 0, 2, 0, 0) / 2.0f, 1}; }

Basis hermiteBasis() { return {mat4(2, 1, -2, 1, -3, -2, 3, -1, 0, 1, 0, 0, 1, 0, 0, 0), 2}; }

Basis powerBasis() { return {mat4(1.0f), 4}; }

}  // namespace tomales
