// Turns indirect light into light samples, so that existing surface shaders receive it unchanged (Tabellion and
// Lamorlette 2004 sections 4.6 and 5.1): three samples, one for each colour channel, from its own dominant direction.
#pragma once
#include "reyes/shader.h"

/// Indirect light at a batch: E/pi on the viewer's side, and the dominant direction of each channel.
struct Indirect {
  explicit Indirect(const rsl::Batch& b) : Nf(b.facingNormals()), E(b.g), red(b.g), green(b.g), blue(b.g) {
    TmVec3 dominant[3] = {red, green, blue};
    b.g->call->indirectDiffuse(b.g->host, b.g, Nf, E, dominant);
  }
  /// Emits the current sample's channel of `light` (E/pi); diffuse(Nf) of all three gives `light` back (eq. 6).
  void emit(const rsl::Batch& b, int i, rsl::Color light) const {
    const int c = b.g->sample;
    const rsl::Vec3 N = Nf[i], w = c == 0 ? red[i] : c == 1 ? green[i] : blue[i];
    // A direction at the horizon or below (extrapolated from another point's hemisphere) is lifted just above it.
    const rsl::Vec3 L = rsl::normalize(w + std::max(0.0f, 0.01f - rsl::dot(N, w)) * N);
    const float weight = 1 / std::max(1e-6f, rsl::dot(N, L));
    b.illuminate(i, L, {c == 0 ? weight * light.x : 0, c == 1 ? weight * light.y : 0, c == 2 ? weight * light.z : 0});
  }
  rsl::Vec3Array Nf, E, red, green, blue;
};
