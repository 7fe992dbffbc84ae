/* Displacement and bump mapping by one call. */
#ifndef DISPLACE_H
#define DISPLACE_H

/* Moves P by `amplitude`, measured in `space`, along `direction`, and gives the new normal. `truedisp` is the part of
 * it that moves the surface, from 0 (a bump map) to 1; the normal is that of the whole. */
normal Displace(normal direction; string space; float amplitude, truedisp) {
  extern point P;
  vector unit = normalize(vector direction);
  vector offset = unit * (amplitude / length(vtransform(space, unit)));
  point whole = P + offset;
  P += truedisp * offset;
  return normalize(calculatenormal(whole));
}

#endif
