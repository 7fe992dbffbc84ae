/* The binary contract between the renderer and a shader, built-in or plugin. Plain C, so that it survives
 * compilers and releases; reyes/shader.h is its C++ face and what most shader writers include.
 *
 * A shader is one callback for a batch of points. All arrays are structures of arrays, start on a 64-byte
 * boundary and are padded to TM_LANES floats, so a loop may run over `padded` points without a tail; points
 * whose `active` byte is 0 must keep their values, and services leave them alone.
 *
 * Space: "current" is camera space at shutter open (left-handed, +z into the scene). Colours are linear.
 * Irradiance: diffuse(), ambient() and indirect light are E/pi, the RSL convention: Ci = Cs * diffuse(N).
 * Threads: one shader runs on many threads at once, on different batches. It must keep no state.
 * Growth: fields and functions are only ever appended; check structBytes before using a later one. */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TM_SHADER_ABI 1u
#define TM_LANES 16

typedef struct TmVec3 { float *x, *y, *z; } TmVec3;                  /* structure of arrays, writable */
typedef struct TmConstVec3 { const float *x, *y, *z; } TmConstVec3;  /* the same, read only */

typedef enum TmKind { TM_SURFACE = 0, TM_DISPLACEMENT = 1, TM_LIGHT = 2, TM_VOLUME = 3, TM_IMAGER = 4 } TmKind;
typedef enum TmType { TM_FLOAT = 0, TM_COLOR, TM_POINT, TM_VECTOR, TM_NORMAL, TM_STRING, TM_MATRIX } TmType;

/* Added to the type of a TmParamDecl: an output parameter, of float, color, point, vector or normal. Where a Display wants
 * the variable of this name, TmValue::step is 1 and c[k] may be written for active points (cast const away; a colour
 * premultiplied by opacity, as Ci is); elsewhere step is 0 and nothing may be written. */
#define TM_OUTPUT 0x100

/* What a shader declares about itself, so that the core shades no more than needed. */
typedef enum TmCapability {
  TM_KEEPS_OPACITY = 1 << 0,  /* surface: Oi = Os always, so an object with Os = 1 hides what is behind it */
  TM_LIGHT_AMBIENT = 1 << 1,  /* light: no direction; seen by ambient() alone */
  TM_LIGHT_SOLAR = 1 << 2,    /* light: L is a direction, the source is at infinity */
  TM_LIGHT_AREA = 1 << 3,     /* light: the host samples the geometry of an AreaLightSource and sets Pl, Nl, L */
  TM_LIGHT_INDIRECT = 1 << 4, /* light: brings indirect light; never run at the hits of gather rays */
  TM_LIGHT_SHADOWED = 1 << 5, /* light: the host traces a shadow ray along L for every sample */
  TM_EMITS = 1 << 6,          /* surface: adds emitted radiance of its own, beside light that it reflects */
  TM_LIGHT_SAMPLED = 1 << 7,  /* light: asked for as many samples as its parameter `samples` says, with xi0 and xi1;
                                 Cl is the share of one sample */
  TM_TRACES = 1 << 8,        /* surface, light, volume: calls trace(), gather(), occlusion() or transmission() */
  TM_LIGHT_SKY = 1 << 9,     /* light, with TM_LIGHT_SOLAR: all around, at infinity. The host chooses L, by the brightness of the
                                latitude-longitude picture that its parameter `map` names and by the cosine, parameter
                                `samples` times; Cl is the radiance from there */
  TM_DERIVATIVES = 1 << 10,   /* surface: looks pictures up at s, t or at primitive variables, or asks for derivatives of those:
                                the host keeps how they change over a micropolygon */
  TM_NEIGHBOURS = 1 << 11    /* surface: asks for derivatives of what it has computed, or looks pictures up at such places: the
                                host shades four points around each point as well, so that differences are centred. The batch
                                holds them after the points themselves; light and rays are asked for the points alone */
} TmCapability;

/* One declared parameter. Points, vectors, normals and matrices are given in shader space and arrive in current. */
typedef struct TmParamDecl {
  const char* name;
  int32_t type;                /* TmType, and TM_OUTPUT */
  int32_t arrayLength;         /* 1 for a single value */
  const float* floats;         /* the default, arrayLength values; NULL is all zero */
  const char* const* strings;  /* the default of a string parameter */
  const char* doc;             /* one line for `tomales info` */
} TmParamDecl;

/* One bound parameter: component k of point i is c[k][i * step]. step 0: uniform; 1: varying (a primitive
 * variable of the same name overrides the parameter). Arrays are uniform: element e of component k is c[k][e * components], and
 * matrices are 16 floats of c[0] in RenderMan's order (points are rows, the translation comes last). */
