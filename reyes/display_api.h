/* The binary contract between the renderer and a display driver: a plugin that takes a picture while it is made, to
 * show it, to send it somewhere, or to write a file of a format of its own. Plain C, as the contract of shaders is
 * (reyes/shader_api.h), and it grows by the same rules.
 *
 * `Display "NAME" "TYPE" "MODE"` asks for the driver in TYPE.so. The program tomales_display_host loads it, in a
 * process of its own: a driver that crashes takes no picture with it. All calls come from one thread:
 *
 *   open     once
 *   rows     from the top down, each row once, in bands; --preview may first send rows that are coarse, and then better
 *            ones in their place
 *   close    once, if open has succeeded
 *
 * Pixels are linear floats, what an OpenEXR file of the same Display would hold: filtered, exposed, colours
 * premultiplied by alpha, not quantised. */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TM_DISPLAY_ABI 1
#define TM_DISPLAY_PROBLEM_BYTES 256

/* A parameter of the Display. Of the three arrays that of its type has `count` values, and the others are NULL.
 * Those whose *wasRead stays 0 while the picture is opened are reported to the user as unknown. */
typedef struct TmDisplayParam {
  const char* name;
  const float* floats; /* of colours, points and matrices too */
  const int32_t* ints;
  const char* const* strings;
  int32_t count;
  int32_t wasRead;
} TmDisplayParam;

/* What open is told. All of it lives until close returns. */
typedef struct TmDisplayPicture {
  uint32_t structBytes;
  int32_t width, height;         /* of the pixels that come: the crop window, */
  int32_t x, y;                  /* the place of its first pixel in the whole picture, */
  int32_t fullWidth, fullHeight; /* and the size of that; x to the right, y down */
  float pixelAspect;             /* width of a pixel over its height */
  int32_t channelCount, paramCount;
  const char* const* channels; /* "R" "G" "B" "A" "Z"; of other variables "name", "name.R", "name.X" */
  TmDisplayParam* params;
  const char *name, *mode; /* first and third argument of Display */
  /* Of the camera, as pictures have them: they act on rows, and x and y of screen space are -1 to 1 in the whole
   * picture. */
  float worldToCamera[16], worldToScreen[16];
} TmDisplayPicture;

/* Pixel (i, j) of these, channel c: pixels[(j * width + i) * channelCount + c]. */
typedef struct TmDisplayRows {
  uint32_t structBytes;
  int32_t x, y, width, height; /* in the whole picture */
  const float* pixels;
} TmDisplayRows;

/* A function that fails writes why to `problem`, TM_DISPLAY_PROBLEM_BYTES bytes that hold "" before: one sentence
 * without the name of driver or picture, which are told anyway. The picture then counts as not written (exit code 4),
 * and nothing but close is called for it any more. */
typedef struct TmDisplayDriver {
  uint32_t abi, structBytes; /* TM_DISPLAY_ABI and sizeof(TmDisplayDriver) of the driver's header */
  const char* doc;
  /* Returns what the other functions are called with; NULL: it has failed. */
  void* (*open)(const TmDisplayPicture* picture, char* problem);
  /* 0: well. */
  int32_t (*rows)(void* opened, const TmDisplayRows* rows, char* problem);
  /* complete 0: rows are missing, because something has failed; those that came may be kept. 0: well. */
  int32_t (*close)(void* opened, int32_t complete, char* problem);
} TmDisplayDriver;

/* The one symbol that a driver exports. */
typedef const TmDisplayDriver* (*TmDisplayFunction)(void);
#define TM_DISPLAY_SYMBOL "tomales_display"

/* The parameter of this name, which counts as read from then on; NULL: there is none. */
static inline const TmDisplayParam* tmDisplayParam(const TmDisplayPicture* picture, const char* name) {
  int32_t i;
  for (i = 0; i < picture->paramCount; ++i) {
    const char *a = picture->params[i].name, *b = name;
    while (*a && *a == *b) ++a, ++b;
    if (*a != *b) continue;
    picture->params[i].wasRead = 1;
    return &picture->params[i];
  }
  return 0;
}

#ifdef __cplusplus
}
#endif
