// Implements the calls of TmServices that look pictures up.
#include "reyes/shade/picture_services.h"

#include <string_view>

#include "reyes/base/rng.h"
#include "reyes/shade/footprint.h"
#include "reyes/shade/primary.h"
#include "reyes/shade/services.h"
#include "reyes/shade/sky.h"

namespace tomales {
namespace {

/// Returns the lookup of a picture. Option "texture" "width" scales all filters; "filter" is used for lookups without
/// their own.
TextureQuery queryOf(const Batch& batch, const TmGrid* g, const char* name, const TmTextureOptions& o, TmVec3 out) {
  const UserParams& options = batch.scene.scene.options.user;
  const Param *width = findParam(options, "texture:width"), *filter = findParam(options, "texture:filter");
  const float scale = width ? std::max(0.0f, width->number(1)) : 1.0f;
  const bool names = filter && !filter->strings.empty();
  TextureQuery q;
  q.name = name;
  q.channel = o.channel;
  q.channels = out.y ? 3 : 1;
  q.fill = o.fill;
  q.filter = !o.filter && names ? filter->strings[0].c_str() : o.filter;
  const float level = scale * std::exp2(-o.mipBias);
  q.sWidth = level * o.swidth;
  q.tWidth = level * o.twidth;
  q.sBlur = o.sblur;
  q.tBlur = o.tblur;
  q.count = g->count;
  q.active = g->active;
  return q;
}

int32_t lookUp(const Batch& batch, const TextureQuery& query, TmVec3 out) {
  return batch.scene.textures.lookup(query, batch.running->where, batch.running->user, out);
}

/// Takes the mean of the texels of a region that are not greater than `most`, channel by channel, or `fill` where all
/// are greater. Coarse levels have averaged such texels already, so points of the finest level are looked up.
int32_t lookUpBelow(Batch& batch, const TextureQuery& query, float most, TmVec3 out) {
  constexpr uint32_t kPoints = 64;
  const int n = query.count;
  float *s = batch.arena.floats(n), *t = batch.arena.floats(n);
  const TmVec3 texel = batch.arena.vec3(n), sum = batch.arena.vec3(n), counted = batch.arena.vec3(n);
  TextureQuery point = query;
  point.s = s;
  point.t = t;
  point.su = point.tu = point.sv = point.tv = nullptr;
  point.sWidth = point.tWidth = point.sBlur = point.tBlur = 0;
  const auto edge = [](const float* e, int i) { return e ? e[i] : 0.0f; };
  const auto channel = [](TmVec3 v, int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; };
  for (uint32_t k = 0; k < kPoints; ++k) {
    const vec2 xi = sobol2(k, 0);
    const float a = xi.x - 0.5f, b = xi.y - 0.5f;
    for (int i = 0; i < n; ++i) {
      if (!query.active[i]) continue;
      s[i] = query.s[i] + query.sWidth * (a * edge(query.su, i) + b * edge(query.sv, i)) + a * query.sBlur;
      t[i] = query.t[i] + query.tWidth * (a * edge(query.tu, i) + b * edge(query.tv, i)) + b * query.tBlur;
    }
    if (!lookUp(batch, point, texel)) return lookUp(batch, query, out);
    for (int c = 0; c < query.channels; ++c)
      for (int i = 0; i < n; ++i)
        if (const float value = channel(texel, c)[i]; query.active[i] && value <= most) {
          channel(sum, c)[i] += value;
          channel(counted, c)[i] += 1;
        }
  }
  for (int c = 0; c < query.channels; ++c)
    for (int i = 0; i < n; ++i)
      if (query.active[i])
        channel(out, c)[i] = channel(counted, c)[i] > 0 ? channel(sum, c)[i] / channel(counted, c)[i] : query.fill;
  return 1;
}

int32_t lookUp(Batch& batch, const TextureQuery& query, const TmTextureOptions& o, TmVec3 out) {
  return o.ignoreAbove < tmTextureDefaults().ignoreAbove ? lookUpBelow(batch, query, o.ignoreAbove, out)
                                                         : lookUp(batch, query, out);
}

/// The picture stands in world space, +z at its top.
int32_t lookUpLatLong(Batch& batch, const TmGrid* g, const char* name, const TmTextureOptions& options,
                      TmConstVec3 direction, const float* angle, TmVec3 out) {
  const mat3 worldFromCurrent = glm::inverse(mat3(batch.scene.cameraFromWorld));
  const int n = g->count;
  float *s = batch.arena.floats(n), *t = batch.arena.floats(n), *su = batch.arena.floats(n),
        *tv = batch.arena.floats(n);
  float* zero = batch.arena.floats(n);
  forActive(g, [&](int i) {
    const vec3 d = normalizeOr(worldFromCurrent * get(direction, i), vec3(0, 0, 1));
    const vec2 st = latLong(d);
    s[i] = st.x;
    t[i] = st.y;
    tv[i] = std::min(1.0f, angle[i] / kPi);
    su[i] = std::min(1.0f, angle[i] / (2 * kPi * std::max(std::sqrt(d.x * d.x + d.y * d.y), 1e-6f)));
  });
  TextureQuery query = queryOf(batch, g, name, options, out);
  query.s = s;
  query.t = t;
  query.su = su;
  query.tu = zero;
  query.sv = zero;
  query.tv = tv;
  query.latlong = true;
  return lookUp(batch, query, options, out);
}

/// Sets the region to the parallelogram of the micropolygon in (s, t). A shader that lacks TM_DERIVATIVES is warned.
void setMicropolygon(Batch& batch, const TmGrid* g, const float* s, const float* t, TextureQuery& query) {
  float* steps[4];
  for (float*& step : steps) step = batch.arena.floats(g->count);
  const bool known = batch.stepsOf(g, false, s, steps[0]) && batch.stepsOf(g, false, t, steps[1]) &&
                     batch.stepsOf(g, true, s, steps[2]) && batch.stepsOf(g, true, t, steps[3]);
  if (known) {
    query.su = steps[0];
    query.tu = steps[1];
    query.sv = steps[2];
    query.tv = steps[3];
  } else if (batch.points && batch.running->shader->kind != TM_LIGHT &&
             (batch.points->hasSteps() || !(batch.running->can(TM_DERIVATIVES) || batch.running->can(TM_NEIGHBOURS))))
    batch.report(Severity::Warning, "shader-footprint",
                 "looks a picture up at places that it has computed, without TM_NEIGHBOURS (or at s, t without "
                 "TM_DERIVATIVES); it is not filtered");
}

int32_t texture(void* host, const TmGrid* g, const char* name, const TmTextureOptions* given, const float* s,
                const float* t, TmVec3 out) {
  Batch& batch = batchOf(host);
  const TmTextureOptions options = givenOptions(batch, tmTextureDefaults(), given);
  TextureQuery query = queryOf(batch, g, name, options, out);
  query.s = s;
  query.t = t;
  const float* const* sides = options.region;
  if (sides[0]) {
    query.su = sides[0];
    query.tu = sides[1];
    query.sv = sides[2];
    query.tv = sides[3];
  } else
    setMicropolygon(batch, g, s, t, query);
  return lookUp(batch, query, options, out);
}

/// Does environment() for "raytrace".
void traceEnvironment(const TmGrid* g, const TmTextureOptions& options, TmConstVec3 direction, TmVec3 out,
                      TmVec3 color) {
  TmRayOptions rays = tmRayDefaults();
  rays.samples = options.samples;
  rays.coneAngle = options.sblur * kPi;
  g->call->trace(g->host, g, &rays, view(g->P), direction, out.y ? out : color, nullptr);
  const int channel = std::clamp(options.channel, 0, 2);
  if (!out.y) forActive(g, [&](int i) { out.x[i] = get(color, i)[channel]; });
}

int32_t textureInfo(void* host, const TmGrid*, const char* name, const char* what, int32_t* type, TmValue* out) {
  Batch& batch = batchOf(host);
  std::vector<float> numbers;
  std::string text;
  if (!batch.scene.textures.info(name, what, numbers, text)) return 0;
  batch.answer(numbers, text, numbers.size() == 16 ? TM_MATRIX : numbers.empty() ? TM_STRING : TM_FLOAT, *type, *out);
  return 1;
}

}  // namespace

int32_t environment(void* host, const TmGrid* g, const char* name, const TmTextureOptions* given, TmConstVec3 direction,
                    TmVec3 out) {
  Batch& batch = batchOf(host);
  const TmTextureOptions options = givenOptions(batch, tmTextureDefaults(), given);
  if (std::string_view(name) == "raytrace") {
    traceEnvironment(g, options, direction, out, batch.arena.vec3(g->count));
    return 1;
  }
  if (options.angle) return lookUpLatLong(batch, g, name, options, direction, options.angle, out);
  float* angle = batch.arena.floats(g->count);
  turnOf(batch, g, direction, angle);
  return lookUpLatLong(batch, g, name, options, direction, angle, out);
}

void addPictureServices(TmServices& services) {
  services.texture = texture;
  services.environment = environment;
  services.textureInfo = textureInfo;
}

}  // namespace tomales
