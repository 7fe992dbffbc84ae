#include "reyes/hide/gathered.h"

namespace tomales {
namespace {

constexpr float kOutline = 1e-3f;  ///< Cosine between the line of coverage and a normal at an outline.

}  // namespace

TOMALES_HOT void Gathered::readBlock(const Sources& from, int row, int i) {
#pragma GCC ivdep
  for (int k = 0; k < kLanes; ++k) readCell(from, k, row, i);
}

/// It has no branches, because all lanes of a vector compute both sides.
TOMALES_HOT void derive(const Gathered& g, bool perspective, const PointBlock& out) {
  // factors that stand for the branch on perspective
  const float fromEye = perspective ? 1.0f : 0.0f, parallel = 1 - fromEye;
#pragma GCC ivdep
  for (int i = 0; i < kLanes; ++i) {
    const float ux = g.uEdge[0][i], uy = g.uEdge[1][i], uz = g.uEdge[2][i];
    const float vx = g.vEdge[0][i], vy = g.vEdge[1][i], vz = g.vEdge[2][i];
    // For a cell this is half the cross product of the diagonals: its area, exactly so if it is flat.
    const float spanX = uy * vz - uz * vy, spanY = uz * vx - ux * vz, spanZ = ux * vy - uy * vx;
    const float area2 = spanX * spanX + spanY * spanY + spanZ * spanZ;
    // A normal that points away from the eye although its side is seen becomes the normal of the outline, turned
    // slightly to the eye.
    const float ix = fromEye * g.P[0][i], iy = fromEye * g.P[1][i], iz = fromEye * g.P[2][i] + parallel;
    const float along = spanX * ix + spanY * iy + spanZ * iz, i2 = ix * ix + iy * iy + iz * iz;
    const float back = (g.side[i] * kOutline * std::sqrt(area2 * i2) - along) / i2;
    const float turn = along * g.side[i] < 0 ? back : 0.0f;
    const float sx = spanX + turn * ix, sy = spanY + turn * iy, sz = spanZ + turn * iz;
    const float nx = g.N[0][i], ny = g.N[1][i], nz = g.N[2][i];
    const float toRiSide = sx * nx + sy * ny + sz * nz < 0 ? -1.0f : 1.0f;
    const float perSpan = toRiSide * reciprocalLength(sx * sx + sy * sy + sz * sz);
    const float perNormal = reciprocalLength(nx * nx + ny * ny + nz * nz);
    const bool flat = perSpan == 0, noNormal = perNormal == 0;
    // A missing direction is taken from the other normal, or from the eye if both are missing.
    const float gx = sx * perSpan, gy = sy * perSpan, gz = sz * perSpan;
    const float hx = nx * perNormal, hy = ny * perNormal, hz = nz * perNormal;
    const float ex = 0, ey = 0, ez = -1;
    const float Nx = noNormal ? (flat ? ex : gx) : hx, Ny = noNormal ? (flat ? ey : gy) : hy,
                Nz = noNormal ? (flat ? ez : gz) : hz;
    const float du = g.du[i] != 0 ? g.du[i] : 1.0f, dv = g.dv[i] != 0 ? g.dv[i] : 1.0f;
    out.channel[kPx][i] = g.P[0][i];
    out.channel[kPy][i] = g.P[1][i];
    out.channel[kPz][i] = g.P[2][i];
    out.channel[kNx][i] = Nx;
    out.channel[kNy][i] = Ny;
    out.channel[kNz][i] = Nz;
    out.channel[kNgx][i] = flat ? Nx : gx;
    out.channel[kNgy][i] = flat ? Ny : gy;
    out.channel[kNgz][i] = flat ? Nz : gz;
    out.channel[kDpduX][i] = ux / du;
    out.channel[kDpduY][i] = uy / du;
    out.channel[kDpduZ][i] = uz / du;
    out.channel[kDpdvX][i] = vx / dv;
    out.channel[kDpdvY][i] = vy / dv;
    out.channel[kDpdvZ][i] = vz / dv;
    out.channel[kU][i] = g.u[i];
    out.channel[kV][i] = g.v[i];
    out.channel[kDu][i] = du;
    out.channel[kDv][i] = dv;
    out.channel[kArea][i] = std::sqrt(area2);
  }
  // A loop of its own, because the compiler does not vectorise a choice that is the same for all lanes.
  for (int axis = 0; axis < 3; ++axis)
    if (perspective)
      std::copy_n(g.P[axis], kLanes, out.channel[kIx + axis]);
    else
      std::fill_n(out.channel[kIx + axis], kLanes, axis == 2 ? 1.0f : 0.0f);
}

}  // namespace tomales
