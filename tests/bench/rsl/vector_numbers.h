// The numbers of loops/ for as many points as a vector of the processor holds, by Highway. Included once for each kind
// of processor.
HWY_BEFORE_NAMESPACE();
namespace tomales::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using Words = hn::RebindToUnsigned<Floats>;
constexpr Floats kF;
constexpr Ints kI;
constexpr Words kU;
constexpr int kWidth = static_cast<int>(hn::MaxLanes(kF));

struct F {
  hn::Vec<Floats> v;
  HWY_INLINE F() : v(hn::Zero(kF)) {}
  HWY_INLINE F(float x) : v(hn::Set(kF, x)) {}
  HWY_INLINE F(hn::Vec<Floats> x) : v(x) {}
};
struct B {
  hn::Mask<Floats> m;
};
using U = hn::Vec<Words>;

HWY_INLINE F operator+(F a, F b) { return hn::Add(a.v, b.v); }
HWY_INLINE F operator-(F a, F b) { return hn::Sub(a.v, b.v); }
HWY_INLINE F operator*(F a, F b) { return hn::Mul(a.v, b.v); }
HWY_INLINE F operator/(F a, F b) { return hn::Div(a.v, b.v); }
HWY_INLINE F operator-(F a) { return hn::Neg(a.v); }
HWY_INLINE F& operator+=(F& a, F b) { return a = a + b; }
HWY_INLINE F& operator-=(F& a, F b) { return a = a - b; }
HWY_INLINE F& operator*=(F& a, F b) { return a = a * b; }
HWY_INLINE B operator<(F a, F b) { return {hn::Lt(a.v, b.v)}; }
HWY_INLINE B operator>(F a, F b) { return {hn::Gt(a.v, b.v)}; }
HWY_INLINE B operator==(F a, F b) { return {hn::Eq(a.v, b.v)}; }
HWY_INLINE B operator&(B a, B b) { return {hn::And(a.m, b.m)}; }

HWY_INLINE F load(const float* from, int i) { return hn::LoadU(kF, from + i); }
HWY_INLINE void store(float* to, int i, F x) { hn::StoreU(x.v, kF, to + i); }
HWY_INLINE F select(B c, F a, F b) { return hn::IfThenElse(c.m, a.v, b.v); }
HWY_INLINE F floorOf(F x) { return hn::Floor(x.v); }
HWY_INLINE F sqrtOf(F x) { return hn::Sqrt(x.v); }
HWY_INLINE F absOf(F x) { return hn::Abs(x.v); }
HWY_INLINE F minOf(F a, F b) { return hn::Min(a.v, b.v); }
HWY_INLINE F maxOf(F a, F b) { return hn::Max(a.v, b.v); }
HWY_INLINE F expOf(F x) { return hn::Exp(kF, x.v); }
HWY_INLINE F powOf(F x, F y) {
  return select(F(0.0f) < x, hn::Exp(kF, hn::Mul(y.v, hn::Log(kF, hn::Max(x.v, hn::Set(kF, 1e-30f))))), 0.0f);
}
HWY_INLINE F sinOf(F x) { return hn::Sin(kF, x.v); }
HWY_INLINE F cosOf(F x) { return hn::Cos(kF, x.v); }
HWY_INLINE F tanOf(F x) { return sinOf(x) / cosOf(x); }
HWY_INLINE F acosOf(F x) { return hn::Acos(kF, x.v); }
HWY_INLINE F atanOf(F y, F x) {
  const F ax = absOf(x), ay = absOf(y), large = maxOf(ax, ay), ratio = minOf(ax, ay) / maxOf(large, 1e-30f);
  const F first = hn::Atan(kF, ratio.v), turned = select(ay > ax, F(1.57079633f) - first, first);
  const F whole = select(x < F(0.0f), F(3.14159265f) - turned, turned);
  return hn::CopySign(whole.v, y.v);
}
HWY_INLINE F lookUp(const float* table, F index) { return hn::GatherIndex(kF, table, hn::ConvertTo(kI, index.v)); }
/// One side alone where all points want it.
template <class Then, class Else>
HWY_INLINE auto pick(B c, const Then& then, const Else& otherwise) {
  if (hn::AllTrue(kF, c.m)) return then();
  if (hn::AllFalse(kF, c.m)) return otherwise();
  return select(c, then(), otherwise());
}
HWY_INLINE bool any(B c) { return !hn::AllFalse(kF, c.m); }

