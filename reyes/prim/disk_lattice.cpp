#include "reyes/prim/disk_lattice.h"

#include <array>

#include "reyes/base/simd.h"
#include "reyes/prim/interpolation.h"

namespace tomales {

// Each side of the polygon contributes half the sine of its angle.
double latticeDiskArea(int nu, int nv) {
  const auto quarter = [](int n) {
    double area = 0, last = -M_PI / 4;
    for (int k = 1; k <= n; ++k) {
      const double angle = std::asin((2.0 * k / n - 1) / std::sqrt(2.0));
      area += std::sin(angle - last) / 2;
      last = angle;
    }
    return area;
  };
  constexpr int kUsual = 32;
  static const auto usual = [&] {
    std::array<double, kUsual> areas{};
    for (int n = 1; n < kUsual; ++n) areas[static_cast<size_t>(n)] = quarter(n);
    return areas;
  }();
  const auto known = [&](int n) { return n < kUsual ? usual[static_cast<size_t>(n)] : quarter(n); };
  return 2 * (known(nu) + known(nv));
}

// Maps the square -1..1 to the disk without a seam (elliptical grid mapping: P. Nowell 2005).
TOMALES_HOT void evaluateDisk(const Disk& disk, int n, const float* u, const float* v, const SurfacePoints& out) {
  const float r = disk.radius;
  const vec3 c = disk.center, s = disk.tangent, t = disk.bitangent;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float a = 2 * u[i] - 1, b = 2 * v[i] - 1;
    const float sx = std::sqrt(1 - 0.5f * b * b), sy = std::sqrt(1 - 0.5f * a * a);
    const float x = a * sx, y = b * sy;
    const float xByU = 2 * sx, yByU = 2 * (-0.5f * a * b / sy), xByV = 2 * (-0.5f * a * b / sx), yByV = 2 * sy;
    out.px[i] = c.x + r * (x * s.x + y * t.x);
    out.py[i] = c.y + r * (x * s.y + y * t.y);
    out.pz[i] = c.z + r * (x * s.z + y * t.z);
    out.dux[i] = r * (xByU * s.x + yByU * t.x);
    out.duy[i] = r * (xByU * s.y + yByU * t.y);
    out.duz[i] = r * (xByU * s.z + yByU * t.z);
    out.dvx[i] = r * (xByV * s.x + yByV * t.x);
    out.dvy[i] = r * (xByV * s.y + yByV * t.y);
    out.dvz[i] = r * (xByV * s.z + yByV * t.z);
    out.nx[i] = disk.normal.x;
    out.ny[i] = disk.normal.y;
    out.nz[i] = disk.normal.z;
  }
}

void evaluateDot(const Disk& disk, float more, const SurfacePoints& out) {
  const float r = disk.radius, half = std::sqrt(0.5f);
  const vec3 s = disk.tangent, t = disk.bitangent, c = disk.center;
  for (int i = 0; i < 4; ++i) {
    const float a = i & 1 ? 1.0f : -1.0f, b = i & 2 ? 1.0f : -1.0f, x = a * half, y = b * half,
                lean = -0.5f * a * b / half;
    const vec3 p = c + r * (x * s + y * t);
    setFrame(out, i, p + more * (p - c), r * (2 * half * s + 2 * lean * t), r * (2 * lean * s + 2 * half * t));
    setNormal(out, i, disk.normal);
  }
}

}  // namespace tomales
