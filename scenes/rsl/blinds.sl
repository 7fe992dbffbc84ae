/* This spotlight shines through a window with blinds. The beam is a square of half angle `angle`. It has `slats`
   slats, which together block the share `closed` of it. Light shaders have no derivatives, so `soft` sets how soft
   the edges are. */
light blinds(float intensity = 1; color lightcolor = 1;
             point from = point "shader" (0, 0, 0), to = point "shader" (0, 0, 1);
             vector up = vector "shader" (0, 1, 0);
             float angle = radians(15), slats = 9, closed = 0.45, soft = 0.12) {
  uniform vector axis = normalize(to - from);
  uniform vector right = normalize(up ^ axis), above = axis ^ right;
  illuminate (from, axis, 1.5 * angle) {
    float ahead = L . axis;
    float x = (L . right) / (ahead * tan(angle)), y = (L . above) / (ahead * tan(angle));
    /* The window has a frame, and a bar in the middle. */
    float frame = (1 - smoothstep(1 - soft, 1 + soft, abs(x))) * (1 - smoothstep(1 - soft, 1 + soft, abs(y)));
    frame *= smoothstep(0.03, 0.03 + soft, abs(x));
    float slat = mod(0.5 * slats * (y + 1), 1);
    float gap = smoothstep(closed / 2 - soft, closed / 2 + soft, slat) *
                (1 - smoothstep(1 - closed / 2 - soft, 1 - closed / 2 + soft, slat));
    Cl = intensity * lightcolor * frame * gap / (L . L);
  }
}
