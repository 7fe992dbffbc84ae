/* The normal that a surface is shaded with. */
#ifndef NORMALS_H
#define NORMALS_H

/* Of length 1, and towards the viewer: a surface that has one side alone is not turned for the camera. */
normal shadingnormal(normal n) {
  extern vector I;
  normal shading = normalize(n);
  uniform float sides = 2, depth = 0;
  attribute("Sides", sides);
  rayinfo("depth", depth);
  if (sides == 2 || depth > 0) shading = faceforward(shading, I, shading);
  return shading;
}

#define ShadingNormal(n) shadingnormal(n)

#endif
