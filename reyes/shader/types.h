/* A batch of points as a shader gets it: arrays, declared parameters and their values. Part of reyes/shader_api.h;
 * plain C. */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TM_SHADER_ABI 1u
#define TM_LANES 16

typedef struct TmVec3 {
  float *x, *y, *z;
} TmVec3; /* structure of arrays, writable */
typedef struct TmConstVec3 {
  const float *x, *y, *z;
} TmConstVec3; /* the same, read only */

typedef enum TmKind { TM_SURFACE = 0, TM_DISPLACEMENT = 1, TM_LIGHT = 2, TM_VOLUME = 3, TM_IMAGER = 4 } TmKind;
typedef enum TmType { TM_FLOAT = 0, TM_COLOR, TM_POINT, TM_VECTOR, TM_NORMAL, TM_STRING, TM_MATRIX } TmType;

/* Added to the type of a TmParamDecl: an output parameter, of float, color, point, vector or normal. If a Display wants
 * the variable of this name, TmValue::step is 1 and c[k] may be written for active points (cast const away; a colour is
 * premultiplied by opacity, like Ci); otherwise step is 0 and nothing may be written. */
#define TM_OUTPUT 0x100
/* Added in the same way: primitive variables of the same name do not override the parameter (which is reported), so
 * TmValue::step is 0. It is for values that a whole batch must share: numbers of rays, names of sets. */
#define TM_UNIFORM 0x200
#define TM_TYPE_OF(declared) ((declared)&0xff) /* the TmType alone */

/* What a shader declares about itself, so that the core shades no more than needed. `tomales shadetest --check`
 * compares this, as far as it can, with what the shader does. */
typedef enum TmCapability {
  /* --- Surfaces */
  TM_KEEPS_OPACITY = 1 << 0, /* Oi = Os always, so an object with Os = 1 hides what is behind it */
  TM_EMITS = 1 << 1,         /* adds emitted radiance of its own, beside light that it reflects */
  TM_EVEN = 1 << 2,        /* under light that is the same from everywhere it looks the same wherever and from whichever
                              side it is seen: its colour comes of Cs, Os and its parameters, not of places, coordinates or
                              pictures. Photons ask it once, instead of at every hit */
  TM_DERIVATIVES = 1 << 3, /* looks pictures up at s, t or at primitive variables, or asks for derivatives of those: the
                              host keeps how they change over a micropolygon */
  TM_NEIGHBOURS = 1 << 4, /* asks for derivatives of what it has computed, or looks pictures up at such places: the host
                             shades four points around each point as well, so that differences are centred. The batch
                             holds them after the points themselves; light and rays are asked for the points alone */

  /* --- Rays */
  TM_TRACES = 1 << 5,            /* surface, light, volume: calls trace(), gather(), occlusion() or transmission() */
  TM_TRACES_HIGHLIGHTS = 1 << 6, /* surface, with TM_TRACES: asks for rays only where highlights are wanted, so that
                                    without them it looks the same from every side */
  TM_OCCLUDED = 1 << 7, /* surface, light, with TM_TRACES: answers of occlusion() may be interpolated between records
                           that are made before anything is shaded (TmOcclusion::maxVariation) */

  /* --- Lights */
  TM_LIGHT_AMBIENT = 1 << 8, /* no direction; seen by ambient() alone */
  TM_LIGHT_SOLAR = 1 << 9,   /* L is a direction, the source is at infinity */
  TM_LIGHT_AREA = 1 << 10,   /* the host samples the geometry of an AreaLightSource and sets Pl, Nl, L */
  TM_LIGHT_SKY = 1 << 11, /* with TM_LIGHT_SOLAR: all around, at infinity. The host chooses L, by the brightness of the
                             latitude-longitude picture that its TM_ROLE_SKY_MAP names and by the cosine,
                             TM_ROLE_SAMPLES times; Cl is the radiance from there */
  TM_LIGHT_INDIRECT = 1 << 12, /* brings indirect light; never run at the hits of gather rays */
  TM_LIGHT_SAMPLED = 1 << 13,  /* asked for as many samples as its TM_ROLE_SAMPLES says, with xi0 and xi1; Cl is the
                                  share of one sample */
  TM_LIGHT_SHADOWED = 1 << 14, /* the host traces a shadow ray along L for every sample */
  /* What it sends is about its TM_ROLE_SCALE times its TM_ROLE_TINT, or less: over the squared distance from its
   * TM_ROLE_POSITION, or, with TM_LIGHT_AREA, as radiance (which TM_ROLE_AREA may turn into that). Its numbers may vary
   * over a batch, as those of many lights, and it asks for no space of its own. Where there are many such lights a
   * point runs only some of them */
  TM_LIGHT_BOUNDED = 1 << 15,

  /* --- Rays whose answers come from records */
  TM_INTERPOLATED = 1 << 16, /* surface, light, with TM_TRACES: answers of occlusion() and indirectdiffuse() may be
                                interpolated as with TM_OCCLUDED where Attribute "irradiance" "maxerror" is above 0,
                                whatever else it asks of rays */
  TM_INTERPOLATED_UNASKED = 1 << 17 /* with TM_INTERPOLATED: they may be interpolated without that attribute, too, since
                                       the shader asks for radiance, or names a TmOcclusion::maxVariation */
} TmCapability;

