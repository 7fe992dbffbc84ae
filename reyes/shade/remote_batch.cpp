#include "reyes/shade/remote_batch.h"

#include <bit>

#include "reyes/base/rng.h"
#include "reyes/shade/parameter_values.h"
#include "reyes/shade/primary.h"

namespace tomales {
namespace {

constexpr size_t kRemembered = 4;  ///< The number that TmServices::illuminance promises.
constexpr int kSamples = 1 << 20;  ///< Most samples at one place.
constexpr int kNumbers = 1 << 10;  ///< Number of places after which their numbers repeat.

bool sameBits(float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); }

template <class A, class B>
bool sameAt(const A& a, const B& b, int i) {
  return sameBits(a.x[i], b.x[i]) && sameBits(a.y[i], b.y[i]) && sameBits(a.z[i], b.z[i]);
}

bool atOwnPoints(const Batch& batch, const TmGrid* g, const TmIlluminance& query) {
  const TmConstVec3 own = batch.points->vec(kPx);
  for (int i = 0; i < batch.points->count(); ++i)
    if (g->active[i] && !sameAt(own, query.P, i)) return false;
  return true;
}

/// Moves the points, and gives each position a different sample name, so that a march does not draw the same samples at
/// every step.
void moveTo(TmConstVec3 P, const uint8_t* active, bool inAir, ShadePoints& points) {
  points.setInAir(inAir);
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i] || (!inAir && sameAt(points.vec(kPx), P, i))) continue;
    const SampleName name = points.name(i);
    const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
    points.rename(i, {hashCombine(name.key, bits(P.x[i]), bits(P.y[i]), bits(P.z[i])), name.sequence});
    points.set3(kPx, i, get(P, i));
    if (inAir) {
      points.set3(kNx, i, vec3(0.0f));
      points.set3(kNgx, i, vec3(0.0f));
    }
  }
}

/// Returns the number of arrays of a message, and their length.
int arraysOf(const TmMessage& m) { return m.type == TM_STRING ? 0 : m.type == TM_MATRIX ? 1 : floatsOf(m.type); }
int lengthOf(const TmMessage& m, const TmGrid* g) {
  return m.type == TM_MATRIX ? floatsOf(TM_MATRIX) : m.value.step ? g->count : 1;
}

bool isSame(const LightMessage& held, const TmMessage& sent, const TmGrid* g) {
  if (held.name != sent.name || held.type != sent.type || held.value.step != sent.value.step) return false;
  if (sent.type == TM_STRING) return held.text == sent.value.string;
  for (int k = 0; k < arraysOf(sent); ++k)
    for (int i = 0; i < lengthOf(sent, g); ++i)
      if ((!held.value.step || g->active[i]) && !sameBits(held.value.c[k][i], sent.value.c[k][i])) return false;
  return true;
}

LightMessage copied(const TmMessage& sent, const TmGrid* g, Arena& arena) {
  LightMessage m{sent.name, sent.type, sent.value, {}};
  m.value.length = 1;
  if (sent.type == TM_STRING) m.text = sent.value.string;
  for (int k = 0; k < arraysOf(sent); ++k) {
    float* to = arena.floats(lengthOf(sent, g));
    std::copy_n(sent.value.c[k], lengthOf(sent, g), to);
    m.value.c[k] = to;
  }
  return m;
}

}  // namespace

RemoteBatch::RemoteBatch(const Batch& asking, const TmGrid* g, const TmIlluminance& query, bool inAir, int n)
    : number(n), context(asking.context), points(*asking.points), batch(asking.scene, asking.group, context, *arena) {
  context.answers = nullptr;  // answers are identified by the light alone, not by the position
  moveTo(query.P, g->active, inAir, points);
  request.category = query.category ? query.category : "";
  for (int i = 0; i < query.sentCount; ++i) request.sent.push_back(copied(query.sent[i], g, *arena));
  batch.setRemote(asking, g, points);
  batch.lights.ask(request);
}

bool RemoteBatch::isFor(const TmGrid* g, const TmIlluminance& query, bool inAir) const {
  if (points.inAir() != inAir || request.category != (query.category ? query.category : "") ||
      request.sent.size() != static_cast<size_t>(query.sentCount))
    return false;
  for (size_t k = 0; k < request.sent.size(); ++k)
    if (!isSame(request.sent[k], query.sent[k], g)) return false;
  const TmConstVec3 here = points.vec(kPx);
  for (int i = 0; i < points.count(); ++i)
    if (g->active[i] && (!batch.tm.active[i] || !sameAt(here, query.P, i))) return false;
  return true;
}

Batch& remoteBatchOf(Batch& batch, const TmGrid* g, TmIlluminance query) {
  if (!batch.points || batch.running != batch.own) return batch;  // a light that asks gets the lights that have run
  const bool inAir = query.P.x && batch.own->shader->kind == TM_VOLUME, isTold = query.sentCount > 0 || query.refresh;
  if (!query.P.x) query.P = batch.points->vec(kPx);
  if (!isTold && !inAir && atOwnPoints(batch, g, query)) return batch;
  auto& places = batch.remoteBatches;
  const bool anew = query.refresh && query.next == 0;
  auto it =
      std::find_if(places.begin(), places.end(), [&](const auto& p) { return !anew && p->isFor(g, query, inAir); });
  if (it == places.end()) {
    if (places.size() == kRemembered) places.pop_back();
    do batch.remoteBatchesAsked = batch.remoteBatchesAsked % kNumbers + 1;
    while (std::any_of(places.begin(), places.end(),
                       [&](const auto& p) { return p->number == batch.remoteBatchesAsked; }));
    it = places.insert(places.begin(), std::make_unique<RemoteBatch>(batch, g, query, inAir, batch.remoteBatchesAsked));
  }
  std::rotate(places.begin(), it, it + 1);
  Batch& place = places.front()->batch;
  place.lights.restrictTo(batch.lights.group());
  return place;
}

int32_t lightNumber(const Batch& batch, const Batch& place, size_t sample) {
  const int number = &place == &batch ? 0 : batch.remoteBatches.front()->number;
  return number * kSamples + static_cast<int32_t>(sample);
}

LightSample* lightNumbered(Batch& batch, int32_t number) {
  if (number < 0) return nullptr;
  Batch* place = number < kSamples ? &batch : nullptr;
  for (const auto& p : batch.remoteBatches)
    if (p->number == number / kSamples) place = &p->batch;
  if (!place) return nullptr;
  if (place != &batch) place->lights.restrictTo(batch.lights.group());
  auto& samples = place->lights.samples(*place, false);  // whose number is known has run
  const auto k = static_cast<size_t>(number % kSamples);
  return k < samples.size() ? &samples[k] : nullptr;
}

}  // namespace tomales