HWY_INLINE U mixed(U h, U c) {
  h = hn::Mul(hn::Xor(h, c), hn::Set(kU, 0x9e3779b9U));
  h = hn::Mul(hn::Xor(h, hn::ShiftRight<16>(h)), hn::Set(kU, 0x7feb352dU));
  h = hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)), hn::Set(kU, 0x846ca68bU));
  return hn::Xor(h, hn::ShiftRight<16>(h));
}
HWY_INLINE U wholeOf(F x) { return hn::BitCast(kU, hn::ConvertTo(kI, x.v)); }
HWY_INLINE B hasBit(U hash, uint32_t bit) { return {hn::RebindMask(kF, hn::TestBit(hash, hn::Set(kU, bit)))}; }
/// rsl::gradient().
HWY_INLINE F gradientOf(U hash, F x, F y, F z) {
  const U h = hn::And(hash, hn::Set(kU, 15));
  const F a = select(B{hn::RebindMask(kF, hn::Lt(hn::BitCast(kI, h), hn::Set(kI, 8)))}, x, y);
  const B xAgain = {hn::RebindMask(kF, hn::Eq(hn::And(h, hn::Set(kU, 13)), hn::Set(kU, 12)))};
  const F b = select(B{hn::RebindMask(kF, hn::Lt(hn::BitCast(kI, h), hn::Set(kI, 4)))}, y, select(xAgain, x, z));
  const U first = hn::ShiftLeft<31>(h), second = hn::ShiftLeft<30>(hn::And(h, hn::Set(kU, 2)));
  return F(hn::Xor(a.v, hn::BitCast(kF, first))) + F(hn::Xor(b.v, hn::BitCast(kF, second)));
}
/// rsl::noise(), of places that are not too far out.
HWY_INLINE F noise(F px, F py, F pz) {
  const F cx = floorOf(px), cy = floorOf(py), cz = floorOf(pz), x = px - cx, y = py - cy, z = pz - cz;
  const U one = hn::Set(kU, 1), ix = wholeOf(cx), iy = wholeOf(cy), iz = wholeOf(cz);
  const U izs[2] = {iz, hn::Add(iz, one)};
  const F xs[2] = {x, x - F(1.0f)}, ys[2] = {y, y - F(1.0f)}, zs[2] = {z, z - F(1.0f)};
  const auto fade = [](F t) { return t * t * t * (t * (t * F(6.0f) - F(15.0f)) + F(10.0f)); };
  const auto lerp = [](F a, F b, F t) { return a + (b - a) * t; };
  const F u = fade(x), v = fade(y), w = fade(z);
  const U hx[2] = {mixed(hn::Zero(kU), ix), mixed(hn::Zero(kU), hn::Add(ix, one))};
  F planes[2];
  const U hxy[4] = {mixed(hx[0], iy), mixed(hx[1], iy), mixed(hx[0], hn::Add(iy, one)), mixed(hx[1], hn::Add(iy, one))};
  for (int k = 0; k < 2; ++k) {
    const auto corner = [&](int i, int j) { return gradientOf(mixed(hxy[2 * j + i], izs[k]), xs[i], ys[j], zs[k]); };
    planes[k] = lerp(lerp(corner(0, 0), corner(1, 0), u), lerp(corner(0, 1), corner(1, 1), u), v);
  }
  return F(0.5f) + F(0.5f) * minOf(maxOf(lerp(planes[0], planes[1], w), -1.0f), 1.0f);
}
HWY_INLINE F cellnoise(F x, F y, F z) {
  const U h = mixed(mixed(mixed(mixed(hn::Zero(kU), wholeOf(floorOf(x))), wholeOf(floorOf(y))), wholeOf(floorOf(z))),
                    hn::Zero(kU));
  return F(hn::ConvertTo(kF, hn::BitCast(kI, hn::ShiftRight<8>(h)))) * F(0x1p-24f);
}

}  // namespace HWY_NAMESPACE
}  // namespace tomales::bench
HWY_AFTER_NAMESPACE();
