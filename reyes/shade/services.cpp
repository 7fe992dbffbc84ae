// The table of TmServices, and its calls that are about the surface itself.
#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <span>

#include "reyes/base/checksum.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/services.h"
#include "reyes/shade/spaces.h"

namespace tomales {
namespace {

/// Sets `out` to m * in + origin at active points, with the bits of glm's product with a point. `out` may be `in`.
TOMALES_HOT void transformActive(const TmGrid* g, const mat3& m, const vec3& origin, TmConstVec3 in, TmVec3 out) {
  const uint8_t* active = g->active;
#pragma GCC ivdep
  for (int i = 0; i < g->count; ++i) {
    const float x = in.x[i], y = in.y[i], z = in.z[i];
    const float tx = (m[0][0] * x + m[1][0] * y) + (m[2][0] * z + origin.x),
                ty = (m[0][1] * x + m[1][1] * y) + (m[2][1] * z + origin.y),
                tz = (m[0][2] * x + m[1][2] * y) + (m[2][2] * z + origin.z);
    out.x[i] = active[i] ? tx : out.x[i];
    out.y[i] = active[i] ? ty : out.y[i];
    out.z[i] = active[i] ? tz : out.z[i];
  }
}

bool isAffine(const mat4& m) { return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1; }

int32_t transform(void* host, const TmGrid* g, int32_t kind, const char* from, const char* to, TmConstVec3 in,
                  TmVec3 out) {
  const Batch& batch = batchOf(host);
  const std::optional<Space> a = findSpace(batch, from), b = findSpace(batch, to);
  const bool projected = a && b && (a->kind != Space::Linear || b->kind != Space::Linear);
  if (!a || !b || (projected && kind != TM_AS_POINT)) {
    forActive(g, [&](int i) { set(out, i, get(in, i)); });
    if (!a || !b)
      batch.report(
          Severity::Warning, "shader-space",
          fmt::format("transforms to or from space \"{}\", which is unknown; values stay as they are", a ? to : from));
    return 0;
  }
  const TmType type = kind == TM_AS_POINT ? TM_POINT : kind == TM_AS_NORMAL ? TM_NORMAL : TM_VECTOR;
  const mat4 toFromCurrent = glm::inverse(b->currentFromSpace), toFrom = toFromCurrent * a->currentFromSpace;
  if (!projected && (type != TM_POINT || isAffine(toFrom))) {
    const mat3 linear(toFrom);
    transformActive(g, type == TM_NORMAL ? glm::transpose(glm::inverse(linear)) : linear,
                    type == TM_POINT ? vec3(toFrom[3]) : vec3(0), in, out);
    return 1;
  }
  forActive(g, [&](int i) {
    vec3 p = get(in, i);
    if (!projected) return set(out, i, transformPoint(toFrom, p));
    p = a->kind == Space::Linear ? transformPoint(a->currentFromSpace, p) : currentFromProjected(batch, a->kind, p);
    p = b->kind == Space::Linear ? transformPoint(toFromCurrent, p) : projectedFromCurrent(batch, b->kind, p);
    set(out, i, p);
  });
  return 1;
}

void derivative(void* host, const TmGrid* g, int32_t direction, const float* value, float* out) {
  Batch& batch = batchOf(host);
  const bool alongV = direction != 0;
  float* step = batch.arena.floats(g->count);
  if (!batch.stepsOf(g, alongV, value, step))
    batch.report(Severity::Warning, "shader-derivative",
                 "asks for the derivative of what it has computed, without TM_NEIGHBOURS; it is 0");
  const float* size = alongV ? g->dv : g->du;
  forActive(g, [&](int i) { out[i] = size[i] != 0 ? step[i] / size[i] : 0.0f; });
}

void calculateNormal(void* host, const TmGrid* g, TmConstVec3 P, TmVec3 out) {
  const Batch& batch = batchOf(host);
  if (batch.grid) {
    Grid moved;
    moved.allocate(batch.grid->nu, batch.grid->nv, 1, 0);
    const size_t bytes = static_cast<size_t>(g->count) * sizeof(float);
    std::memcpy(moved.P(0, 0), P.x, bytes);
    std::memcpy(moved.P(0, 1), P.y, bytes);
    std::memcpy(moved.P(0, 2), P.z, bytes);
    const bool flip = batch.scene.scene.objects[static_cast<size_t>(batch.grid->object)].flipsNormal;
    calculateNormals(moved, flip, moved.N(0), moved.N(1), moved.N(2));
    return forActive(g, [&](int i) { set(out, i, moved.normal(i)); });
  }
  const bool differs = batch.stencil && g->count == batch.tm.count;
  forActive(g, [&](int i) {
    if (!differs) return set(out, i, get(g->N, i));
    const auto along = [&](int d) {
      const Stencil& s = batch.stencil;
      return vec3(s.difference(d, P.x, i), s.difference(d, P.y, i), s.difference(d, P.z, i));
    };
    // The normal is put on the side of the geometric one, since a shader cannot know which way dPdu ^ dPdv points. On a
    // polygon, whose u and v are its x and y, du or dv may be a rounding error of either sign.
    const vec3 across = cross(get(g->dPdu, i) * g->du[i], get(g->dPdv, i) * g->dv[i]);
    const float side = dot(across, get(g->Ng, i)) < 0 ? -1.0f : 1.0f;
    set(out, i, normalizeOr(side * cross(along(0), along(1)), get(g->N, i)));
  });
}

void report(void* host, const TmGrid*, int32_t severity, const char* message) {
  const Batch& batch = batchOf(host);
  // Messages with the same beginning count as one, since a value may follow; and their number is limited, so that a
  // shader cannot fill the log.
  constexpr size_t kAlike = 24, kSubjects = 4096;
  const std::string text = message;
  const uint64_t site = checksum(std::as_bytes(std::span(text).first(std::min(kAlike, text.size())))) % kSubjects;
  const bool misses = severity >= TM_MISSING;
  batch.report(misses ? Severity::Missing : Severity::Warning, misses ? "shader-misses" : "shader-says", text,
               std::to_string(site));
}

void print(void* host, const TmGrid*, const char* text) {
  const Batch& batch = batchOf(host);
  if (batch.context.purpose != Purpose::Picture || batch.scene.silent) return;
  std::string line = text;
  if (!line.ends_with('\n')) line += '\n';
  std::fputs(line.c_str(), stderr);
}

TmServices table() {
  TmServices services{};
  services.structBytes = sizeof services;
  services.abi = TM_SHADER_ABI;
  for (const auto add : {addSurfaceServices, addLightServices, addLobeServices, addRayServices, addOcclusionServices,
                         addPictureServices, addCloudServices, addMessageServices, addVolumeServices})
    add(services);
  return services;
}

}  // namespace

void addSurfaceServices(TmServices& services) {
  services.transform = transform;
  services.calculateNormal = calculateNormal;
  services.derivative = derivative;
  services.report = report;
  services.print = print;
}

const TmServices kServices = table();

}  // namespace tomales
