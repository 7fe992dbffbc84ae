/* Macros for shaders that MayaMan wrote from networks of Maya's nodes. A node is two macros, NODE_SETUP(v) and
 * NODE_SIM(v). v is the beginning of the names of the node's attributes: the colour of v_0_ is v_0_color. The models
 * are those that Maya's documentation names.
 */
#ifndef MAYA_MAGIC_SHADERS_H
#define MAYA_MAGIC_SHADERS_H

#include "noises.h"
#include "normals.h"

/* --- The frame of every such shader */
#define ALL_SURFACE_ARGS uniform float only_do_opacity = 0
#define PREF_VAR varying point __Pref = point "shader"(0, 0, 0)
#define SURFACE_TEMPS                   \
  normal mayaNormal = shadingnormal(N); \
  vector mayaView = -normalize(I)
#define APPLY_SLICE_PLANE \
  if (0 == 1) Oi = 0;
#define DEEP_SHADOW_OPACITY_HANDLER
#define SURFACE_DEBUG_HOOK
#define PROFILE(what)
#define MTX_CVT(a, i)                                                                                               \
  matrix(a[i], a[i + 1], a[i + 2], a[i + 3], a[i + 4], a[i + 5], a[i + 6], a[i + 7], a[i + 8], a[i + 9], a[i + 10], \
         a[i + 11], a[i + 12], a[i + 13], a[i + 14], a[i + 15])

/* --- Materials: their transparency becomes opacity. */
#define MAYA_MATERIAL(v) \
  color v##outColor = 0; \
  v##normalCamera = mayaNormal;
#define MAYA_LIT(v)                 \
  Os *= color(1) - v##transparency; \
  v##outColor =                     \
      Os * (v##color * (v##diffuse * diffuse(v##normalCamera) + v##ambientColor + ambient()) + v##incandescence)

#define LAMBERT_SETUP(v) MAYA_MATERIAL(v)
#define LAMBERT_SIM(v) MAYA_LIT(v)

#define PHONG_SETUP(v) MAYA_MATERIAL(v)
#define PHONG_SIM(v) \
  MAYA_LIT(v);       \
  v##outColor +=     \
      v##specularColor * (phong(v##normalCamera, mayaView, v##cosinePower) + v##reflectivity * v##reflectedColor)

/* Highlights of J. Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977, by eccentricity. */
color mayaBlinn(normal n; vector view; float eccentricity, rolloff) {
  extern point P;
  color sum = 0;
  float e2 = max(eccentricity * eccentricity, 1.0e-4);
  illuminance(P, n, PI / 2) {
    extern vector L;
    extern color Cl;
    float dull = 0;
    vector toLight = normalize(L), halfway = normalize(toLight + view);
    float nh = max(n.halfway, 0), nv = max(n.view, 1.0e-4), nl = max(n.toLight, 0), vh = max(view.halfway, 1.0e-4);
    lightsource("__nonspecular", dull);
    float slopes = e2 / (nh * nh * (e2 - 1) + 1);
    float masked = min(1, min(2 * nh * nv / vh, 2 * nh * nl / vh));
    float grazing = pow(1 - vh, 3);
    sum += (1 - dull) * Cl * slopes * slopes * masked / nv * (grazing + (1 - grazing) * rolloff);
  }
  return sum;
}
#define BLINN_SETUP(v) MAYA_MATERIAL(v)
#define BLINN_SIM(v)                                                                                             \
  MAYA_LIT(v);                                                                                                   \
  v##outColor += v##specularColor * (mayaBlinn(v##normalCamera, mayaView, v##eccentricity, v##specularRollOff) + \
                                     v##reflectivity * v##reflectedColor)

/* --- Patterns */
#define BROWNIAN_SETUP(v) \
  color v##outColor = 0;  \
  float v##outAlpha = 0;
#define BROWNIAN_SIM(v)                                                                            \
  {                                                                                                \
    point mayaPlace = transform(v##placementMatrix, transform("world", P));                        \
    float mayaSum = 0.5 + 0.5 * fBm(mayaPlace, filterwidthp(mayaPlace), v##octaves, v##lacunarity, \
                                    pow(v##lacunarity, -v##increment - 0.5));                      \
    v##outColor = v##colorGain * mayaSum + v##colorOffset;                                         \
    v##outAlpha = v##alphaGain * mayaSum + v##alphaOffset;                                         \
  }

#define PLACE3DTEXTURE_SETUP(v) uniform matrix v##worldInverseMatrix[1];
#define PLACE3DTEXTURE_SIM(v) v##worldInverseMatrix[0] = 1 / v##worldMatrix[0];

#endif
