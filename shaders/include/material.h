/* Materials as functions: what a surface of the given colour sends to the viewer. Names and arguments are those of the
 * header that "Advanced RenderMan" (A. Apodaca and L. Gritz, 1999) made known.
 */
#ifndef MATERIAL_H
#define MATERIAL_H

#include "reflections.h"

/* A highlight with an edge, as glaze has. The edge is where the lobe around the half vector falls to 0.72, and it is
 * the more sudden the nearer `sharpness` is to 1. */
color LocIllumGlossy(normal n; vector v; float roughness, sharpness) {
  extern point P;
  color sum = 0;
  float edge = 0.18 * (1 - sharpness);
  illuminance(P, n, PI / 2) {
    extern vector L;
    extern color Cl;
    vector halfway = normalize(normalize(L) + v);
    sum += Cl * smoothstep(0.72 - edge, 0.72 + edge, pow(max(0, n.halfway), 1 / roughness));
  }
  return sum;
}

/* M. Oren and S. Nayar, "Generalization of Lambert's Reflectance Model", 1994: their equation 30, of first order.
 * `roughness` is the standard deviation of the slopes' angle, in radians. */
color LocIllumOrenNayar(normal n; vector v; float roughness) {
  extern point P;
  float square = roughness * roughness;
  float a = 1 - 0.5 * square / (square + 0.33), b = 0.45 * square / (square + 0.09);
  float seen = acos(clamp(n.v, -1, 1));
  vector vtangent = normalize(v - n * (n.v));
  color sum = 0;
  illuminance(P, n, PI / 2) {
    extern vector L;
    extern color Cl;
    vector l = normalize(L);
    float cosine = l.n, lit = acos(clamp(cosine, -1, 1));
    float between = vtangent.normalize(l - n * cosine);
    sum += Cl * cosine * (a + b * max(0, between) * sin(max(seen, lit)) * tan(min(seen, lit)));
  }
  return sum;
}

color MaterialMatte(normal Nf; color basecolor; float Ka, Kd) {
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf));
}

color MaterialClay(normal Nf; color basecolor; float Ka, Kd, roughness) {
  extern vector I;
  return basecolor * (Ka * ambient() + Kd * LocIllumOrenNayar(Nf, -normalize(I), roughness));
}

color MaterialPlastic(normal Nf; color basecolor; float Ka, Kd, Ks, roughness) {
  extern vector I;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -normalize(I), roughness);
}

color MaterialRoughMetal(normal Nf; color basecolor; float Ka, Kd, Ks, roughness) {
  extern vector I;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Ks * specular(Nf, -normalize(I), roughness));
}

/* Plastic with a mirror image on it, which is stronger at grazing angles. */
color MaterialShinyPlastic(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, Kr, blur, ior, twosided;
                           DECLARE_ENVPARAMS) {
  extern point P;
  extern vector I;
  extern normal N;
  vector in = normalize(I), R = 0, T = 0;
  float kr = 0, kt = 0;
  fresnel(in, Nf, N.I > 0 && twosided == 0 ? ior : 1 / ior, kr, kt, R, T);
  return (1 - kr) * basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -in, roughness) +
         SampleEnvironment(P, R, kr * Kr, blur, ENVPARAMS);
}

/* Metal with a mirror image of its own colour. */
color MaterialShinyMetal(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, Kr, blur, twosided;
                         DECLARE_ENVPARAMS) {
  extern point P;
  extern vector I;
  extern normal N;
  vector in = normalize(I);
  float shown = N.I > 0 && twosided == 0 ? 0 : Kr;
  return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Ks * specular(Nf, -in, roughness) +
                      SampleEnvironment(P, reflect(in, Nf), shown, blur, ENVPARAMS));
}

#endif
