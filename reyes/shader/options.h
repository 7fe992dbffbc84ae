/* The options of each service, and the structs of answers. Part of reyes/shader_api.h; plain C.
 *
 * Make a struct that begins with structBytes by the function below it, which sets the defaults, and then set what
 * differs:  TmRayOptions rays = tmRayDefaults();  rays.samples = 16;
 * Where a service takes such a struct, NULL stands for the defaults. A struct whose structBytes is 0 was not made by
 * that function; this is reported, and the defaults are used instead. */
#pragma once
#include <string.h>

#include "reyes/shader/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A named array of the batch: for each point a number (y and z are NULL) or a triple. */
typedef struct TmChannel {
  const char* name;
  TmVec3 value;
} TmChannel;

/* The lights that diffuse() counts. */
typedef enum TmLightChoice { TM_ALL_LIGHT = 0, TM_DIRECT_LIGHT = 1, TM_INDIRECT_LIGHT = 2 } TmLightChoice;

typedef enum TmTransformKind { TM_AS_POINT = 0, TM_AS_VECTOR = 1, TM_AS_NORMAL = 2 } TmTransformKind;

/* The severity of report(). With TM_MISSING a substitute is rendered, which shows in the exit code. */
typedef enum TmSeverity { TM_WARNING = 1, TM_MISSING = 2 } TmSeverity;

typedef enum TmHitSides { TM_HIT_BOTH = 0, TM_HIT_FRONT = 1, TM_HIT_BACK = 2 } TmHitSides;
/* TM_HIT_DEFAULT leaves the choice to the attributes of the object that the ray meets. */
typedef enum TmHitMode { TM_HIT_DEFAULT = 0, TM_HIT_PRIMITIVE = 1, TM_HIT_SHADER = 2 } TmHitMode;

/* The object that ask() gets a value of. Parameters and outputs are found by name; "__shadername" is a shader's own
 * name. */
typedef enum TmWhom {
  TM_OF_SURFACE = 0,
  TM_OF_DISPLACEMENT = 1,
  TM_OF_ATMOSPHERE = 2,
  TM_OF_INCIDENT = 3,   /* the volume shader on the side of the surface that I arrives at (Exterior, Interior) */
  TM_OF_OPPOSITE = 4,   /* the volume shader on the other side */
  TM_OF_LIGHT = 5,      /* a light: TmIlluminance::light */
  TM_OF_ATTRIBUTES = 6, /* "Ri:ShadingRate", "user:name", "category:name" (RISpec 15.8, attribute()) */
  TM_OF_OPTIONS = 7,    /* "Format", "Shutter", "Clipping", "Frame", "user:name", "category:name" */
  TM_OF_RENDERER = 8    /* "renderer", "version" (four numbers), "versionstring" */
} TmWhom;

/* How rays are shot. Directions are stratified over the rays of a point and reproducible. */
typedef struct TmRayOptions {
  uint32_t structBytes;
  int32_t samples;           /* rays a point; default 1 */
  float coneAngle;           /* half angle around the axis, radians, up to pi/2; 0: all along it */
  int32_t uniform;           /* 1: evenly over the cone's solid angle; 0: by the cosine with its axis */
  float bias;                /* hits nearer do not count; default: < 0, as the object's attributes say */
  float maxDistance;         /* default 1e30 */
  float sampleBase;          /* share of its micropolygon, 0..1, that the rays of a point start from */
  float opacityThreshold;    /* rays go on behind what is transparent until this much is covered; default 1 */
  int32_t hitSides, hitMode; /* TmHitSides, TmHitMode */
  /* For trace() along directions that the caller draws itself, one a call: how many it draws, and which this one is. */
  int32_t drawn, number;
  int32_t passLamps; /* 1: area lights do not glow for these rays, since lightAlong() or specular() has brought them */
  float importance;  /* of what the rays bring; default 1. rayInfo("importance") where they arrive is the product of all
                        on the way */
  const char* label; /* seen by rayLabel() at what they meet; NULL: "" */
  const char *subset, *excludeSubset; /* sets of Attribute "grouping" "membership", separated by commas or spaces; NULL:
                                         all, none */
  /* occlusion(): the latitude-longitude picture that rays see which meet nothing (NULL: black). gather(): the picture
   * that directions are drawn from (NULL: none). */
  const char* environment;
  const char* environmentSpace; /* the space whose +z is the top of that picture; NULL: "world" */
} TmRayOptions;

