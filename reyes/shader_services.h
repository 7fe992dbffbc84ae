/* What a shader may ask of the renderer: light, rays, pictures, spaces, other shaders. Part of reyes/shader_api.h;
 * plain C. */
#pragma once
#include "reyes/shader_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One sample of one light at every point of the batch. */
typedef struct TmLightSample {
  TmConstVec3 L;  /* unit vector from P to the light */
  TmConstVec3 Cl; /* shadowed, divided by the number of samples */
  int32_t isIndirect, nondiffuse, nonspecular;
} TmLightSample;

typedef enum TmLightChoice { TM_DIRECT_LIGHT = 1, TM_INDIRECT_LIGHT = 2 } TmLightChoice;

typedef enum TmHitSides { TM_HIT_BOTH = 0, TM_HIT_FRONT = 1, TM_HIT_BACK = 2 } TmHitSides;
typedef enum TmHitMode { TM_HIT_DEFAULT = 0, TM_HIT_PRIMITIVE = 1, TM_HIT_SHADER = 2 } TmHitMode;

/* How rays are shot. Start from TM_RAY_DEFAULTS. Directions are stratified over the rays of a point and reproducible.
 */
typedef struct TmRayOptions {
  uint32_t structBytes;
  int32_t samples; /* rays a point */
  float coneAngle; /* half angle around the axis, radians, up to pi/2; 0: all along it */
  int32_t uniform; /* 1: evenly over the cone's solid angle; 0: by the cosine with its axis */
  float bias;      /* hits nearer do not count; < 0: as the object's attributes say */
  float maxDistance;
  float sampleBase;  /* share of its micropolygon, 0..1, that the rays of a point start from */
  const char* label; /* seen by rayLabel() at what they meet; NULL: "" */
  const char *subset,
      *excludeSubset;        /* sets of Attribute "grouping" "membership", by commas or spaces; NULL: all, none */
  int32_t hitSides, hitMode; /* TmHitSides; TmHitMode, default: as the attributes of what is met say */
  float opacityThreshold;    /* rays go on behind what is transparent until this much is covered */
  float falloff;             /* occlusion(): what is met at distance d counts exp(-falloff d), or with */
  int32_t falloffMode;       /* mode 1 (1 - d / maxDistance)^falloff; falloff 0: wholly */
  int32_t drawn,
      number; /* trace() along directions that the caller draws itself, one a call: how many, and which this is */
  int32_t passLamps;  /* 1: area lights do not glow for these rays, since lightAlong() or specular() has brought them */
  float maxVariation; /* occlusion() of a whole hemisphere by the cosine: how far an answer may be off that is
                       * interpolated between records (docs/gi.md); 0: traced at every point; < 0: as Attribute
                       * "irradiance" "maxerror" says, if it is given */
  float importance; /* of what the rays bring, 0 to 1: rayInfo("importance") where they arrive is the product of all on
                       the way */
  /* occlusion(), and the first two gather(): */
  const char *environment, *environmentSpace; /* the latitude-longitude picture that rays see which meet nothing (NULL:
                                               * black), and the space whose +z is its top (NULL: "world"). gather():
                                               * the picture that directions are drawn from */
  const char *pointCloud,
      *pointChannel;   /* the disks of this file (.ptc) are in the way instead of geometry (NULL: rays), and the channel
                        * of what   they send (NULL: "_radiosity"); world space */
  float maxSolidAngle; /* disks that together are seen under less count as one */
  int32_t clamp;       /* 1: disks behind others do not count, 0: all do */
} TmRayOptions;

#define TM_RAY_DEFAULTS                                                                                               \
  {                                                                                                                   \
    sizeof(TmRayOptions), 1, 0, 0, -1, 1e30f, 0, 0, 0, 0, TM_HIT_BOTH, TM_HIT_DEFAULT, 1, 0, 0, 0, 0, 0, -1, 1, 0, 0, \
        0, 0, 0.01f, 1                                                                                                \
  }

/* What a hemisphere (or a cone) of rays finds. NULL: not wanted. */
typedef struct TmHemisphere {
  uint32_t structBytes;
  float* covered;              /* share of it, with falloff */
  TmVec3 radiance;             /* mean of what arrives from there, the environment included */
  TmVec3 environmentColor;     /* the same of the environment alone */
  TmVec3 environmentDirection; /* mean direction of the rays that meet nothing, unit length, or 0 */
} TmHemisphere;

