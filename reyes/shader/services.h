/* The services of the renderer for shaders: light, rays, pictures, spaces, other shaders. Part of reyes/shader_api.h;
 * plain C. Every call works on the whole batch, obeys `active`, and takes TmGrid::host and the batch first. Options may
 * be NULL (reyes/shader/options.h). */
#pragma once
#include "reyes/shader/options.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct TmServices {
  uint32_t structBytes;
  uint32_t abi; /* the renderer's TM_SHADER_ABI */

  /* --- The surface */

  /* Maps between named spaces (current, camera, world, object, shader, raster, NDC, screen or a CoordinateSystem).
   * `kind` is a TmTransformKind. Returns 0 and copies if a space is unknown, or if a vector or a normal would go to or
   * from a projected space, where it has no meaning. in and out may be the same. */
  int32_t (*transform)(void* host, const TmGrid*, int32_t kind, const char* from, const char* to, TmConstVec3 in,
                       TmVec3 out);
  /* RISpec calculatenormal(): the normal that the batch's surface would have if its points were at P. A shader that is
   * not a displacement needs TM_NEIGHBOURS for it, or gets a copy of N. */
  void (*calculateNormal)(void* host, const TmGrid*, TmConstVec3 P, TmVec3 out);
  /* The derivative of a value by u (direction 0) or v (1) at every point, by centred differences that are one-sided at
   * the border of a grid. With TM_DERIVATIVES it works for u, v, s, t, P, N and primitive variables; with TM_NEIGHBOURS
   * and in displacements it works for all values. */
  void (*derivative)(void* host, const TmGrid*, int32_t direction, const float* value, float* out);

  /* --- Light (RISpec 15.6). N, V need not be of unit length. */

  /* The sum of the Cl of ambient lights. */
  void (*ambient)(void* host, const TmGrid*, TmVec3 out);
  /* The sum of Cl * max(0, L.N), which is E/pi. `which` is a TmLightChoice. */
  void (*diffuse)(void* host, const TmGrid*, int32_t which, TmConstVec3 N, TmVec3 out);
  /* The sum of Cl * max(0, N.H)^(8/roughness); docs/decisions/0004 is about the exponent. */
  void (*specular)(void* host, const TmGrid*, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out);
  /* RISpec illuminance(), sample by sample. Call it with the same mask until it returns 0: there are no more. Ambient
   * lights are not listed. The arrays live until the shader returns; but if P is not the batch's, or lights get
   * messages or run again, they live only until four more such samples have been asked for. */
  int32_t (*illuminance)(void* host, const TmGrid*, TmIlluminance*);
  /* Indirect light at P on the side of N: E/pi, unclamped, and one unit dominant direction for each of red, green and
   * blue (Tabellion and Lamorlette 2004, eq. 7). `dominant` is NULL or an array of three vectors. A light with
   * TM_LIGHT_INDIRECT gets it by its own parameters, other shaders by those of the scene's. */
  void (*indirectDiffuse)(void* host, const TmGrid*, TmConstVec3 N, TmVec3 out, TmVec3* dominant);
  /* RISpec shadow(): the share of light at P that shadow map `name` blocks (1: all), a colour for deep maps. It is 0
   * outside the map, for "raytrace", and where the map cannot be read (the renderer traces those shadows itself). */
  void (*shadow)(void* host, const TmGrid*, const char* name, const TmShadowOptions*, TmConstVec3 P, TmVec3 out);

  /* Multiple importance sampling of a surface's own lobe f (the cosine included, over pi less), as specular() does it.
   * With m directions of its own, lobeSamples() or more, that it draws with the density p(L) over solid angle, the
   * highlight is the sum of
   *   f(L) Cl / (1 + (m p(L) / d)^2)  over illuminance() at the points themselves, with d of lightDensity(); wholly
   *                                   where d is 0, and
   *   f(L) Cl                         over these directions, with Cl of lightAlong().
   * A shader may count another number than the m that it draws, if it does so in both sums, as `disney` does; and d
   * counts a sample of a sky as less than one (docs/decisions/0191). lightDensity: `light` is TmIlluminance::light; 0
   * where lightAlong() would not find the light. lightAlong: L of unit length, sample number 0..m-1, density p(L), 0
   * for none. stratified: numbers in [0,1) for sample number `sample`. */
  int32_t (*lobeSamples)(void* host, const TmGrid*);
  void (*lightDensity)(void* host, const TmGrid*, int32_t light, float* out);
  void (*lightAlong)(void* host, const TmGrid*, TmConstVec3 L, const float* density, int32_t sample, int32_t samples,
                     TmVec3 Cl);
  void (*stratified)(void* host, const TmGrid*, int32_t sample, int32_t samples, float* xi0, float* xi1);

  /* --- Rays. Shaders that call these have TM_TRACES. Narrow cones (up to 10 degrees) shoot specular rays, wide ones
   * diffuse rays: Attribute "visibility" and the depth limits of "trace" tell them apart. They start by the hit-list
   * origin offset, unless there is a bias. */

  /* The mean colour that the rays see, through transparent surfaces, and the least distance to a hit (1e30: none).
   * Either array may be NULL (for the colour: its x). */
  void (*trace)(void* host, const TmGrid*, const TmRayOptions*, TmConstVec3 P, TmConstVec3 direction, TmVec3 color,
                float* distance);
  /* The share of light that travels from P along `toward` to its tip (1: all); several samples spread over a cone. */
  void (*transmission)(void* host, const TmGrid*, const TmRayOptions*, TmConstVec3 P, TmConstVec3 toward, TmVec3 out);
  /* Ray number `ray` of the options' samples of each active point, around `axis`: hit[i] says whether it met anything,
   * and outputs are set where it did ("ray:" values everywhere). Returns 0 when there are no more. With
   * TmRayOptions::environment none is traced: all miss, and leave in all directions, half of them by the brightness of
   * that picture.
   * Outputs are "surface:" Ci, Oi or an output parameter of the shader that is met, "volume:" Ci, Oi (the same after
   * the asking surface's Interior or Exterior), "primitive:" P, N, Ng, I, dPdu, dPdv, u, v, s, t, Cs, Os or a primitive
   * variable, "attribute:category:name", "ray:origin", "ray:direction", "ray:length", "effectivedistance" (of all that
   * the ray goes through until it is covered, weighted by what each covers), and of an environment "environment:color",
   * "environment:direction", "environment:solidangle" (over all rays, color times it adds up to the light of the
   * picture). Where what is met has no value of that name and type, the arrays keep theirs. */
  int32_t (*gather)(void* host, const TmGrid*, const TmRayOptions*, TmConstVec3 P, TmConstVec3 axis, int32_t ray,
                    uint8_t* hit, const TmChannel* outputs, int32_t outputCount);
  /* RISpec occlusion() and indirectdiffuse() of the cone around N (coneAngle 0: the hemisphere). Returns 0 if a point
   * cloud is missing, which has been reported. */
  int32_t (*occlusion)(void* host, const TmGrid*, const TmRayOptions*, TmConstVec3 P, TmConstVec3 N,
                       const TmOcclusion*);
  /* A value of the ray that came to these points: "type" (0 camera, 1 diffuse, 2 specular, 3 transmission), "depth",
   * "diffusedepth", "speculardepth", "shadowdepth", "importance", "length" and "highlights" (0: a gather ray, which
   * wants none) in x alone; "origin" and "direction" in x, y and z. Returns 0 if there is no such name. */
  int32_t (*rayInfo)(void* host, const TmGrid*, const char* name, TmVec3 out);
  /* The label of the ray that came to these points. */
  const char* (*rayLabel)(void* host, const TmGrid*);

  /* --- Pictures. One channel where out.y is NULL, else three. They return 0 when the file is missing: the error has
   * been reported and `out` holds the loud substitute. */

  /* Looks picture `name` up at (s, t); t grows down the image. */
  int32_t (*texture)(void* host, const TmGrid*, const char* name, const TmTextureOptions*, const float* s,
                     const float* t, TmVec3 out);
  /* Radiance of the latitude-longitude picture `name` towards `direction` (current space, any length). The picture
   * stands in world space: +z at its top, +x at its left edge, +y a quarter to the right (RISpec 3.2,
   * MakeLatLongEnvironment). "raytrace" traces rays. */
  int32_t (*environment)(void* host, const TmGrid*, const char* name, const TmTextureOptions*, TmConstVec3 direction,
                         TmVec3 out);
  /* RISpec textureinfo(): "exists", "resolution", "type", "channels", "bitsperchannel", "viewingmatrix",
   * "projectionmatrix". Answers as ask() does. */
  int32_t (*textureInfo)(void* host, const TmGrid*, const char* name, const char* what, int32_t* type, TmValue* out);

  /* --- Point clouds. They return 0 if the file or a channel is missing, which has been reported. */

  /* RISpec's bake3d: where the camera sees a point, it goes to the point cloud `file` (.ptc) with its values, to be
   * written when the frame ends. N of zero length: a sphere. Returns 0 if it cannot be, which has been reported. */
  int32_t (*bake3d)(void* host, const TmGrid*, const char* file, const TmCloudOptions*, TmConstVec3 P, TmConstVec3 N,
                    const TmChannel* values, int32_t valueCount);
  /* Looks up values around P in a point cloud (.ptc, held whole) or brick map (.bkm), on surfaces that face as N does
   * (zero length: on all). found[i] is 1 where there are any; elsewhere the values are left alone. */
  int32_t (*texture3d)(void* host, const TmGrid*, const char* file, const TmCloudOptions*, TmConstVec3 P, TmConstVec3 N,
                       const TmChannel* values, int32_t valueCount, float* found);
  /* Gives E/pi at P on the side of N from a photon map. */
  int32_t (*photonMap)(void* host, const TmGrid*, const char* file, const TmPhotonOptions*, TmConstVec3 P,
                       TmConstVec3 N, TmVec3 out);
  /* Gives the light that enters where a point cloud was baked and leaves at P, by the diffusion approximation, as E/pi.
   * The cloud holds "_area" and "_radiance_t", what diffuse() gives to a surface that lets all light in. */
  int32_t (*subsurface)(void* host, const TmGrid*, const char* file, const TmSubsurfaceOptions*, TmConstVec3 P,
                        TmVec3 out);

  /* --- Messages */

  /* Gets a value of something else (TmWhom). `type` becomes its TmType, and `out` is laid out as a parameter of this
   * shader. It lives until the shader returns, or as long as the arrays of the illuminance() that listed the light.
   * Returns 0 if there is no such value. `light` counts for TM_OF_LIGHT alone; negative: the light that is running. */
  int32_t (*ask)(void* host, const TmGrid*, int32_t whom, int32_t light, const char* name, int32_t* type, TmValue* out);
  /* Reports to the user, once for each shader and object; `severity` is a TmSeverity. */
  void (*report)(void* host, const TmGrid*, int32_t severity, const char* message);
  /* RISpec printf(): prints a line on standard error, which other threads' lines do not break up. It ends with one
   * newline, whether the text has it or not. */
  void (*print)(void* host, const TmGrid*, const char* text);

  /* --- Volumes */

  /* For volume shaders, along the ray of each point from P - I to P: the amount of what fills the volume that lies on
   * the first `distance` of it, and the density there. The amount is the integral of the density; lengths are units of
   * the world. With byAmount, `amount` is given and `distance` is found. Where the air is the same everywhere, the
   * density is 1. */
  void (*crossed)(void* host, const TmGrid*, int32_t byAmount, float* distance, float* amount, float* density);
} TmServices;

#ifdef __cplusplus
}
#endif