static inline TmRayOptions tmRayDefaults(void) {
  TmRayOptions o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  o.samples = 1;
  o.bias = -1;
  o.maxDistance = 1e30f;
  o.opacityThreshold = 1;
  o.importance = 1;
  return o;
}

/* What occlusion() counts as covered, and which answers it gives. */
typedef struct TmOcclusion {
  uint32_t structBytes;
  float falloff;       /* what is met at distance d counts exp(-falloff d), or in mode 1 */
  int32_t falloffMode; /* (1 - d / maxDistance)^falloff; falloff 0: wholly */
  /* The error that interpolation between records (docs/gi.md) may make in an answer for a whole hemisphere, weighted by
   * the cosine. 0: it is traced at every point; < 0: Attribute "irradiance" "maxerror", if given. */
  float maxVariation;
  float maxSolidAngle;      /* disks that together are seen under less count as one; default 0.01 */
  int32_t clamp;            /* default 1: disks behind others do not count; 0: all do */
  const char* pointCloud;   /* the disks of this file (.ptc, world space) are in the way, not geometry; NULL: rays */
  const char* pointChannel; /* the channel of the light that the disks send; NULL: "_radiosity" */
  /* The answers, where the arrays are not NULL. */
  float* covered;              /* share of the hemisphere, with falloff */
  TmVec3 radiance;             /* mean of what arrives from there, the environment included */
  TmVec3 environmentColor;     /* the mean of the environment's part alone */
  TmVec3 environmentDirection; /* mean direction of the rays that meet nothing, unit length, or 0 */
} TmOcclusion;

static inline TmOcclusion tmOcclusionDefaults(void) {
  TmOcclusion o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  o.maxSolidAngle = 0.01f;
  o.clamp = 1;
  return o;
}

/* How texture() and environment() look up (RISpec 15.7). */
typedef struct TmTextureOptions {
  uint32_t structBytes;
  int32_t channel;      /* the first of the one or three channels that are read */
  float fill;           /* the value of channels that the picture lacks */
  float swidth, twidth; /* scale of the region; default 1; 0: a point */
  float sblur, tblur;   /* added to the region, as a fraction of the picture */
  int32_t samples;      /* environment() of "raytrace": rays; default 1 */
  float mipBias;        /* how many levels finer than the region asks for are read; negative: coarser */
  float ignoreAbove;    /* values greater than this are left out of what is averaged, texel by texel; default 1e30 */
  const char* filter;   /* NULL: "box" */
  /* texture(): a parallelogram that the caller gives for each point: s and t along one side, s and t along the other.
   * region[0] NULL: the parallelogram that the micropolygon covers in (s, t). */
  const float* region[4];
  const float* angle; /* environment(): angle to filter over, radians, for each point; NULL: that of the micropolygon */
} TmTextureOptions;

static inline TmTextureOptions tmTextureDefaults(void) {
  TmTextureOptions o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  o.swidth = 1;
  o.twidth = 1;
  o.samples = 1;
  o.ignoreAbove = 1e30f;
  return o;
}

/* How a shadow map is looked up. */
typedef struct TmShadowOptions {
  uint32_t structBytes;
  float bias;      /* depth that an occluder must be nearer to the light by; default: < 0, the scene's, or as needed */
  float blur;      /* added region, as a fraction of the map */
  float width;     /* scale of the micropolygon's own region; default 1 */
  int32_t samples; /* default 16 */
} TmShadowOptions;

static inline TmShadowOptions tmShadowDefaults(void) {
  TmShadowOptions o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  o.bias = -1;
  o.width = 1;
  o.samples = 16;
  return o;
}

/* RSL's "send:light:NAME": lights that have a parameter of this name use this value for it. The value is a number, a
 * triple or a string, laid out like a parameter of the sender. */
typedef struct TmMessage {
  const char* name;
  TmValue value;
  int32_t type; /* TmType */
} TmMessage;

