// Shaders that are about light, derivatives and pictures. See common.h.
struct anisotropic {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Nf = p.Nf(), V = p.V(), X = normalize(load(p.b.grid.dPdu, p.i)), Y = cross(Nf, X);
    F3 shine = rgb(0, 0, 0), soft = rgb(0, 0, 0);
    const F cosr = dot(V, Nf);
    for (const Light& light : p.b.lights) {
      const F3 L = load(light.L, p.i), H = normalize(V + L), Cl = rgb(light.Cl.x, light.Cl.y, light.Cl.z);
      const F cosi = dot(L, Nf);
      const B counts = (cosi > F(0.0f)) & (cosr > F(0.0f));
      if (!any(counts)) continue;
      const F x = dot(H, X) * F(1 / 0.1f), y = dot(H, Y) * F(1 / 0.4f);
      const F rho = expOf(F(-2.0f) * (x * x + y * y) / (F(1.0f) + dot(H, Nf)));
      const F weight = cosi * rho * F(1 / (4 * 3.14159265f * 0.1f * 0.4f)) / sqrtOf(maxOf(cosi * cosr, F(1e-12f)));
      shine = shine + select(counts, Cl * weight, rgb(0, 0, 0));
      soft = soft + select(counts, Cl * cosi, rgb(0, 0, 0));
    }
    p.opaque(p.Cs() * (rgb(0.1f, 0.1f, 0.1f) + F(0.4f) * soft) + F(0.6f) * shine);
  }
};
struct orennayar {
  static HWY_INLINE void shade(const Points& p) {
    constexpr float sigma2 = 0.25f, a = 1 - 0.5f * sigma2 / (sigma2 + 0.33f), b = 0.45f * sigma2 / (sigma2 + 0.09f);
    const F3 Nf = p.Nf(), V = p.V();
    const F cosr = dot(V, Nf), thetar = acosOf(cosr);
    const F3 Vflat = normalize(V - Nf * cosr);
    F3 sum = rgb(0, 0, 0);
    for (const Light& light : p.b.lights) {
      const F3 L = load(light.L, p.i);
      const F cosi = dot(L, Nf), thetai = acosOf(cosi);
      const F cosphi = dot(Vflat, normalize(L - Nf * cosi));
      const F alpha = maxOf(thetar, thetai), beta = minOf(thetar, thetai);
      const F weight = cosi * (F(a) + F(b) * maxOf(F(0.0f), cosphi) * sinOf(alpha) * tanOf(beta));
      sum = sum + rgb(light.Cl.x, light.Cl.y, light.Cl.z) * weight;
    }
    p.opaque(p.Cs() * (rgb(0.1f, 0.1f, 0.1f) + sum));
  }
};
struct toon {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Nf = p.Nf();
    F sum = F(0.0f);
    for (const Light& light : p.b.lights)
      sum += F(0.3333f * (light.Cl.x + light.Cl.y + light.Cl.z)) * dot(load(light.L, p.i), Nf);
    const F tone = floorOf(sum * F(3.0f) + F(0.5f)) * F(1 / 3.0f);
    const F ink = F(1.0f) - smoothstep(0.2f, 0.25f, dot(p.V(), Nf));
    p.opaque(mix(p.Cs() * (tone + F(0.1f)), rgb(0, 0, 0), ink));
  }
};
struct plastic {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Nf = p.Nf();
    p.opaque(p.Cs() * p.lit(Nf, 0.5f) + F(0.5f) * p.specular(Nf, p.V(), F(0.1f)));
  }
};
struct checker {
  static HWY_INLINE void shade(const Points& p) {
    const auto filtered = [&](F x, F width) HWY_ATTR {
      const F a = mod(x, 1), w = maxOf(absOf(width), F(1e-6f));
      return clamp((a + F(0.5f) * w - F(0.5f)) / w, F(0.0f), F(1.0f)) -
             clamp((a + F(0.5f) * w - F(1.0f)) / w, F(0.0f), F(1.0f));
    };
    const F fs = filtered(F(12.0f) * p.s(), F(12.0f) * load(p.b.sStep, p.i)),
            ft = filtered(F(12.0f) * p.t(), F(12.0f) * load(p.b.tStep, p.i));
    p.opaque(mix(p.Cs(), rgb(.1f, .1f, .1f), fs + ft - F(2.0f) * fs * ft) * p.lit(p.Nf(), 0.8f));
  }
};
struct bumps {
  static HWY_INLINE void shade(const Points& p) {
    const F3 Nn = normalize(load(p.b.grid.N, p.i)), Q = p.Q();
    const F here = noise(F(8.0f) * Q);
    const auto slope = [&](const TmConstVec3& step, const float* size) HWY_ATTR {
      return F(0.02f) * (noise(F(8.0f) * (Q + p.turned(load(step, p.i)))) - here) / load(size, p.i);
    };
    const F3 across = load(p.b.grid.dPdu, p.i) + Nn * slope(p.b.PStepU, p.b.grid.du),
             along = load(p.b.grid.dPdv, p.i) + Nn * slope(p.b.PStepV, p.b.grid.dv);
    const F3 Nf = p.facing(normalize(cross(along, across)));
    p.opaque(p.Cs() * p.lit(Nf, 0.8f) + F(0.4f) * p.specular(Nf, p.V(), F(0.1f)));
  }
};
/// The picture of Batch::lookUp(), worked out in place.
struct decal {
  static HWY_INLINE void shade(const Points& p) {
    const auto picture = [&](F x, F y) HWY_ATTR {
      const F s = x - floorOf(x), t = y - floorOf(y);
      return F(4.0f) * s * (F(1.0f) - s) * t;
    };
    const F ss = F(4.0f) * (p.s() - F(0.5f)) + F(0.5f), tt = F(4.0f) * (p.t() - F(0.5f)) + F(0.5f);
    const F3 paint = {picture(ss, tt), picture(tt, ss), picture(ss, ss)};
    const F cover = smoothstep(0.2f, 0.3f, paint.x);
    const F dirt = F(0.6f) + F(0.4f) * picture(F(3.0f) * p.s(), F(3.0f) * p.t());
    const F3 Nf = p.Nf();
    p.opaque(mix(p.Cs(), paint, cover) * dirt * p.lit(Nf, 0.8f) + cover * F(0.3f) * p.specular(Nf, p.V(), F(0.2f)));
  }
};
struct lamp {
  static HWY_INLINE void shade(const Points& p) {
    static const float outer = std::cos(0.5f), inner = std::cos(0.4f);
    const F3 L = p.P() - rgb(0, 0, 1);
    const F size2 = dot(L, L), cosine = L.z / sqrtOf(size2);
    const B lit = cosine > F(outer);
    F3 Cl = rgb(0, 0, 0);
    if (any(lit)) {
      const F falloff = powOf(cosine, F(2.0f)) / size2 * smoothstep(outer, inner, cosine);
      const F stripes = F(0.5f) + F(0.5f) * sinOf(F(30.0f) * L.x / L.z);
      Cl = select(lit, F(30.0f) * rgb(1, .9f, .8f) * (falloff * mix(F(0.5f), F(1.0f), stripes)), Cl);
    }
    store(p.b.grid.L, p.i, L * F(-1.0f));
    store(p.b.grid.Cl, p.i, Cl);
  }
};
