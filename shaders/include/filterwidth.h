/* How much of a pattern one shading sample covers.
 *
 * filterwidth(x): of a float; filterwidthp(p): of a point. Neither is ever 0, so that one may divide by it.
 */
#ifndef FILTERWIDTH_H
#define FILTERWIDTH_H

#ifndef MINFILTWIDTH
#define MINFILTWIDTH 1.0e-6
#endif

/* Macros, because public shaders ask "#ifndef filterwidth". */
#ifndef filterwidth
#define filterwidth(x) max(MINFILTWIDTH, abs(Du(x) * du) + abs(Dv(x) * dv))
#endif
#ifndef filterwidthp
#define filterwidthp(p) max(MINFILTWIDTH, sqrt(area(p)))
#endif

#endif
