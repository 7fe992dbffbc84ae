/* The binary contract between the renderer and a display driver: a plugin that takes a picture while it is made, to
 * show it, to send it somewhere, or to write a file of a format of its own. The contract is plain C, as that of shaders
 * is (reyes/shader_api.h), and grows by the same rules.
 *
 * `Display "NAME" "TYPE" "MODE"` asks for the driver in TYPE.so. The program tomales_display_host loads it, in a
 * process of its own: a driver that crashes takes no picture with it. All calls come from one thread:
 *
 *   open     once
 *   rows     from the top down, each row once, in bands; --preview may first send rows that are coarse, and then better
 *            ones in their place
 *   close    once, if open has succeeded
 *
 * Pixels are linear floats, as an OpenEXR file of the same Display would hold them: they are filtered and exposed,
 * their colours are premultiplied by alpha, and they are not quantised. */
#pragma once
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TM_DISPLAY_ABI 1
#define TM_DISPLAY_PROBLEM_BYTES 256

/* A parameter of the Display. Of the three arrays, the one of its type has `count` values, and the others are NULL.
 * Parameters whose wasRead stays 0 while the picture is opened are reported to the user as unknown. */
typedef struct TmDisplayParam {
  const char* name;
  const float* floats; /* also colours, points and matrices */
  const int32_t* ints;
  const char* const* strings;
  int32_t count;
  int32_t wasRead;
} TmDisplayParam;

/* The picture that open is called for. All of it lives until close returns. */
typedef struct TmDisplayPicture {
  uint32_t structBytes;
  int32_t width, height;         /* size of the part that is sent: the crop window */
  int32_t x, y;                  /* place of its first pixel in the whole picture: x to the right, y down */
  int32_t fullWidth, fullHeight; /* size of the whole picture */
  float pixelAspect;             /* width of a pixel over its height */
  int32_t channelCount, paramCount;
  const char* const* channels; /* "R" "G" "B" "A" "Z"; for other variables "name", "name.R", "name.X" */
  TmDisplayParam* params;
  const char *name, *mode; /* first and third argument of Display */
  /* The camera's matrices, in the convention of picture files: they act on row vectors, and x and y of screen space
   * are -1 to 1 in the whole picture. */
  float worldToCamera[16], worldToScreen[16];
} TmDisplayPicture;

/* Some rows of pixels. Channel c of their pixel (i, j) is pixels[(j * width + i) * channelCount + c]. */
typedef struct TmDisplayRows {
  uint32_t structBytes;
  int32_t x, y, width, height; /* x and y are in the whole picture */
  const float* pixels;
} TmDisplayRows;

/* A function that fails writes why to `problem`, which has TM_DISPLAY_PROBLEM_BYTES bytes and holds "" before: one
 * sentence without the names of driver and picture, which the message has anyway. The picture then counts as not
 * written (exit code 4), and nothing but close is called for it any more. */
typedef struct TmDisplayDriver {
  uint32_t abi, structBytes; /* TM_DISPLAY_ABI and sizeof(TmDisplayDriver) of the driver's header */
  const char* doc;
  /* Returns the `opened` that the other functions are called with, or NULL if it has failed. */
  void* (*open)(const TmDisplayPicture* picture, char* problem);
  /* Returns 0 if all is well. */
  int32_t (*rows)(void* opened, const TmDisplayRows* rows, char* problem);
  /* If `complete` is 0, rows are missing, because something has failed; those that came may be kept. Returns 0 if well.
   */
  int32_t (*close)(void* opened, int32_t complete, char* problem);
} TmDisplayDriver;

/* The one symbol that a driver exports. */
typedef const TmDisplayDriver* (*TmDisplayFunction)(void);
#define TM_DISPLAY_SYMBOL "tomales_display"

/* Returns the parameter of this name, which counts as read from then on, or NULL if there is none. */
static inline const TmDisplayParam* tmDisplayParam(const TmDisplayPicture* picture, const char* name) {
  int32_t i;
  for (i = 0; i < picture->paramCount; ++i) {
    const char *a = picture->params[i].name, *b = name;
    while (*a && *a == *b) {
      ++a;
      ++b;
    }
    if (*a != *b) continue;
    picture->params[i].wasRead = 1;
    return &picture->params[i];
  }
  return 0;
}

#ifdef __cplusplus
}
#endif
