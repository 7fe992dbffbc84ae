/* Functions that shaders in the shading language call as if they were built in (docs/rsl.md, "Functions of plugins").
 *   cc -O3 -ffp-contract=off -shared -fPIC -I PREFIX/include/tomales functions.c -o functions.so -lm
 * A shader uses them as: float w = weave(10 * s, 10 * t); float r, a; polar(s - .5, t - .5, r, a); */
#include <math.h>

#include <reyes/shader/functions.h>

static float at(const TmValue* v, int k, int i) { return v->c[k][i * v->step]; }
/* Sets a component of a result or of an output. */
static void set(const TmValue* v, int k, int i, float x) { ((float*)v->c[k])[i] = x; }

/* Tells which thread lies above: 1 for those along the first number, else 0. */
static void weave(const TmFunctionCall* call) {
  for (int i = 0; i < call->count; ++i) {
    if (!call->active[i]) continue;
    const float x = floorf(at(&call->args[1], 0, i)), y = floorf(at(&call->args[2], 0, i));
    set(&call->args[0], 0, i, fmodf(fabsf(x + y), 2));
  }
}

static void polar(const TmFunctionCall* call) {
  for (int i = 0; i < call->count; ++i) {
    if (!call->active[i]) continue;
    const float x = at(&call->args[0], 0, i), y = at(&call->args[1], 0, i);
    set(&call->args[2], 0, i, hypotf(x, y));
    set(&call->args[3], 0, i, atan2f(y, x));
  }
}

static void fade(const TmFunctionCall* call) {
  for (int i = 0; i < call->count; ++i)
    for (int k = 0; k < 3 && call->active[i]; ++k)
      set(&call->args[0], k, i, at(&call->args[1], k, i) * expf(-at(&call->args[2], 0, i)));
}

static const TmFunction functions[] = {
    {"float weave(float, float)", "a chequer of threads", weave},
    {"void polar(float, float, output float, output float)", "radius and angle", polar},
    {"color fade(color, float)", "a colour behind so much of a medium", fade},
};
static const TmFunctionLibrary library = {TM_SHADER_ABI, sizeof library, functions,
                                          sizeof functions / sizeof *functions, sizeof *functions};

const TmFunctionLibrary* tomales_functions(void) { return &library; }