typedef struct TmValue {
  const float* c[3];
  int32_t step;
  int32_t length;              /* array length */
  const char* string;          /* never NULL for a string parameter */
} TmValue;

struct TmServices;

typedef struct TmGrid {
  uint32_t structBytes;
  int32_t count, padded;       /* live points; length of every array, a multiple of TM_LANES */
  const uint8_t* active;       /* 1: this point wants a result */
  const TmValue* params;       /* in the order of TmShader::params */
  const struct TmServices* call;
  void* host;                  /* pass it to every service */

  TmVec3 P, N;                 /* position and shading normal (not normalised); a displacement may write both */
  TmConstVec3 Ng, I;           /* geometric normal; incident direction, from the eye or ray origin to P */
  TmConstVec3 dPdu, dPdv;
  const float *u, *v, *s, *t, *du, *dv;
  TmConstVec3 Cs, Os;
  TmVec3 Ci, Oi;               /* surface, volume, imager: the result, premultiplied by opacity */
  float E[3];                  /* the eye, current space */
  float time;

  /* Light shaders alone. P and N above are the point being lit (RSL's Ps) and its normal. */
  int32_t sample, samples;     /* which of how many samples of this light */
  TmVec3 L;                    /* out (area: in): from P towards the light; its length is the distance for shadows */
  TmVec3 Cl;                   /* out: light colour arriving at P, whole light (host divides area samples) */
  TmConstVec3 Pl, Nl;          /* area: sampled point on the emitter and its RISpec normal, unit length */

  /* Imager shaders alone: alpha of the pixel, in and out. */
  float* alpha;

  /* Lights with TM_LIGHT_SAMPLED alone: a point of [0,1)^2; those of all samples of a point are stratified. */
  const float *xi0, *xi1;
  float clip[2];               /* camera-space depths of the near and far clipping planes */

  float dtime;                 /* how long the shutter is open */
  TmConstVec3 dPdtime;         /* surface: where P goes per unit of time; 0 where nothing moves */
} TmGrid;

/* One sample of one light at every point of the batch. */
typedef struct TmLightSample {
  TmConstVec3 L;               /* unit vector from P to the light */
  TmConstVec3 Cl;              /* shadowed, divided by the number of samples */
  int32_t isIndirect, nondiffuse, nonspecular;
} TmLightSample;

typedef enum TmLightChoice { TM_DIRECT_LIGHT = 1, TM_INDIRECT_LIGHT = 2 } TmLightChoice;

typedef enum TmHitSides { TM_HIT_BOTH = 0, TM_HIT_FRONT = 1, TM_HIT_BACK = 2 } TmHitSides;
typedef enum TmHitMode { TM_HIT_DEFAULT = 0, TM_HIT_PRIMITIVE = 1, TM_HIT_SHADER = 2 } TmHitMode;

/* How rays are shot. Start from TM_RAY_DEFAULTS. Directions are stratified over the rays of a point and reproducible. */
typedef struct TmRayOptions {
  uint32_t structBytes;
  int32_t samples;             /* rays a point */
  float coneAngle;             /* half angle around the axis, radians, up to pi/2; 0: all along it */
  int32_t uniform;             /* 1: evenly over the cone's solid angle; 0: by the cosine with its axis */
  float bias;                  /* hits nearer do not count; < 0: as the object's attributes say */
  float maxDistance;
  float sampleBase;            /* share of its micropolygon, 0..1, that the rays of a point start from */
  const char *label;           /* seen by rayLabel() at what they meet; NULL: "" */
  const char *subset, *excludeSubset; /* sets of Attribute "grouping" "membership", by commas or spaces; NULL: all, none */
  int32_t hitSides, hitMode;   /* TmHitSides; TmHitMode, default: as the attributes of what is met say */
  float opacityThreshold;      /* rays go on behind what is transparent until this much is covered */
  float falloff;               /* occlusion(): what is met at distance d counts exp(-falloff d), or with */
  int32_t falloffMode;         /* mode 1 (1 - d / maxDistance)^falloff; falloff 0: wholly */
} TmRayOptions;

#define TM_RAY_DEFAULTS \
  { sizeof(TmRayOptions), 1, 0, 0, -1, 1e30f, 0, 0, 0, 0, TM_HIT_BOTH, TM_HIT_DEFAULT, 1, 0, 0 }

/* One value of each ray of gather(): "surface:Ci", "surface:Oi", "primitive:" P, N, Ng, I, dPdu, dPdv, u, v, s, t, Cs, Os or a
 * primitive variable, "attribute:category:name", "ray:origin", "ray:direction", "ray:length". Numbers fill c[0], triples all. */
typedef struct TmRayOutput {
  const char* name;
  int32_t floats;              /* 1 or 3 */
  float* c[3];
} TmRayOutput;