/* How photons are looked up. Start from TM_PHOTON_DEFAULTS. */
typedef struct TmPhotonLookup {
  uint32_t structBytes;
  int32_t estimator; /* the nearest photons that count */
  float maxDistance; /* none farther away does, in units of the file's space; 0: a twentieth of the map's diagonal */
} TmPhotonLookup;

#define TM_PHOTON_DEFAULTS \
  { sizeof(TmPhotonLookup), 50, 0 }

/* One value of each ray of gather(): "surface:" Ci, Oi or an output parameter of the shader that is met, "primitive:"
 * P, N, Ng, I, dPdu, dPdv, u, v, s, t, Cs, Os or a primitive variable, "attribute:category:name", "ray:origin",
 * "ray:direction", "ray:length", "effectivedistance" (of all that the ray goes through until it is covered, weighted by
 * what each covers), and of an environment "environment:color", "environment:direction", "environment:solidangle" (what
 * the ray stands for: over all rays, color times it adds up to the light of the whole picture). Numbers fill c[0],
 * triples all; what is met has no value of that name or type: the arrays keep theirs. */
typedef struct TmRayOutput {
  const char* name;
  int32_t floats; /* 1 or 3 */
  float* c[3];
} TmRayOutput;

/* Whose value ask() looks for. Parameters and outputs by name; "__shadername" is a shader's own name. */
typedef enum TmWhom {
  TM_OF_SURFACE = 0,
  TM_OF_DISPLACEMENT = 1,
  TM_OF_ATMOSPHERE = 2,
  TM_OF_INCIDENT = 3,   /* the volume shader on the side of the surface that I arrives at (Exterior, Interior) */
  TM_OF_OPPOSITE = 4,   /* and that on the other side */
  TM_OF_LIGHT = 5,      /* a light: TmIlluminance::light */
  TM_OF_ATTRIBUTES = 6, /* "Ri:ShadingRate", "user:name", "category:name" (rispec-table section 4) */
  TM_OF_OPTIONS = 7,    /* "Format", "Shutter", "Clipping", "Frame", "user:name", "category:name" */
  TM_OF_RENDERER = 8    /* "renderer", "version" (four numbers), "versionstring" */
} TmWhom;

/* RSL's "send:light:NAME": the parameter of that name, of lights that have one, takes this value, which is as a
 * parameter of the sender would be: a number, a triple or a string. */
typedef struct TmMessage {
  const char* name;
  int32_t type; /* TmType */
  TmValue value;
} TmMessage;

/* illuminance(): start with next = 0 and call until 0 is returned. What follows an earlier release's last field is 0
 * there. */
typedef struct TmIlluminance {
  uint32_t structBytes;
  int32_t next;
  const char*
      category; /* "", NULL: all lights; "a,b": one of these; "-a": without; "a&-b" (parameter __category of lights) */
  TmConstVec3 axis; /* x NULL: from all around; else from the cone of half angle `angle` around it */
  float angle;
  int32_t light;      /* out, and all below: for ask() */
  TmConstVec3 L;      /* from P to the light, of full length; unit length where it is at infinity */
  TmConstVec3 Cl;     /* shadowed, divided by the number of samples */
  const uint8_t* lit; /* 1: active, and the sample comes from the cone */
  int32_t isIndirect, nondiffuse, nonspecular;
  TmConstVec3 P; /* in: where the light arrives; x NULL: at the shaded points. Volumes that give it ask in the air,
                  * which no indirect light reaches, where light shaders see an N of 0 and rays start at once: not for
                  * the surface itself */
  const float* angles;   /* in: for each point, instead of `angle`; NULL */
  const TmMessage* sent; /* in: for the lights that run */
  int32_t sentCount;
  int32_t refresh; /* in: 1: lights run again ("lightcache" "refresh") even if they have for the same P, category and
                      messages */
} TmIlluminance;

/* How texture() and environment() look up (rispec-table section 10). Start from TM_TEXTURE_DEFAULTS. */
typedef struct TmTextureLookup {
  uint32_t structBytes;
  int32_t channel, channels; /* the first, and 1 or 3 */
  float fill;                /* of channels that the picture lacks */
  const char* filter;        /* NULL: "box" */
  float sblur, tblur;        /* added to the region, as a fraction of the picture */
  float swidth, twidth;      /* scale of the region; 0: a point */
  int32_t samples;           /* environment(), of "raytrace": rays */
  int32_t unused;            /* where an earlier release's struct ends in padding */
  float mipBias;             /* so many levels of the picture finer than the region asks for; negative: coarser */
  float ignoreAbove;         /* values greater than this are left out of what is averaged, texel by texel */
} TmTextureLookup;

