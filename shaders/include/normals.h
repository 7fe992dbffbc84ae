/* The normal that a surface is shaded with. */
#ifndef NORMALS_H
#define NORMALS_H

/* The unit normal towards the viewer. It is not turned for the camera if the surface has one side alone. */
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
