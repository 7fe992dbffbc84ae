/* Reflections from environment maps.
 *
 * A shader that uses them takes DECLARE_DEFAULTED_ENVPARAMS among its parameters, a function takes DECLARE_ENVPARAMS,
 * and both pass on ENVPARAMS: the name of a map ("": none), the space that it was made in, and the radius of the sphere
 * that it is painted on, in that space; 0: far away.
 */
#ifndef REFLECTIONS_H
#define REFLECTIONS_H

#define ENVPARAMS envname, envspace, envrad
#define DECLARE_ENVPARAMS   \
  string envname, envspace; \
  uniform float envrad
#define DECLARE_DEFAULTED_ENVPARAMS        \
  string envname = "", envspace = "world"; \
  uniform float envrad = 100

/* The picture that is seen from p in the direction r. alpha is the share of it that the map covers. */
color Environment(string name, space; uniform float radius; point p; vector r; float blur; output float alpha) {
  point q = transform(space, p);
  vector look = normalize(vtransform(space, r));
  if (radius > 0) {
    /* The point where the ray leaves the sphere around the origin. For p outside, the map counts as far away. */
    float along = look.vector(q);
    float inside = along * along - vector(q).vector(q) + radius * radius;
    if (inside > 0 && vector(q).vector(q) < radius * radius) look = vector(q) + look * (sqrt(inside) - along);
  }
  alpha = float environment(name[3], look, "blur", blur, "fill", 1);
  return color environment(name, look, "blur", blur);
}

/* Looks up a picture of the mirror image, as the camera sees it. */
color ReflMap(string name; point p; float blur; output float alpha) {
  point ndc = transform("NDC", p);
  float x = xcomp(ndc), y = ycomp(ndc);
  alpha = float texture(name[3], x, y, "blur", blur, "fill", 1);
  return color texture(name, x, y, "blur", blur);
}

color SampleEnvironment(point p; vector r; float kr, blur; DECLARE_ENVPARAMS) {
  color seen = 0;
  float alpha = 0;
  if (envname != "" && kr > 0.0001) seen = kr * Environment(envname, envspace, envrad, p, r, blur, alpha);
  return seen;
}

#endif