/* The meaning of a parameter to the host, whatever its name is: which one is the number of samples, and so on. The host
 * ignores the value of a parameter without a role. Each role has one type and one kind of shader
 * (reyes/shade/roles.cpp); docs/shader_writing.md explains them. */
typedef enum TmRole {
  TM_ROLE_NONE = 0,
  /* float. TM_LIGHT_AREA, TM_LIGHT_SKY, TM_LIGHT_SAMPLED: samples for each shaded point. TM_LIGHT_INDIRECT: rays of
   * each irradiance record. */
  TM_ROLE_SAMPLES = 1,
  TM_ROLE_VISIBLE = 2,          /* float. TM_LIGHT_AREA, TM_LIGHT_SKY: 0 hides it from the camera and specular rays */
  TM_ROLE_SKY_MAP = 3,          /* string. TM_LIGHT_SKY: latitude-longitude picture of its brightness */
  TM_ROLE_SKY_SPACE = 4,        /* string. The space of that picture: world or shader */
  TM_ROLE_SKY_PORTALS = 5,      /* string. TM_LIGHT_SKY: coordinate systems whose unit squares are windows */
  TM_ROLE_MAX_ERROR = 6,        /* float. TM_LIGHT_INDIRECT: error that interpolation of records may make */
  TM_ROLE_ERROR_FUNCTION = 7,   /* string. TM_LIGHT_INDIRECT: how far a record may be used */
  TM_ROLE_HIT_RADIANCE = 8,     /* string. TM_LIGHT_INDIRECT: what gather rays see: shader, radiosity, atlas, points */
  TM_ROLE_ATLAS = 9,            /* string. TM_LIGHT_INDIRECT: folder of the maps that gather rays look up */
  TM_ROLE_BOUNCES = 10,         /* float. TM_LIGHT_INDIRECT: diffuse bounces */
  TM_ROLE_MAX_DISTANCE = 11,    /* float. TM_LIGHT_INDIRECT: length of gather rays */
  TM_ROLE_SUBSET = 12,          /* string. TM_LIGHT_INDIRECT: sets of objects that gather rays see */
  TM_ROLE_INDIRECT_SOURCE = 13, /* string. TM_LIGHT_INDIRECT: handle of the indirect light that this one filters */
  TM_ROLE_SCALE = 14,           /* float. Any light: multiplies all that it sends or brings, and does nothing else */
  TM_ROLE_TINT = 15,            /* color. Likewise */
  TM_ROLE_MAX_VARIATION = 16,   /* float. Light with TM_OCCLUDED: the TmOcclusion::maxVariation that it asks for */
  TM_ROLE_LIGHTING = 17,        /* string. Any light: direct, indirect or both */
  TM_ROLE_NONDIFFUSE = 18,      /* float, or output float. Any light: 1 where diffuse() leaves it out */
  TM_ROLE_NONSPECULAR = 19,     /* float, or output float. Any light: 1 where specular() leaves it out */
  TM_ROLE_GROUP = 20,           /* string. Any light: name of the light's group */
  TM_ROLE_CATEGORY = 21,        /* string. Any light: names by commas, for illuminance() */
  TM_ROLE_SHADOW_MAP = 22,      /* string, one or several. Any light: a shadow map that the shader reads */
  TM_ROLE_SHADOW_VARIANCE = 23, /* float. Any light: what its shadow rays may leave open */
  TM_ROLE_SCATTERING = 24,      /* color. Volume: for each unit of length of the world, as photons meet it */
  TM_ROLE_ABSORPTION = 25,      /* color. Likewise */
  TM_ROLE_AREA = 26,            /* float. TM_LIGHT_AREA: the area of its geometry, which the host gives where the scene
                                   does not and asks for light as BMRT has it; 0: it is not known */
  TM_ROLE_POSITION = 27         /* point. TM_LIGHT_BOUNDED: where it stands */
} TmRole;

