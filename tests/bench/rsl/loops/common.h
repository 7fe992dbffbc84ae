// Triples, and what all loops do, over the numbers F and B of whoever includes it. No include guard: it stands in a
// namespace of its includer.
struct F3 {
  F x, y, z;
};
HWY_INLINE F3 operator+(F3 a, F3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE F3 operator-(F3 a, F3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE F3 operator*(F3 a, F3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
HWY_INLINE F3 operator*(F3 a, F s) { return {a.x * s, a.y * s, a.z * s}; }
HWY_INLINE F3 operator*(F s, F3 a) { return a * s; }
HWY_INLINE F3 rgb(float r, float g, float b) { return {F(r), F(g), F(b)}; }
HWY_INLINE F dot(F3 a, F3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE F3 cross(F3 a, F3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
HWY_INLINE F3 select(B c, F3 a, F3 b) { return {select(c, a.x, b.x), select(c, a.y, b.y), select(c, a.z, b.z)}; }
HWY_INLINE F3 normalize(F3 a) { return a * (F(1.0f) / sqrtOf(maxOf(dot(a, a), F(1e-30f)))); }
HWY_INLINE F clamp(F x, F low, F high) { return minOf(maxOf(x, low), high); }
HWY_INLINE F mix(F a, F b, F t) { return a + (b - a) * t; }
HWY_INLINE F3 mix(F3 a, F3 b, F t) { return a + (b - a) * t; }
HWY_INLINE F smoothstep(float low, float high, F x) {
  const F t = clamp((x - F(low)) * F(1 / (high - low)), F(0.0f), F(1.0f));
  return t * t * (F(3.0f) - F(2.0f) * t);
}
HWY_INLINE F mod(F a, float b) { return a - F(b) * floorOf(a * F(1 / b)); }
HWY_INLINE F noise(F3 p) { return noise(p.x, p.y, p.z); }

/// A Catmull-Rom curve through knots of C components, at x in [0, 1].
template <int n, int C>
HWY_INLINE F3 curve(const float (&knots)[n][C], F x) {
  const F at = clamp(x, F(0.0f), F(1.0f)) * F(static_cast<float>(n - 3));
  const F segment = minOf(floorOf(at), F(static_cast<float>(n - 4))), t = at - segment, t2 = t * t, t3 = t2 * t;
  const F w[4] = {F(0.5f) * (F(2.0f) * t2 - t3 - t), F(0.5f) * (F(3.0f) * t3 - F(5.0f) * t2 + F(2.0f)),
                  F(0.5f) * (F(4.0f) * t2 - F(3.0f) * t3 + t), F(0.5f) * (t3 - t2)};
  F out[3] = {F(0.0f), F(0.0f), F(0.0f)};
  for (int c = 0; c < C; ++c)
    for (int k = 0; k < 4; ++k)
      out[c] += w[k] * lookUp(&knots[0][0], segment * F(static_cast<float>(C)) + F(static_cast<float>(C * k + c)));
  return {out[0], out[1], out[2]};
}

HWY_INLINE F3 load(const TmConstVec3& from, int i) { return {load(from.x, i), load(from.y, i), load(from.z, i)}; }
HWY_INLINE F3 load(const TmVec3& from, int i) { return {load(from.x, i), load(from.y, i), load(from.z, i)}; }
HWY_INLINE void store(const TmVec3& to, int i, F3 c) {
  store(to.x, i, c.x);
  store(to.y, i, c.y);
  store(to.z, i, c.z);
}

/// Some points of a batch.
struct Points {
  const Batch& b;
  int i;
  HWY_INLINE F s() const { return load(b.grid.s, i); }
  HWY_INLINE F t() const { return load(b.grid.t, i); }
  HWY_INLINE F3 P() const { return load(b.grid.P, i); }
  HWY_INLINE F3 I() const { return load(b.grid.I, i); }
  HWY_INLINE F3 Cs() const { return load(b.grid.Cs, i); }
  HWY_INLINE F3 turned(F3 v) const {
    const auto& m = Batch::kSpace;
    const auto row = [&](int c) HWY_ATTR { return F(m[c][0]) * v.x + F(m[c][1]) * v.y + F(m[c][2]) * v.z; };
    return {row(0), row(1), row(2)};
  }
  /// P in shader space.
  HWY_INLINE F3 Q() const { return turned(P()) + rgb(Batch::kSpace[0][3], Batch::kSpace[1][3], Batch::kSpace[2][3]); }
  /// A normal towards the viewer.
  HWY_INLINE F3 facing(F3 n) const { return select(dot(I(), load(b.grid.Ng, i)) > F(0.0f), n * F(-1.0f), n); }
  HWY_INLINE F3 Nf() const { return facing(normalize(load(b.grid.N, i))); }
  HWY_INLINE F3 V() const { return normalize(I()) * F(-1.0f); }
  /// ambient() + weight * diffuse().
  HWY_INLINE F3 lit(F3 N, float weight, float ambient = 0.1f) const {
    F3 sum = rgb(ambient, ambient, ambient);
    for (const Light& light : b.lights)
      sum = sum + maxOf(dot(N, load(light.L, i)), F(0.0f)) * F(weight) * rgb(light.Cl.x, light.Cl.y, light.Cl.z);
    return sum;
  }
  HWY_INLINE F3 specular(F3 N, F3 V, F roughness) const {
    F3 sum = rgb(0, 0, 0);
    for (const Light& light : b.lights) {
      const F3 L = load(light.L, i), H = normalize(L + V);
      const F power = powOf(maxOf(dot(N, H), F(0.0f)), F(8.0f) / roughness);
      sum = sum + select(dot(N, L) > F(0.0f), power, F(0.0f)) * rgb(light.Cl.x, light.Cl.y, light.Cl.z);
    }
    return sum;
  }
  HWY_INLINE void opaque(F3 c) const {
    const F3 Os = load(b.grid.Os, i);
    store(b.grid.Oi, i, Os);
    store(b.grid.Ci, i, Os * c);
  }
};
