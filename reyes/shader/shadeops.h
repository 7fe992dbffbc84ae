// RSL's shadeops as functions of one point: mathematics, geometry, colour, matrices, splines (RISpec 15.1 to 15.4).
// Plain C++17 over reyes/shader.h; the same bits on every machine but for the C library's transcendental functions.
// reyes/sl.h applies them to batches.
#pragma once
#include "reyes/shader.h"

namespace rsl {

constexpr float kPi = 3.14159265358979f;

// --- Mathematics

inline float radians(float degrees) { return degrees * (kPi / 180); }
inline float degrees(float radians) { return radians * (180 / kPi); }
// Where a function is undefined, it returns what Open Shading Language returns, so that a number just outside of its
// domain does not bring a NaN into the picture.
/// Returns a - b floor(a / b), which has the sign of b, and 0 for b = 0.
RSL_INLINE float mod(float a, float b) { return b == 0 ? 0 : a - b * wholeBelow(a / b); }
/// Returns 0 for negative numbers.
RSL_INLINE float sqrt(float x) { return x < 0 ? 0 : std::sqrt(x); }
/// Returns 0 for 0 and negative numbers.
RSL_INLINE float inversesqrt(float x) { return x <= 0 ? 0 : 1 / std::sqrt(x); }
/// Returns the arcsine of the nearest number in [-1, 1].
RSL_INLINE float asin(float x) { return std::asin(clamp(x, -1, 1)); }
RSL_INLINE float acos(float x) { return std::acos(clamp(x, -1, 1)); }
/// Returns the lowest float for 0 and negative numbers.
inline float log(float x) { return x <= 0 ? -std::numeric_limits<float>::max() : std::log(x); }
inline float log(float x, float base) { return log(x) / log(base); }
/// Returns 0 for a negative number to a power that is not whole, and for 0 to a negative power; otherwise std::pow().
inline float pow(float x, float y) {
  const bool none =
      (x == 0 && y < 0) || (x < 0 && std::abs(x) <= std::numeric_limits<float>::max() && y != std::floor(y));
  return none ? 0 : std::pow(x, y);
}
RSL_INLINE float sign(float x) { return x < 0 ? -1.0f : x > 0 ? 1.0f : 0.0f; }
RSL_INLINE float step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
/// Returns step() averaged over a box of `width` around x.
RSL_INLINE float filterstep(float edge, float x, float width) {
  return width > 0 ? clamp((x + 0.5f * width - edge) / width, 0, 1) : step(edge, x);
}
RSL_INLINE float min(float a, float b) { return std::min(a, b); }
RSL_INLINE float max(float a, float b) { return std::max(a, b); }
RSL_INLINE Vec3 min(Vec3 a, Vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
RSL_INLINE Vec3 max(Vec3 a, Vec3 b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }
RSL_INLINE Vec3 clamp(Vec3 x, Vec3 lo, Vec3 hi) {
  return {clamp(x.x, lo.x, hi.x), clamp(x.y, lo.y, hi.y), clamp(x.z, lo.z, hi.z)};
}
RSL_INLINE Vec3 mix(Vec3 a, Vec3 b, Vec3 t) { return a + (b - a) * t; }

// --- Geometry

RSL_INLINE float distance(Vec3 a, Vec3 b) { return length(a - b); }
/// Returns the distance from Q to the segment P0 P1.
RSL_INLINE float ptlined(Vec3 P0, Vec3 P1, Vec3 Q) {
  const Vec3 d = P1 - P0;
  const float l2 = dot(d, d);
  return distance(Q, P0 + d * (l2 > 0 ? clamp(dot(Q - P0, d) / l2, 0, 1) : 0));
}
/// Returns Q, rotated around the axis P0 P1 by an angle of this cosine and sine, by the right-hand rule in right-handed
/// coordinates (Rodrigues).
RSL_INLINE Vec3 rotated(Vec3 Q, float cosine, float sine, Vec3 P0, Vec3 P1) {
  const Vec3 k = normalize(P1 - P0), v = Q - P0;
  return P0 + v * cosine + cross(k, v) * sine + k * (dot(k, v) * (1 - cosine));
}
/// The angle is in radians.
inline Vec3 rotate(Vec3 Q, float angle, Vec3 P0, Vec3 P1) {
  return rotated(Q, std::cos(angle), std::sin(angle), P0, P1);
}
/// Sets the shares of reflected and transmitted light, and their directions. I and N are unit vectors. Kt ignores that
/// refraction changes the solid angle.
inline void fresnel(Vec3 I, Vec3 N, float eta, float& Kr, float& Kt, Vec3& R, Vec3& T) {
  Kr = fresnel(I, N, eta);
  Kt = 1 - Kr;
  R = reflect(I, N);
  T = refract(I, N, eta);
}

// --- Matrices: rows act on points from the right, as RIB writes them; the translation is the last row

struct Matrix {
  float m[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  static Matrix of(const float* sixteen) {
    Matrix out;
    std::copy_n(sixteen, 16, &out.m[0][0]);
    return out;
  }
};
inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      out.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] + a.m[i][3] * b.m[3][j];
  return out;
}
/// Inverts by Gauss-Jordan elimination with pivoting. Returns the determinant. If that is 0, `inverse` (may be null) is
/// left alone.
inline float invert(const Matrix& a, Matrix* inverse) {
  Matrix left = a, right;
  float determinant = 1;
  for (int c = 0; c < 4; ++c) {
    int pivot = c;
    for (int r = c + 1; r < 4; ++r)
      if (std::abs(left.m[r][c]) > std::abs(left.m[pivot][c])) pivot = r;
    if (left.m[pivot][c] == 0) return 0;
    if (pivot != c) {
      std::swap(left.m[pivot], left.m[c]);
      std::swap(right.m[pivot], right.m[c]);
      determinant = -determinant;
    }
    determinant *= left.m[c][c];
    const float by = 1 / left.m[c][c];
    for (int k = 0; k < 4; ++k) {
      left.m[c][k] *= by;
      right.m[c][k] *= by;
    }
    for (int r = 0; r < 4; ++r) {
      const float f = left.m[r][c];
      for (int k = 0; r != c && k < 4; ++k) {
        left.m[r][k] -= f * left.m[c][k];
        right.m[r][k] -= f * right.m[c][k];
      }
    }
  }
  if (inverse) *inverse = right;
  return determinant;
}
inline float determinant(const Matrix& a) { return invert(a, nullptr); }
/// These apply the new transformation before those of `a`, as in RIB.
inline Matrix translate(const Matrix& a, Vec3 t) {
  Matrix b;
  b.m[3][0] = t.x;
  b.m[3][1] = t.y;
  b.m[3][2] = t.z;
  return b * a;
}
inline Matrix scale(const Matrix& a, Vec3 s) {
  Matrix b;
  b.m[0][0] = s.x;
  b.m[1][1] = s.y;
  b.m[2][2] = s.z;
  return b * a;
}
/// Rotates by an angle of this cosine and sine.
inline Matrix rotate(const Matrix& a, float cosine, float sine, Vec3 axis) {
  Matrix b;
  const Vec3 rows[3] = {rotated({1, 0, 0}, cosine, sine, {}, axis), rotated({0, 1, 0}, cosine, sine, {}, axis),
                        rotated({0, 0, 1}, cosine, sine, {}, axis)};
  for (int i = 0; i < 3; ++i) {
    b.m[i][0] = rows[i].x;
    b.m[i][1] = rows[i].y;
    b.m[i][2] = rows[i].z;
  }
  return b * a;
}
inline Matrix rotate(const Matrix& a, float angle, Vec3 axis) {
  return rotate(a, std::cos(angle), std::sin(angle), axis);
}
RSL_INLINE Vec3 vtransform(const Matrix& a, Vec3 v) {
  const auto column = [&](int k) { return v.x * a.m[0][k] + v.y * a.m[1][k] + v.z * a.m[2][k]; };
  return {column(0), column(1), column(2)};
}
RSL_INLINE Vec3 transform(const Matrix& a, Vec3 p) {
  const float w = p.x * a.m[0][3] + p.y * a.m[1][3] + p.z * a.m[2][3] + a.m[3][3];
  const Vec3 q = vtransform(a, p) + Vec3{a.m[3][0], a.m[3][1], a.m[3][2]};
  return w != 0 && w != 1 ? q / w : q;
}
/// Transforms a normal by the transposed inverse. It becomes zero where the matrix has no inverse.
inline Vec3 ntransform(const Matrix& a, Vec3 n) {
  Matrix b;
  if (invert(a, &b) == 0) return {};
  return {dot({b.m[0][0], b.m[0][1], b.m[0][2]}, n), dot({b.m[1][0], b.m[1][1], b.m[1][2]}, n),
          dot({b.m[2][0], b.m[2][1], b.m[2][2]}, n)};
}

// --- Colour

inline Color hsvFromRgb(Color c) {
  const float hi = std::max({c.x, c.y, c.z}), lo = std::min({c.x, c.y, c.z}), range = hi - lo;
  if (range <= 0) return {0, 0, hi};
  const float h = hi == c.x ? (c.y - c.z) / range : hi == c.y ? 2 + (c.z - c.x) / range : 4 + (c.x - c.y) / range;
  return {mod(h / 6, 1), hi != 0 ? range / hi : 0, hi};
}
inline Color rgbFromHue(float hue) {
  const float h = 6 * mod(hue, 1);
  return {clamp(std::abs(h - 3) - 1, 0, 1), clamp(2 - std::abs(h - 2), 0, 1), clamp(2 - std::abs(h - 4), 0, 1)};
}
inline Color rgbFromHsv(Color c) { return c.z * mix(Color{1, 1, 1}, rgbFromHue(c.x), c.y); }
inline Color hslFromRgb(Color c) {
  const float hi = std::max({c.x, c.y, c.z}), lo = std::min({c.x, c.y, c.z}), sum = hi + lo;
  const float span = sum <= 1 ? sum : 2 - sum;
  return {hsvFromRgb(c).x, span != 0 ? (hi - lo) / span : 0, sum / 2};
}
inline Color rgbFromHsl(Color c) {
  const float chroma = (1 - std::abs(2 * c.z - 1)) * c.y, low = c.z - chroma / 2;
  return chroma * rgbFromHue(c.x) + Color{low, low, low};
}
/// Converts rgb with the primaries of Rec. 709 and the white point D65.
inline Color xyzFromRgb(Color c) {
  return {dot(c, {0.4123908f, 0.3575843f, 0.1804808f}), dot(c, {0.2126390f, 0.7151687f, 0.0721923f}),
          dot(c, {0.0193308f, 0.1191948f, 0.9505322f})};
}
inline Color rgbFromXyz(Color c) {
  return {dot(c, {3.2409699f, -1.5373832f, -0.4986108f}), dot(c, {-0.9692436f, 1.8759675f, 0.0415551f}),
          dot(c, {0.0556301f, -0.2039770f, 1.0569715f})};
}
inline Color xyYFromXyz(Color c) {
  const float sum = c.x + c.y + c.z;
  return sum != 0 ? Color{c.x / sum, c.y / sum, c.y} : Color{};
}
inline Color xyzFromXyY(Color c) {
  return c.y != 0 ? Color{c.x * c.z / c.y, c.z, (1 - c.x - c.y) * c.z / c.y} : Color{};
}
/// Converts to NTSC's YIQ.
inline Color yiqFromRgb(Color c) {
  return {dot(c, {0.299f, 0.587f, 0.114f}), dot(c, {0.595716f, -0.274453f, -0.321263f}),
          dot(c, {0.211456f, -0.522591f, 0.311135f})};
}
inline Color rgbFromYiq(Color c) {
  return {dot(c, {1, 0.9563f, 0.6210f}), dot(c, {1, -0.2721f, -0.6474f}), dot(c, {1, -1.1070f, 1.7046f})};
}
enum class ColorSpace { Rgb, Hsv, Hsl, Yiq, Xyz, XyY };
/// An unknown name counts as rgb.
inline ColorSpace colorSpaceOf(const std::string& name) {
  return name == "hsv"                    ? ColorSpace::Hsv
         : name == "hsl"                  ? ColorSpace::Hsl
         : name == "YIQ"                  ? ColorSpace::Yiq
         : name == "xyz" || name == "XYZ" ? ColorSpace::Xyz
         : name == "xyY"                  ? ColorSpace::XyY
                                          : ColorSpace::Rgb;
}
inline bool isColorSpace(const std::string& name) { return name == "rgb" || colorSpaceOf(name) != ColorSpace::Rgb; }
inline Color ctransform(ColorSpace from, ColorSpace to, Color c) {
  if (from == to) return c;
  if (from == ColorSpace::Hsv) c = rgbFromHsv(c);
  if (from == ColorSpace::Hsl) c = rgbFromHsl(c);
  if (from == ColorSpace::Yiq) c = rgbFromYiq(c);
  if (from == ColorSpace::Xyz) c = rgbFromXyz(c);
  if (from == ColorSpace::XyY) c = rgbFromXyz(xyzFromXyY(c));
  switch (to) {
    case ColorSpace::Hsv:
      return hsvFromRgb(c);
    case ColorSpace::Hsl:
      return hslFromRgb(c);
    case ColorSpace::Yiq:
      return yiqFromRgb(c);
    case ColorSpace::Xyz:
      return xyzFromRgb(c);
    case ColorSpace::XyY:
      return xyYFromXyz(xyzFromRgb(c));
    default:
      return c;
  }
}
/// Converts between rgb, hsv, hsl, YIQ, xyz and xyY.
inline Color ctransform(const std::string& from, const std::string& to, Color c) {
  return ctransform(colorSpaceOf(from), colorSpaceOf(to), c);
}

}  // namespace rsl
