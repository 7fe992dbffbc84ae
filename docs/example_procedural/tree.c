/* A tree that grows as it is looked at. Each branch is a procedural of its own: it draws itself, and its twigs become procedurals
 * with bounds, which are opened only if they are seen. What covers less than a few pixels ends in a leaf. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <reyes/ri.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int levels;      /* twigs upon twigs */
  unsigned number; /* of the branch: what is random comes from it alone, so that the tree is the same in any order of growth */
} Branch;

static const float kTwig = 0.7f;           /* length of a twig to that of its branch, which has length 1 */
static const RtFloat kLeafSize_px2 = 12.0f; /* covered by the whole of what grows on */

/* 0 to 1, the same for the same branch. */
static float chance(unsigned number, unsigned what) {
  unsigned h = number * 2654435761u + what * 40503u;
  h = (h ^ (h >> 15)) * 2246822519u;
  return (float)((h ^ (h >> 13)) & 0xffff) / 65535.0f;
}

/* All that grows from a branch of length 1 that stands at the origin along +z: a sphere of the sum of the geometric series holds it. */
static void bound(int levels, RtBound box) {
  float reach = 0, length = 1;
  int i;
  for (i = 0; i <= levels; ++i, length *= kTwig) reach += length;
  box[0] = box[2] = box[4] = -reach;
  box[1] = box[3] = box[5] = reach;
}

static void drawLeaf(void) {
  static const RtFloat green[3] = {0.25f, 0.5f, 0.12f};
  RtFloat corners[12] = {0, 0, 0, 0.3f, 0, 0.5f, -0.3f, 0, 0.5f, 0, 0, 1};
  RiColor(green);
  RiPatch(RI_BILINEAR, RI_P, corners, RI_NULL);
}

RtVoid Subdivide(RtPointer data, RtFloat detail);
RtVoid Free(RtPointer data);

static void drawTwig(const Branch* from, int k) {
  RtBound box;
  Branch* twig = (Branch*)malloc(sizeof(Branch));
  twig->levels = from->levels - 1;
  twig->number = from->number * 3 + (unsigned)k + 1;
  bound(twig->levels, box);
  RiTransformBegin();
  RiTranslate(0, 0, 1);
  RiRotate(120.0f * (float)k + 60 * chance(twig->number, 0), 0, 0, 1);
  RiRotate(25 + 25 * chance(twig->number, 1), 0, 1, 0);
  RiScale(kTwig, kTwig, kTwig);
  RiProcedural(twig, box, Subdivide, Free);
  RiTransformEnd();
}

RtPointer ConvertParameters(char* text) {
  Branch* trunk = (Branch*)malloc(sizeof(Branch));
  trunk->levels = 6;
  trunk->number = 0;
  sscanf(text, "%d %u", &trunk->levels, &trunk->number);
  return trunk;
}

RtVoid Subdivide(RtPointer data, RtFloat detail) {
  const Branch* branch = (const Branch*)data;
  RtPoint foot = {0.06f, 0, 0}, tip = {0.06f * kTwig, 0, 1};
  int k;
  if (branch->levels <= 0 || detail < kLeafSize_px2) {
    drawLeaf();
    return;
  }
  RiHyperboloid(foot, tip, 360, RI_NULL);
  for (k = 0; k < 3; ++k) drawTwig(branch, k);
}

RtVoid Free(RtPointer data) { free(data); }

#ifdef __cplusplus
}
#endif
