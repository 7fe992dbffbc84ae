#ifndef SHARED_H
#define SHARED_H
#define RADIANS(a) \
  ((a) * 3.14159 / 180)
#endif