/* Whose value ask() looks for. Parameters and outputs by name; "__shadername" is a shader's own name. */
typedef enum TmWhom {
  TM_OF_SURFACE = 0, TM_OF_DISPLACEMENT = 1, TM_OF_ATMOSPHERE = 2,
  TM_OF_INCIDENT = 3,          /* the volume shader on the side of the surface that I arrives at (Exterior, Interior) */
  TM_OF_OPPOSITE = 4,          /* and that on the other side */
  TM_OF_LIGHT = 5,             /* a light: TmIlluminance::light */
  TM_OF_ATTRIBUTES = 6,        /* "Ri:ShadingRate", "user:name", "category:name" (rispec-table section 4) */
  TM_OF_OPTIONS = 7,           /* "Format", "Shutter", "Clipping", "Frame", "user:name", "category:name" */
  TM_OF_RENDERER = 8           /* "renderer", "version" (four numbers), "versionstring" */
} TmWhom;

/* illuminance(): start with next = 0 and call until 0 is returned. */
typedef struct TmIlluminance {
  uint32_t structBytes;
  int32_t next;
  const char* category;        /* "", NULL: all lights; "a,b": one of these; "-a": without; "a&-b" (parameter __category of lights) */
  TmConstVec3 axis;            /* x NULL: from all around; else from the cone of half angle `angle` around it */
  float angle;
  int32_t light;               /* out, and all below: for ask() */
  TmConstVec3 L;               /* from P to the light, of full length; unit length where it is at infinity */
  TmConstVec3 Cl;              /* shadowed, divided by the number of samples */
  const uint8_t* lit;          /* 1: active, and the sample comes from the cone */
  int32_t isIndirect, nondiffuse, nonspecular;
} TmIlluminance;

/* How texture() and environment() look up (rispec-table section 10). Start from TM_TEXTURE_DEFAULTS. */
typedef struct TmTextureLookup {
  uint32_t structBytes;
  int32_t channel, channels;   /* the first, and 1 or 3 */
  float fill;                  /* of channels that the picture lacks */
  const char* filter;          /* NULL: "box" */
  float sblur, tblur;          /* added to the region, as a fraction of the picture */
  float swidth, twidth;        /* scale of the region; 0: a point */
  int32_t samples;             /* environment(), of "raytrace": rays */
} TmTextureLookup;

#define TM_TEXTURE_DEFAULTS { sizeof(TmTextureLookup), 0, 3, 0, 0, 0, 0, 1, 1, 1 }

typedef enum TmTransformKind { TM_AS_POINT = 0, TM_AS_VECTOR = 1, TM_AS_NORMAL = 2 } TmTransformKind;