#define TM_TEXTURE_DEFAULTS \
  { sizeof(TmTextureLookup), 0, 3, 0, 0, 0, 0, 1, 1, 1, 0, 0, 1e30f }

typedef enum TmTransformKind { TM_AS_POINT = 0, TM_AS_VECTOR = 1, TM_AS_NORMAL = 2 } TmTransformKind;

/* How a shadow map is looked up. */
typedef struct TmShadowLookup {
  float bias;        /* depth that an occluder must be nearer to the light by; negative: the scene's, or as needed */
  float blur, width; /* added region as a fraction of the map; scale of the micropolygon's own region */
  int32_t samples;
} TmShadowLookup;

/* One channel of bake3d() and texture3d(): a number or a triple for each point. */
typedef struct TmCloudValue {
  const char* name;
  int32_t floats; /* 1 or 3 */
  float* c[3];
} TmCloudValue;

/* How they see space. Start from TM_CLOUD_DEFAULTS. */
typedef struct TmCloudLookup {
  uint32_t structBytes;
  const char* coordSystem; /* of the file; NULL: "world" */
  const float*
      radius; /* current space: of the disk that is baked, of what is averaged over; NULL: of the micropolygon */
  float radiusScale;
} TmCloudLookup;

#define TM_CLOUD_DEFAULTS \
  { sizeof(TmCloudLookup), 0, 0, 1 }

/* What light diffuses through in subsurface(). Start from TM_SUBSURFACE_DEFAULTS: marble. */
typedef struct TmSubsurface {
  uint32_t structBytes;
  const char* coordSystem; /* of the file; NULL: "world" */
  const char* material; /* "apple", "chicken1", "chicken2", "cream", "ketchup", "marble", "potato", "skimmilk", "skin1",
                           "skin2", "spectralon", "wholemilk" (Jensen et al. 2001, figure 5); NULL: as follows */
  float scattering[3], absorption[3]; /* reduced scattering and absorption, 1/mm */
  float albedo[3], meanFreePath[3];   /* unless meanFreePath[0] is 0, instead of those: diffuse albedo, and diffuse mean
                                         free path in mm */
  float ior;
  float unitLength;    /* millimetres in one unit of the file's space */
  float maxSolidAngle; /* points that together are seen under less count as one; 0: each for itself */
} TmSubsurface;

#define TM_SUBSURFACE_DEFAULTS \
  { sizeof(TmSubsurface), 0, "marble", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 1.3f, 1, 0.1f }

