surface julia(float cx = -.74, cy = .18, most = 40) {
  float x = 3 * (s - .4), y = 3 * (t - .5), n = 0, size = 0;
  while (n < most && size < 4) {
    float x2 = x * x - y * y + cx;
    y = 2 * x * y + cy;
    x = x2;
    size = x * x + y * y;
    n += 1;
  }
  float f = n / most;
  Oi = Os;
  Ci = Os * color(f, f * f, sqrt(f));
}