/* How a shadow map is looked up. */
typedef struct TmShadowLookup {
  float bias;                  /* depth that an occluder must be nearer to the light by; negative: the scene's, or as needed */
  float blur, width;           /* added region as a fraction of the map; scale of the micropolygon's own region */
  int32_t samples;
} TmShadowLookup;

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
  int32_t (*transform)(void* host, const TmGrid*, int32_t kind, const char* from, const char* to, TmConstVec3 in, TmVec3 out);

  /* Texture `name` at (s,t) with the footprint of one point, `channels` floats (1 or 3) from `channel`, t down the image.
   * Returns 0 when the file is missing: the error has been reported and `out` holds the loud substitute. */
  int32_t (*texture)(void* host, const TmGrid*, const char* name, int32_t channel, int32_t channels, const float* s,
                     const float* t, TmVec3 out);

  /* RISpec calculatenormal(): normal of the batch's surface if its points were at P. Elsewhere than in displacements it takes
   * TM_NEIGHBOURS, or copies N. */
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

  /* RISpec shadow(): the share of light that what is in shadow map `name` blocks at P, 1: all; colours from deep maps. 0 outside
   * the map, for "raytrace", and where the map cannot be read (the renderer traces those shadows itself). */
  void (*shadow)(void* host, const TmGrid*, const char* name, TmConstVec3 P, const TmShadowLookup*, TmVec3 out);

  /* Ray tracing. Shaders that call these have TM_TRACES. `options` may be NULL. Narrow cones (up to 10 degrees) shoot specular rays,
   * wide ones diffuse rays: Attribute "visibility" and the depth limits of "trace" tell them apart. */

  /* Mean colour that the rays bring, through what is transparent, and the least distance to what they meet (1e30: nothing). Either
   * may be NULL (x NULL). */
  void (*trace)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 direction, const TmRayOptions* options, TmVec3 color,
                float* distance);
  /* Ray number `ray` of options->samples of each active point, around `axis`: hit[i] says whether it met anything, and outputs are set
   * where it did ("ray:" values everywhere). Returns 0 when there are no more. */
  int32_t (*gather)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 axis, const TmRayOptions* options, int32_t ray, uint8_t* hit,
                    const TmRayOutput* outputs, int32_t outputCount);
  /* Share of the cone around N that is covered, and (unless x is NULL) the mean radiance that arrives from it. coneAngle 0: the whole
   * hemisphere. */
  void (*occlusion)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 N, const TmRayOptions* options, float* covered, TmVec3 radiance);
  /* transmission() with options; several samples spread over a cone. */
  void (*transmissionWith)(void* host, const TmGrid*, TmConstVec3 P, TmConstVec3 toward, const TmRayOptions* options, TmVec3 out);
  /* Of the ray that came to these points: "type" (0 camera, 1 diffuse, 2 specular, 3 transmission), "depth", "diffusedepth",
   * "speculardepth" into x; "origin", "direction" into all, "length" into x. Returns 0: no such name. */
  int32_t (*rayInfo)(void* host, const TmGrid*, const char* name, TmVec3 out);
  /* Its label. */
  const char* (*rayLabel)(void* host, const TmGrid*);

  /* Multiple importance sampling of a surface's own lobe f (the cosine included, over pi less), as specular() does it. With m =
   * lobeSamples() and p(L) the density over solid angle with which the surface draws L, the highlight is the sum of
   *   f(L) Cl / (1 + (m p(L) / d)^2)    over light(): d of lightDensity(), or wholly where that is 0
   *   f(L) Cl                           over m directions of its own: Cl of lightAlong()
   * lightDensity: 0 where lightAlong() would not find the light. lightAlong: L unit length, sample number 0..m-1, density p(L), 0 for
   * none. stratified: numbers in [0,1) for sample number `sample`. */
  void (*lightDensity)(void* host, const TmGrid*, int32_t index, float* out);
  void (*lightAlong)(void* host, const TmGrid*, TmConstVec3 L, const float* density, int32_t sample, int32_t samples, TmVec3 Cl);
  int32_t (*lobeSamples)(void* host, const TmGrid*);
  void (*stratified)(void* host, const TmGrid*, int32_t sample, int32_t samples, float* xi0, float* xi1);

  /* Derivative by u (direction 0) or v (1) of a value at every point: centred differences, one-sided at the border of a grid. Knows
   * u, v, s, t, P, N and primitive variables with TM_DERIVATIVES, all values with TM_NEIGHBOURS and in displacements. */
  void (*derivative)(void* host, const TmGrid*, int32_t direction, const float* value, float* out);
  /* texture() with options: over the parallelogram that the micropolygon covers in (s, t). `lookup` may be NULL. */
  int32_t (*textureWith)(void* host, const TmGrid*, const char* name, const TmTextureLookup* lookup, const float* s, const float* t,
                         TmVec3 out);
  /* environment() with options, over the cone that the micropolygon sees in `direction`; "raytrace" traces rays. */
  int32_t (*environmentWith)(void* host, const TmGrid*, const char* name, const TmTextureLookup* lookup, TmConstVec3 direction, TmVec3 out);
  /* RISpec illuminance(). Ambient lights are not listed. The arrays live until the shader returns. */
  int32_t (*illuminance)(void* host, const TmGrid*, TmIlluminance*);
  /* A value of something else: `type` is the TmType, `out` as a parameter of this shader (it lives until the shader returns).
   * Returns 0 if there is no such value. `light` counts for TM_OF_LIGHT alone; negative: the light that is running. */
  int32_t (*ask)(void* host, const TmGrid*, int32_t whom, int32_t light, const char* name, int32_t* type, TmValue* out);
  /* RISpec textureinfo(): "exists", "resolution", "type", "channels", "bitsperchannel", "viewingmatrix", "projectionmatrix". */
  int32_t (*textureInfo)(void* host, const TmGrid*, const char* name, const char* what, int32_t* type, TmValue* out);
} TmServices;

typedef struct TmShader {
  uint32_t abi, structBytes;   /* TM_SHADER_ABI and sizeof(TmShader) of the plugin's header: checked before all else */
  const char* name;
  int32_t kind;                /* TmKind */
  uint32_t capabilities;       /* of TmCapability */
  const TmParamDecl* params;
  int32_t paramCount;
  void (*shade)(const TmGrid* grid);
  const char* doc;
} TmShader;

typedef struct TmShaderLibrary {
  uint32_t abi, structBytes;
  const TmShader* const* shaders;
  int32_t count;
} TmShaderLibrary;

/* The one symbol that a plugin exports. */
typedef const TmShaderLibrary* (*TmShadersFunction)(void);
#define TM_SHADERS_SYMBOL "tomales_shaders"

/* The shaders that come with the renderer (shaders/library.cpp). */
const TmShaderLibrary* tomales_builtin_shaders(void);

#ifdef __cplusplus
}
#endif
