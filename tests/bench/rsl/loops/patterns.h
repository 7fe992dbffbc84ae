// Patterns of noise and numbers. See common.h.
struct wood {
  static HWY_INLINE void shade(const Points& p) {
    F3 Q = p.Q();
    const F3 q = F(4.0f) * Q;
    const auto far = [&](int k) HWY_ATTR {
      const rsl::Vec3 o = rsl::kTriplePlaces[k];
      return noise(q.x + F(o.x), q.y + F(o.y), q.z + F(o.z)) - F(0.5f);
    };
    Q = Q + F(0.08f) * F3{far(0), far(1), far(2)};
    F r = F(12.0f) * sqrtOf(Q.x * Q.x + Q.y * Q.y);
    r += F(0.3f) * noise(r, F(0.5f), F(0.5f));
    const F ring = mod(r, 1), late = smoothstep(0.5f, 0.9f, ring) * (F(1.0f) - smoothstep(0.95f, 1, ring));
    const F grain = smoothstep(0.45f, 0.75f, noise(F(60.0f) * F3{Q.x, Q.y, F(0.1f) * Q.z}));
    const F3 base = mix(rgb(.69f, .44f, .25f), rgb(.35f, .18f, .08f), clamp(late + F(0.25f) * grain, F(0.0f), F(1.0f)));
    const F3 Nf = p.Nf();
    p.opaque(base * p.lit(Nf, 0.7f) + (F(1.0f) - F(0.5f) * grain) * F(0.25f) * p.specular(Nf, p.V(), F(0.12f)));
  }
};
struct marble {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Q = F(4.0f) * p.Q();
    F turbulence = F(0.0f);
    float size = 1;
    for (int k = 0; k < 6; ++k, size *= 2) turbulence += absOf(F(2.0f) * noise(Q * F(size)) - F(1.0f)) * F(1 / size);
    const F vein = clamp(F(0.5f) + F(0.5f) * sinOf(Q.x + F(5.0f) * turbulence), F(0.0f), F(1.0f));
    static constexpr float knots[6][3] = {{.2f, .2f, .3f},  {.2f, .2f, .3f}, {.5f, .5f, .6f},
                                          {.8f, .8f, .85f}, {.9f, .9f, .9f}, {.9f, .9f, .9f}};
    const F3 base = curve<6, 3>(knots, vein);
    const F3 Nf = p.Nf();
    p.opaque(base * p.lit(Nf, 0.8f) + F(0.4f) * p.specular(Nf, p.V(), F(0.07f)));
  }
};
struct granite {
  static HWY_INLINE void shade(const Points& p) {
    F3 Q = F(3.0f) * p.Q();
    F sum = F(0.0f);
    float amplitude = 1;
    for (int k = 0; k < 8; ++k, amplitude *= 0.6f) {
      sum += F(amplitude) * (noise(Q) - F(0.5f));
      Q = Q * F(2.03f);
    }
    p.opaque(p.Cs() * clamp(F(0.5f) + sum, F(0.0f), F(1.0f)) * p.lit(p.Nf(), 0.8f));
  }
};
struct clouds {
  static HWY_INLINE void shade(const Points& p) {
    F3 Q = F(2.0f) * p.Q();
    F sum = F(0.0f);
    float amplitude = 0.5f;
    for (int k = 0; k < 6; ++k, amplitude *= 0.5f) {
      sum += F(amplitude) * noise(Q);
      Q = Q * F(2.0f) + rgb(0.7f, 0.3f, 0.1f);
    }
    const F cover = F(1.0f) - expOf(F(-6.0f) * maxOf(sum - F(0.45f), F(0.0f)));
    const F shade = powOf(clamp(F(1.0f) - sum, F(0.0f), F(1.0f)), F(1.5f));
    p.opaque(mix(rgb(.3f, .5f, .9f), mix(rgb(1, 1, 1), rgb(.5f, .5f, .55f), shade), cover));
  }
};
struct brick {
  static HWY_INLINE void shade(const Points& p) {
    F ss = p.s() * F(1 / 0.1f), tt = p.t() * F(1 / 0.05f);
    const F row = floorOf(tt);
    ss = select(mod(row, 2) == F(1.0f), ss + F(0.5f), ss);
    const F column = floorOf(ss);
    ss -= column;
    tt -= row;
    constexpr float w = 0.05f, h = 0.1f;
    const F inside = smoothstep(w, 2 * w, ss) * (F(1.0f) - smoothstep(1 - 2 * w, 1 - w, ss)) *
                     smoothstep(h, 2 * h, tt) * (F(1.0f) - smoothstep(1 - 2 * h, 1 - h, tt));
    const F tone = F(0.7f) + F(0.6f) * cellnoise(column, row, F(0.0f));
    const F dirt = F(0.8f) + F(0.4f) * noise(F(30.0f) * p.s(), F(30.0f) * p.t(), F(0.5f));
    p.opaque(mix(rgb(.5f, .5f, .5f), rgb(.6f, .15f, .1f) * tone, inside) * dirt * p.lit(p.Nf(), 0.8f));
  }
};
struct planks {
  static HWY_INLINE void shade(const Points& p) {
    constexpr float wide = 0.06f;
    const F which = floorOf(p.s() * F(1 / wide));
    const F tt = p.t() * F(1 / 0.4f) + F(10.0f) * cellnoise(which, F(0.0f), F(0.0f)), plank = floorOf(tt);
    const F tone = F(0.6f) + F(0.8f) * cellnoise(which, plank, F(0.0f));
    const F3 Q = {p.s() * F(80.0f), p.t() * F(4.0f), F(17.0f) * which + F(31.0f) * plank};
    const F grain = noise(Q) + F(0.5f) * noise(F(2.0f) * Q);
    const F ss = mod(p.s(), wide) * F(1 / wide), along = tt - plank;
    const F groove = smoothstep(0, 0.03f, ss) * smoothstep(0, 0.03f, F(1.0f) - ss) * smoothstep(0, 0.005f, along) *
                     smoothstep(0, 0.005f, F(1.0f) - along);
    const F3 Nf = p.Nf(), base = rgb(.57f, .29f, .12f) * tone * (F(0.7f) + F(0.4f) * grain) * groove;
    p.opaque(base * p.lit(Nf, 0.8f) + groove * F(0.3f) * p.specular(Nf, p.V(), F(0.15f)));
  }
};
struct cells {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Q = F(6.0f) * p.Q();
    const F3 corner = F3{floorOf(Q.x), floorOf(Q.y), floorOf(Q.z)} + rgb(0.5f, 0.5f, 0.5f);
    F f1 = F(1000.0f), f2 = F(1000.0f);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const F3 cell = corner + rgb(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
          const auto far = [&](int c) HWY_ATTR {
            const rsl::Vec3 o = rsl::kTriplePlaces[c];
            return F(0.9f) * (cellnoise(cell.x + F(o.x), cell.y + F(o.y), cell.z + F(o.z)) - F(0.5f));
          };
          const F3 offset = cell + F3{far(0), far(1), far(2)} - Q;
          const F d = dot(offset, offset);
          f2 = minOf(f2, maxOf(f1, d));
          f1 = minOf(f1, d);
        }
    const F edge = smoothstep(0.05f, 0.15f, sqrtOf(f2) - sqrtOf(f1));
    p.opaque(mix(rgb(.1f, .05f, .05f), p.Cs(), edge) * p.lit(p.Nf(), 0.8f));
  }
};
struct paint {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Q = F(5.0f) * p.Q();
    const F n = noise(Q), m = noise(F(2.7f) * Q), q = noise(Q * F(9.0f));
    const F primer = smoothstep(0.35f, 0.45f, n + F(0.2f) * q), coat = smoothstep(0.4f, 0.42f, m + F(0.15f) * q);
    F3 layer = mix(mix(rgb(.5f, .2f, .1f), rgb(.7f, .7f, .65f), primer), p.Cs(), coat);
    const F rough = mix(mix(F(0.3f), F(0.2f), primer), F(0.05f), coat), shine = mix(F(0.3f), F(1.0f), coat);
    const F stain = smoothstep(0.6f, 0.8f, noise(F(0.5f) * Q)) * (F(1.0f) - coat * F(0.5f));
    layer = mix(layer * (F(1.0f) - F(0.6f) * stain), rgb(.9f, .9f, .95f), smoothstep(0.78f, 0.8f, q));
    const F3 Nf = p.Nf();
    p.opaque(layer * p.lit(Nf, 0.8f) + F(0.5f) * shine * p.specular(Nf, p.V(), rough));
  }
};
struct ramp {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Q = F(3.0f) * p.Q();
    static constexpr float colors[9][3] = {{0, 0, .2f},     {0, 0, .2f},     {0, .2f, .6f},
                                           {.2f, .6f, .6f}, {.8f, .8f, .3f}, {.9f, .4f, .1f},
                                           {.5f, .05f, 0},  {.2f, 0, 0},     {.2f, 0, 0}};
    static constexpr float lights[6][1] = {{.4f}, {.4f}, {.6f}, {1}, {1.2f}, {1.2f}};
    p.opaque(curve<9, 3>(colors, noise(Q)) * curve<6, 1>(lights, noise(F(2.0f) * Q)).x);
  }
};
struct tiles {
  static HWY_INLINE void shade(const Points& p) {
    static const float c = std::cos(0.6f), z = std::sin(0.6f);
    const F ss = F(10.0f) * (F(c) * p.s() - F(z) * p.t()), tt = F(10.0f) * (F(z) * p.s() + F(c) * p.t());
    const F column = floorOf(ss), row = floorOf(tt), x = ss - column - F(0.5f), y = tt - row - F(0.5f);
    const F tilt = F(6.28318531f) * cellnoise(column, row, F(0.0f)), cosine = cosOf(tilt), sine = sinOf(tilt);
    const F xr = x * cosine - y * sine, yr = x * sine + y * cosine;
    const F star = cosOf(F(5.0f) * atanOf(yr, xr)), radius = sqrtOf(x * x + y * y);
    const F inside = F(1.0f) - smoothstep(0.28f, 0.32f, radius * (F(1.0f) + F(0.3f) * star));
    const F border = smoothstep(0.46f, 0.49f, maxOf(absOf(x), absOf(y)));
    const F3 base = mix(mix(p.Cs(), rgb(.7f, .2f, .1f), inside), rgb(.1f, .1f, .1f), border), Nf = p.Nf();
    p.opaque(base * p.lit(Nf, 0.8f) + (F(1.0f) - border) * F(0.5f) * p.specular(Nf, p.V(), F(0.1f)));
  }
};