/* Iterates over the samples of lights: call illuminance() with the same struct until it returns 0. */
typedef struct TmIlluminance {
  uint32_t structBytes;
  int32_t next;         /* kept by the host; 0 at first */
  const char* category; /* "", NULL: all lights; "a,b": one of these; "-a": without; "a&-b" (parameter __category) */
  TmConstVec3 axis;     /* x NULL: from all around; else from the cone around it */
  const float* angles;  /* half angle of that cone, radians, for each point; NULL: `angle` */
  float angle;          /* the same for all points */
  int32_t refresh;      /* 1: lights run again ("lightcache" "refresh") even if they have for the same P, category and
                           messages */
  /* Where the light arrives; x NULL: at the shaded points. A volume gives it to ask for light in the air. No indirect
   * light arrives there, light shaders see an N of 0, and rays start at once. A surface must not give it. */
  TmConstVec3 P;
  const TmMessage* sent; /* for the lights that run */
  int32_t sentCount;
  /* The answer. */
  int32_t light;         /* its number, for ask() and lightDensity() */
  TmConstVec3 L;         /* from P to the light, of full length; the arrays of `direction` if it is at infinity */
  TmConstVec3 direction; /* L with unit length */
  TmConstVec3 Cl;        /* shadowed, divided by the number of samples */
  const uint8_t* lit;    /* 1: active, and the sample comes from the cone */
  int32_t isIndirect, nondiffuse, nonspecular;
  /* The question again. Area lights take so many times the samples that they have by themselves, if nothing has asked
   * for light at these points before; 0: once. A surface that shows nothing but highlights needs more of them. It must
   * be the same for all points of an object, or pictures depend on buckets. */
  int64_t times;
} TmIlluminance;

static inline TmIlluminance tmIlluminanceDefaults(void) {
  TmIlluminance o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  return o;
}

/* Spaces and radii of bake3d() and texture3d(). */
typedef struct TmCloudOptions {
  uint32_t structBytes;
  float radiusScale;       /* default 1 */
  const float* radius;     /* the radius of the disk that is baked or of the region that is averaged, in current space;
                              NULL: the micropolygon's */
  const char* coordSystem; /* the space of the file; NULL: "world" */
} TmCloudOptions;

static inline TmCloudOptions tmCloudDefaults(void) {
  TmCloudOptions o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  o.radiusScale = 1;
  return o;
}

/* How photonMap() looks photons up. */
typedef struct TmPhotonOptions {
  uint32_t structBytes;
  int32_t estimator; /* how many of the nearest photons count; default 50 */
  float maxDistance; /* how far photons count, in units of the file's space; 0: a twentieth of the map's diagonal */
} TmPhotonOptions;

static inline TmPhotonOptions tmPhotonDefaults(void) {
  TmPhotonOptions o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  o.estimator = 50;
  return o;
}

/* The material that light diffuses through in subsurface(). The default is marble. */
typedef struct TmSubsurfaceOptions {
  uint32_t structBytes;
  float ior;                          /* default 1.3 */
  float unitLength;                   /* millimetres in one unit of the file's space; default 1 */
  float maxSolidAngle;                /* points that are seen together under less count as one; 0: each counts for
                                         itself; default 0.1 */
  float scattering[3], absorption[3]; /* reduced scattering and absorption, 1/mm */
  /* Unless meanFreePath[0] is 0, these count instead: diffuse albedo, and diffuse mean free path in mm. */
  float albedo[3], meanFreePath[3];
  const char* coordSystem; /* the space of the file; NULL: "world" */
  /* "apple", "chicken1", "chicken2", "cream", "ketchup", "marble", "potato", "skimmilk", "skin1", "skin2",
   * "spectralon", "wholemilk" (Jensen et al. 2001, figure 5); NULL: as the numbers above say. */
  const char* material;
} TmSubsurfaceOptions;

static inline TmSubsurfaceOptions tmSubsurfaceDefaults(void) {
  TmSubsurfaceOptions o;
  memset(&o, 0, sizeof o);
  o.structBytes = sizeof o;
  o.ior = 1.3f;
  o.unitLength = 1;
  o.maxSolidAngle = 0.1f;
  o.material = "marble";
  return o;
}

#ifdef __cplusplus
}
#endif
