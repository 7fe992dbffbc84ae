#include "coast.h"

/* Golden meadows lie above, rock is on the cliffs, and sand is at their feet. The sand is dark where the sea has wetted
 * it.
 */
surface land(color straw = color(0.50, 0.36, 0.13), green = color(0.16, 0.17, 0.055),
             rockcolor = color(0.50, 0.37, 0.23), darkrock = color(0.21, 0.15, 0.105),
             sand = color(0.46, 0.37, 0.26)) {
  point q = transform("coast", P);
  normal Nf = normalize(N), n = normalize(ntransform("coast", Nf));
  float y = ycomp(q), steep = smoothstep(0.22, 0.5, 1 - ycomp(n) + 0.12 * snoise(q / 6));
  float width = filterwidthp(q);

  /* The grass is greener in patches where water runs down, and the wind leaves streaks in it. */
  float patches = fBm(q / 60, width / 60, 4, 2.2, 0.55), fine = fBm(q / 2.5, width / 2.5, 3, 2, 0.6);
  color meadow = mix(straw, green, smoothstep(-0.15, 0.55, patches)) * (1 + 0.4 * fine);
  meadow = mix(meadow, color(0.075, 0.085, 0.035) * (1 + fine), smoothstep(0.1, 0.6, shrubs(q)));

  /* The rock has beds of several colours, stains that run down, and lichen on the parts that face the sky. */
  float bed = y / 5.2 + 0.5 * snoise(q / 40) + 0.018 * xcomp(q);
  float layer = float noise(3 * bed) + 0.5 * float noise(11 * bed);
  point bare = q;
  displacement("bare", bare);
  float stain = fBm(point(xcomp(bare), 0.2 * y, zcomp(bare)) / 7, width / 7, 3, 2.1, 0.5) + 0.7 * fBm(q / 3.5, width / 3.5, 5, 2.1, 0.65);
  color rock = mix(darkrock, rockcolor, clamp(1.5 * layer - 0.6 + 0.6 * stain, 0, 1));
  float cracks = 1 - abs(fBm(point(xcomp(bare), 0.5 * y, zcomp(bare)) / 4.3, width / 4.3, 4, 2.2, 0.6));
  rock *= 1 - 0.5 * smoothstep(0.88, 1, cracks);
  rock = mix(rock, color(0.30, 0.27, 0.16), 0.5 * smoothstep(0.55, 0.85, ycomp(n)));

  color ground = mix(meadow, rock, steep);
  float beach = 1 - smoothstep(3.2, 5.5, y + 0.6 * fine);
  ground = mix(ground, mix(sand, rock, 0.8 * smoothstep(0.25, 0.5, 1 - ycomp(n))), beach);
  float wet = 1 - smoothstep(0.7, 2.4, y + 0.8 * patches);
  ground *= mix(1, 0.42, wet);

  /* Places that lie lower than their surroundings receive less light from the sky. */
  float here = landheight(xcomp(q), zcomp(q));
  float hollow = clamp((y - here) / 5 + 0.75, 0.45, 1.1);
  Oi = Os;
  Ci = Os * ground * (diffuse(Nf) + hollow * skylight(n));
}
