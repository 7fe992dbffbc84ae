/* A display driver: the picture in shared memory, where another program sees it grow.
 *
 *   cc -O2 -shared -fPIC -I PREFIX/include/tomales -o shared_memory.so shared_memory.c
 *   tomales --shaders . scene.rib       with Display "/frame" "shared_memory" "rgba" in it
 *
 * The memory, /dev/shm/frame, begins with four int32_t: width, height, channels and the number of rows that have come;
 * -1 rows: something has failed. The pixels follow, as floats, and stay until somebody unlinks the name. */
#include <errno.h>
#include <fcntl.h>
#include <reyes/display_api.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

typedef struct Header {
  int32_t width, height, channels;
  _Atomic int32_t rows;
} Header;

typedef struct Shared {
  Header* header;
  size_t bytes;
  int32_t y;
} Shared;

static void* openShared(const TmDisplayPicture* picture, char* problem) {
  Shared shared = {MAP_FAILED, 0, picture->y};
  const size_t floats = (size_t)picture->width * (size_t)picture->height * (size_t)picture->channelCount;
  shared.bytes = sizeof(Header) + floats * sizeof(float);
  const int file = shm_open(picture->name, O_RDWR | O_CREAT | O_TRUNC, 0600);
  if (file >= 0 && ftruncate(file, (off_t)shared.bytes) == 0)
    shared.header = mmap(NULL, shared.bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (shared.header == MAP_FAILED) snprintf(problem, TM_DISPLAY_PROBLEM_BYTES, "shared memory: %s", strerror(errno));
  if (file >= 0) close(file);
  if (shared.header == MAP_FAILED) return NULL;
  shared.header->width = picture->width;
  shared.header->height = picture->height;
  shared.header->channels = picture->channelCount;
  Shared* const out = malloc(sizeof shared);
  if (out) *out = shared;
  return out;
}

static int32_t putRows(void* opened, const TmDisplayRows* rows, char* problem) {
  (void)problem;
  const Shared* const shared = opened;
  const size_t row = (size_t)shared->header->width * (size_t)shared->header->channels;
  float* const pixels = (float*)(shared->header + 1);
  memcpy(pixels + (size_t)(rows->y - shared->y) * row, rows->pixels, (size_t)rows->height * row * sizeof(float));
  atomic_store(&shared->header->rows, rows->y - shared->y + rows->height);
  return 0;
}

static int32_t closeShared(void* opened, int32_t complete, char* problem) {
  (void)problem;
  Shared* const shared = opened;
  if (!complete) atomic_store(&shared->header->rows, -1);
  munmap(shared->header, shared->bytes);
  free(shared);
  return 0;
}

const TmDisplayDriver* tomales_display(void) {
  static const TmDisplayDriver driver = {
      TM_DISPLAY_ABI, sizeof(TmDisplayDriver), "the picture in shared memory", openShared, putRows, closeShared};
  return &driver;
}
