// Shaders of branches and loops. See common.h.
struct branches {
  static HWY_INLINE F3 ofLand(F n, F3 Q) {
    return pick(
        n < F(0.55f),
        [&]() HWY_ATTR {
          const F3 shore = mix(rgb(.8f, .7f, .4f), rgb(.4f, .6f, .2f), smoothstep(0.4f, 0.55f, n));
          return pick(
              Q.y > F(0.0f), [&]() HWY_ATTR { return shore * (F(0.8f) + F(0.4f) * noise(F(8.0f) * Q)); },
              [&]() HWY_ATTR { return shore; });
        },
        [&]() HWY_ATTR {
          const F height = (n - F(0.55f)) * F(4.0f);
          return pick(
              height > F(0.6f), [&]() HWY_ATTR { return rgb(.95f, .95f, 1); },
              [&]() HWY_ATTR { return mix(rgb(.3f, .5f, .1f), rgb(.5f, .4f, .3f), height); });
        });
  }
  static HWY_INLINE void shade(const Points& p) {
    const F3 Q = F(6.0f) * p.Q();
    const F n = noise(Q);
    const F3 base = pick(
        n < F(0.4f),
        [&]() HWY_ATTR {
          const F m = noise(F(3.0f) * Q);
          return pick(
              m < F(0.5f), [&]() HWY_ATTR { return rgb(.1f, .3f, .6f) * (F(0.5f) + m); },
              [&]() HWY_ATTR { return rgb(.2f, .5f, .8f) * sqrtOf(m); });
        },
        [&]() HWY_ATTR { return ofLand(n, Q); });
    p.opaque(base * p.lit(p.Nf(), 0.8f));
  }
};
struct julia {
  static HWY_INLINE void shade(const Points& p) {
    F x = F(3.0f) * (p.s() - F(0.4f)), y = F(3.0f) * (p.t() - F(0.5f)), n = F(0.0f), size = F(0.0f);
    for (;;) {
      const B on = (n < F(40.0f)) & (size < F(4.0f));
      if (!any(on)) break;
      const F nextX = x * x - y * y + F(-0.74f), nextY = F(2.0f) * x * y + F(0.18f);
      x = select(on, nextX, x);
      y = select(on, nextY, y);
      size = select(on, x * x + y * y, size);
      n = select(on, n + F(1.0f), n);
    }
    const F f = n * F(1 / 40.0f);
    p.opaque({f, f * f, sqrtOf(f)});
  }
};
struct march {
  static HWY_INLINE void shade(const Points& p) {
    F3 Q = F(2.0f) * p.Q();
    const F3 way = normalize(p.turned(p.I())) * F(0.1f);
    F clear = F(1.0f), light = F(0.0f);
    for (int k = 0; k < 24; ++k) {
      const B on = clear > F(0.05f);
      if (!any(on)) break;
      const F d = F(8.0f) * maxOf(noise(Q) - F(0.5f), F(0.0f));
      const B dense = on & (d > F(0.0f));
      if (any(dense)) {
        const F seen = expOf(F(-0.1f) * d);
        light = select(dense, light + clear * (F(1.0f) - seen) * (F(0.5f) + F(0.5f) * Q.y), light);
        clear = select(dense, clear * seen, clear);
      }
      Q = Q + way;
    }
    p.opaque(mix(F3{light, light, light}, p.Cs(), clear));
  }
};
