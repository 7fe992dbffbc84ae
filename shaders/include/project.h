/* Projects a point in space to two coordinates for a picture. */
#ifndef PROJECT_H
#define PROJECT_H

#include "filterwidth.h"

/* Old shaders declare arrays for parameters that stand for matrices. */
matrix array_to_mx(uniform float m[16]) {
  return matrix(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]);
}

/* `projection`: "st" (the surface's own), "planar" (x, y), "perspective" (x/z, y/z), "spherical" (longitude, latitude)
 * or "cylindrical" (longitude, z), of p in the space that is named and then transformed by `xform`. ds and dt are how
 * much of them a sample covers. */
void ProjectTo2D(string projection; point p; string space; matrix xform; output float ss, tt, ds, dt) {
  extern float s, t, du, dv;
  point q = 0;
  if (projection == "st") {
    q = transform(xform, point(s, t, 0));
    ss = xcomp(q);
    tt = ycomp(q);
  } else {
    q = transform(xform, transform(space, p));
    ss = xcomp(q);
    tt = ycomp(q);
    if (projection == "perspective") {
      float z = max(zcomp(q), 1e-6);
      ss = xcomp(q) / z;
      tt = ycomp(q) / z;
    } else if (projection == "spherical") {
      vector v = normalize(vector q);
      ss = mod(atan(ycomp(v), xcomp(v)) / (2 * PI), 1);
      tt = acos(-zcomp(v)) / PI;
    } else if (projection == "cylindrical") {
      ss = mod(atan(ycomp(q), xcomp(q)) / (2 * PI), 1);
      tt = zcomp(q);
    }
  }
  ds = filterwidth(ss);
  dt = filterwidth(tt);
  if (projection == "spherical" || projection == "cylindrical") ds = min(ds, abs(1 - ds)); /* across the seam */
}

#endif