/* What a shader may ask of the renderer. Every call works on the whole batch and obeys `active`. */
typedef struct TmServices {
  uint32_t structBytes;

  /* RISpec 15.6. diffuse: sum of Cl * max(0, L.N) (E/pi); specular: sum of Cl * max(0, N.H)^(8/roughness), see
   * docs/decisions on the exponent; ambient: sum of ambient Cl. N, V need not be unit length. */
  void (*diffuse)(void* host, const TmGrid*, TmConstVec3 N, TmVec3 out);
  void (*specular)(void* host, const TmGrid*, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out);
  void (*ambient)(void* host, const TmGrid*, TmVec3 out);

  /* illuminance(): fills `out` with light sample `index` (0, 1, ...); returns 0 when there are no more.
   * The arrays live until the shader returns. Ambient lights are not listed. */
  int32_t (*light)(void* host, const TmGrid*, int32_t index, TmLightSample* out);

  /* Between named spaces (current, camera, world, object, shader, raster, NDC, screen, or a CoordinateSystem).
   * Returns 0 and copies when a space is unknown. in and out may be the same arrays. */
  int32_t (*transform)(void* host, const TmGrid*, int32_t kind, const char* from, const char* to, TmConstVec3 in,
                       TmVec3 out);

  /* Texture `name` at (s,t) with the footprint of one point, `channels` floats (1 or 3) from `channel`, t down the
   * image. Returns 0 when the file is missing: the error has been reported and `out` holds the loud substitute. */
  int32_t (*texture)(void* host, const TmGrid*, const char* name, int32_t channel, int32_t channels, const float* s,
                     const float* t, TmVec3 out);

  /* RISpec calculatenormal(): normal of the batch's surface if its points were at P. Elsewhere than in displacements it
   * takes TM_NEIGHBOURS, or copies N. */
  void (*calculateNormal)(void* host, const TmGrid*, TmConstVec3 P, TmVec3 out);

  /* Fraction of light that travels from P along `toward` to its tip (1: clear). Rays use the hit-list origin offset. */
  void (*transmission)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 toward, TmVec3 out);

  /* Indirect light at P on the side of N: E/pi, unclamped, and one unit dominant direction for each of red, green and
   * blue (approximate-gi eq. 7). `dominant` may be NULL; else three vectors. The parameters are those of the calling
   * indirectlight; elsewhere the scene's. */
  void (*indirectDiffuse)(void* host, const TmGrid*, TmConstVec3 N, TmVec3 out, TmVec3* dominant);

  /* Tells the user once per shader and object; severity 1 warning, 2 missing (a substitute is rendered). */
  void (*report)(void* host, const TmGrid*, int32_t severity, const char* message);

  /* Radiance of the latitude-longitude picture `name` towards `direction` (current space, any length), three channels.
   * The picture stands in world space: +z at its top, +x at its left edge, +y a quarter to the right (RISpec 3.2,
   * MakeLatLongEnvironment). width: angle to filter over, radians; NULL: a point. Returns as texture(). */
  int32_t (*environment)(void* host, const TmGrid*, const char* name, TmConstVec3 direction, const float* width,
                         TmVec3 out);

  /* diffuse() of some lights: which is TM_DIRECT_LIGHT, TM_INDIRECT_LIGHT or their sum. */
  void (*diffuseOf)(void* host, const TmGrid*, int32_t which, TmConstVec3 N, TmVec3 out);

  /* RISpec shadow(): the share of light that what is in shadow map `name` blocks at P, 1: all; colours from deep maps.
   * 0 outside the map, for "raytrace", and where the map cannot be read (the renderer traces those shadows itself). */
  void (*shadow)(void* host, const TmGrid*, const char* name, TmConstVec3 P, const TmShadowLookup*, TmVec3 out);

  /* Ray tracing. Shaders that call these have TM_TRACES. `options` may be NULL. Narrow cones (up to 10 degrees) shoot
   * specular rays, wide ones diffuse rays: Attribute "visibility" and the depth limits of "trace" tell them apart. */

  /* Mean colour that the rays bring, through what is transparent, and the least distance to what they meet (1e30:
   * nothing). Either may be NULL (x NULL). */
  void (*trace)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 direction, const TmRayOptions* options,
                TmVec3 color, float* distance);
  /* Ray number `ray` of options->samples of each active point, around `axis`: hit[i] says whether it met anything, and
   * outputs are set where it did ("ray:" values everywhere). Returns 0 when there are no more. With
   * options->environment none is traced: all miss, and leave in all directions, half of them by the brightness of that
   * picture. */
  int32_t (*gather)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 axis, const TmRayOptions* options,
                    int32_t ray, uint8_t* hit, const TmRayOutput* outputs, int32_t outputCount);
  /* Share of the cone around N that is covered, and (unless x is NULL) the mean radiance that arrives from it.
   * coneAngle 0: the whole hemisphere. */
  void (*occlusion)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 N, const TmRayOptions* options,
                    float* covered, TmVec3 radiance);
  /* transmission() with options; several samples spread over a cone. */
  void (*transmissionWith)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 toward, const TmRayOptions* options,
                           TmVec3 out);
  /* Of the ray that came to these points: "type" (0 camera, 1 diffuse, 2 specular, 3 transmission), "depth",
   * "diffusedepth", "speculardepth", "shadowdepth", "importance", "highlights" (0: gathered light is wanted, without
   * them) into x; "origin", "direction" into all, "length" into x. Returns 0: no such name. */
  int32_t (*rayInfo)(void* host, const TmGrid*, const char* name, TmVec3 out);
  /* Its label. */
  const char* (*rayLabel)(void* host, const TmGrid*);

  /* Multiple importance sampling of a surface's own lobe f (the cosine included, over pi less), as specular() does it.
   * With m = lobeSamples() and p(L) the density over solid angle with which the surface draws L, the highlight is the
   * sum of f(L) Cl / (1 + (m p(L) / d)^2)    over light(): d of lightDensity(), or wholly where that is 0 f(L) Cl over
   * m directions of its own: Cl of lightAlong() lightDensity: 0 where lightAlong() would not find the light.
   * lightAlong: L unit length, sample number 0..m-1, density p(L), 0 for none. stratified: numbers in [0,1) for sample
   * number `sample`. */
  void (*lightDensity)(void* host, const TmGrid*, int32_t index, float* out);
  void (*lightAlong)(void* host, const TmGrid*, TmConstVec3 L, const float* density, int32_t sample, int32_t samples,
                     TmVec3 Cl);
  int32_t (*lobeSamples)(void* host, const TmGrid*);
  void (*stratified)(void* host, const TmGrid*, int32_t sample, int32_t samples, float* xi0, float* xi1);

  /* Derivative by u (direction 0) or v (1) of a value at every point: centred differences, one-sided at the border of a
   * grid. Knows u, v, s, t, P, N and primitive variables with TM_DERIVATIVES, all values with TM_NEIGHBOURS and in
   * displacements. */
  void (*derivative)(void* host, const TmGrid*, int32_t direction, const float* value, float* out);
  /* texture() with options: over the parallelogram that the micropolygon covers in (s, t). `lookup` may be NULL. */
  int32_t (*textureWith)(void* host, const TmGrid*, const char* name, const TmTextureLookup* lookup, const float* s,
                         const float* t, TmVec3 out);
  /* environment() with options, over the cone that the micropolygon sees in `direction`; "raytrace" traces rays. */
  int32_t (*environmentWith)(void* host, const TmGrid*, const char* name, const TmTextureLookup* lookup,
                             TmConstVec3 direction, TmVec3 out);
  /* RISpec illuminance(). Ambient lights are not listed. The arrays live until the shader returns; those of a P that is
   * not that of the batch, of messages and of refreshed lights until it has asked for four more such. Call with the
   * same mask until 0 is returned. */
  int32_t (*illuminance)(void* host, const TmGrid*, TmIlluminance*);
  /* A value of something else: `type` is the TmType, `out` as a parameter of this shader (it lives until the shader
   * returns, or as long as what illuminance() has listed the light with). Returns 0 if there is no such value. `light`
   * counts for TM_OF_LIGHT alone; negative: the light that is running. */
  int32_t (*ask)(void* host, const TmGrid*, int32_t whom, int32_t light, const char* name, int32_t* type, TmValue* out);
  /* RISpec textureinfo(): "exists", "resolution", "type", "channels", "bitsperchannel", "viewingmatrix",
   * "projectionmatrix". */
  int32_t (*textureInfo)(void* host, const TmGrid*, const char* name, const char* what, int32_t* type, TmValue* out);

  /* textureWith() over a parallelogram of the caller's own: sides[0], sides[1] are s and t along one side, sides[2],
   * sides[3] along the other, for each point. */
  int32_t (*textureOver)(void* host, const TmGrid*, const char* name, const TmTextureLookup* lookup, const float* s,
                         const float* t, const float* const* sides, TmVec3 out);
  /* RISpec's bake3d: where the camera sees a point, it goes to the point cloud `file` (.ptc) with its values, to be
   * written when the frame ends. N of zero length: a sphere. Returns 0 if it cannot be, which has been reported. */
  int32_t (*bake3d)(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N,
                    const TmCloudLookup* lookup, const TmCloudValue* values, int32_t valueCount);
  /* Values around P in a point cloud (.ptc, held whole) or brick map (.bkm), on surfaces that face as N does (zero
   * length: all). found[i] is 1 where there are any; elsewhere values are left alone. Returns 0 if the file or a
   * channel is missing, which has been reported. */
  int32_t (*texture3d)(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N,
                       const TmCloudLookup* lookup, const TmCloudValue* values, int32_t valueCount, float* found);
  /* E/pi at P on the side of N from a photon map, by the `estimator` nearest photons. Returns as texture3d(). */
  int32_t (*photonMap)(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N, int32_t estimator,
                       TmVec3 out);
  /* RISpec printf(): a line on standard error, whole whatever other threads say. */
  void (*print)(void* host, const TmGrid*, const char* text);
  /* Light that has entered where a point cloud was baked and leaves at P, by the diffusion approximation: E/pi as what
   * was baked. The cloud holds "_area" and "_radiance_t", what diffuse() gives to a surface that lets it all in.
   * Returns as texture3d(). */
  int32_t (*subsurface)(void* host, const TmGrid*, const char* file, TmConstVec3 P, const TmSubsurface*, TmVec3 out);
  /* occlusion(), with all that it finds. Returns 0 if a point cloud is missing, which has been reported. */
  int32_t (*hemisphere)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 N, const TmRayOptions* options,
                        const TmHemisphere* out);
  /* photonMap() with options, which may be NULL. */
  int32_t (*photonMapWith)(void* host, const TmGrid*, const char* file, TmConstVec3 P, TmConstVec3 N,
                           const TmPhotonLookup*, TmVec3 out);
} TmServices;

#ifdef __cplusplus
}
#endif
