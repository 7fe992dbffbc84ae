#include "shared.sl"
#if defined(BMRT) || (TOMALES + 1 > 2 ? 0 : 1) && !0x10
# error not here
#elif 1
light spot(float angle = RADIANS(30); point from = (0, 0, 0)) {
  illuminate(from, vector(0, 0, 1), angle) Cl = 1 / (L . L);
}
#else
nothing
#endif
light sun() { solar(vector "world" (0, -1, 0), 0) { Cl = color "rgb" 1; } }
imager flat() { Ci = 0; }
volume thin() { }
displacement bump() { P += .1 * N; N = calculatenormal(P); }
transformation twist() { }