/* One declared parameter. Points, vectors, normals and matrices are given in shader space and arrive in current. */
typedef struct TmParamDecl {
  const char* name;
  int32_t type;               /* TmType, and TM_OUTPUT or TM_UNIFORM */
  int32_t arrayLength;        /* 1 for a single value */
  const float* floats;        /* the default, arrayLength values; NULL is all zero */
  const char* const* strings; /* the default of a string parameter, arrayLength of them */
  const char* doc;            /* one line for `tomales info` */
  int32_t role;               /* TmRole */
} TmParamDecl;

/* One bound parameter: component k of point i is c[k][i * step]. step 0: uniform; 1: varying (a primitive
 * variable of the same name overrides the parameter); messages may have other steps. Element e of component k of an
 * array is c[k][e * components + i * step]; arrays of parameters are uniform. Matrices are 16 floats of c[0] in
 * RenderMan's order (points are rows, the translation comes last).
 */
typedef struct TmValue {
  const float* c[3];
  int32_t step;
  int32_t length;     /* array length */
  const char* string; /* never NULL for a string parameter; the elements of an array follow each other, each ended by 0
                       */
} TmValue;

struct TmServices;
struct TmShader;

typedef struct TmGrid {
  uint32_t structBytes;
  int32_t count, padded; /* live points; length of every array, a multiple of TM_LANES */
  float time, dtime;     /* when the shutter opens, and how long it is open */
  float clip[2];         /* camera-space depths of the near and far clipping planes */
  float E[3];            /* the eye, current space */
  const uint8_t* active; /* 1: this point wants a result */
  const TmValue* params; /* in the order of TmShader::params. One more follows, which no parameter has: a shader that
                            reads a parameter that it did not list crashes there under `tomales shadetest --check` */
  const struct TmServices* call;
  void* host; /* pass it to every service */

  TmVec3 P, N;       /* position and shading normal (not normalised); a displacement may write both */
  TmConstVec3 Ng, I; /* geometric normal; incident direction, from the eye or ray origin to P */
  TmConstVec3 dPdu, dPdv;
  TmConstVec3 dPdtime; /* surface: where P goes per unit of time; 0 where nothing moves */
  const float *u, *v, *s, *t, *du, *dv;
  TmConstVec3 Cs, Os;
  TmVec3 Ci, Oi; /* surface, volume, imager: the result, premultiplied by opacity */
  float* alpha;  /* imager alone: alpha of the pixel, in and out */

  /* Light shaders alone. P and N above are the point being lit (RSL's Ps) and its normal. */
  TmVec3 L;                /* out (area: in): from P towards the light; its length is the distance for shadows */
  TmVec3 Cl;               /* out: light colour arriving at P, whole light (host divides area samples) */
  TmConstVec3 Pl, Nl;      /* area: sampled point on the emitter and its RISpec normal, unit length */
  const float *xi0, *xi1;  /* TM_LIGHT_SAMPLED: a point of [0,1)^2; those of all samples of a point are stratified */
  int32_t sample, samples; /* which of how many samples of this light */
  const struct TmShader* shader; /* that runs: how one function may serve many shaders */
} TmGrid;

#ifdef __cplusplus
}
#endif
